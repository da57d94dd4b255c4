// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/pace.h"

#include <algorithm>
#include <thread>

namespace skein::simulation {
namespace {

constexpr double kLongestNap = 0.05;  // a person does not notice this delay [s]

}  // namespace

Pace::Pace(double speed, Time step, Time begun)
    : speed_(speed),
      step_(step),
      step_wall_s_(speed > 0 ? step.seconds() / speed : 0),
      origin_(begun),
      start_(Clock::now()),
      last_show_(start_) {}

void Pace::wait_for(Time now, const OperatorConsole& console) {
  if (speed_ <= 0) return;
  double late_s = late(now);
  if (late_s > step_wall_s_) ++misses_;
  while (late_s < 0 && !console.stop_requested()) {
    std::this_thread::sleep_for(
        std::chrono::duration<double>(std::min(-late_s, kLongestNap)));
    late_s = late(now);
  }
}

double Pace::late(Time now) const {
  return wall_s() - origin_wall_s_ - (now - origin_).seconds() / speed_;
}

void Pace::nap() {
  const double before = wall_s();
  std::this_thread::sleep_for(std::chrono::duration<double>(kLongestNap));
  origin_wall_s_ += wall_s() - before;
}

void Pace::set_speed(double speed, Time now) {
  speed_ = speed;
  step_wall_s_ = speed > 0 ? step_.seconds() / speed : 0;
  origin_wall_s_ = wall_s();
  origin_ = now;
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
