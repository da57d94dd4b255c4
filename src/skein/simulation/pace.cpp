#include "skein/simulation/pace.h"

#include <algorithm>
#include <thread>

namespace skein::simulation {

Pace::Pace(double speed, Time step)
    : speed_(speed),
      step_wall_s_(speed > 0 ? step.seconds() / speed : 0),
      start_(Clock::now()),
      last_show_(start_) {}

void Pace::wait_for(Time now, const OperatorConsole& console) {
  if (speed_ <= 0) return;
  constexpr double kLongestNap = 0.05;  // a person does not notice this delay [s]
  double late_s = wall_s() - now.seconds() / speed_;
  if (late_s > step_wall_s_) ++misses_;
  while (late_s < 0 && !console.stop_requested()) {
    std::this_thread::sleep_for(
        std::chrono::duration<double>(std::min(-late_s, kLongestNap)));
    late_s = wall_s() - now.seconds() / speed_;
  }
}

double Pace::wall_s() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

bool Pace::show_due() {
  const auto now = Clock::now();
  if (now - last_show_ < std::chrono::milliseconds(200)) return false;
  last_show_ = now;
  return true;
}

}  // namespace skein::simulation
