#include "skein/layer/reasoning/agent/fire_readings.h"

#include <algorithm>
#include <utility>

namespace skein::reasoning {

void FireReadings::step(const AgentInput& in, double share, AgentOutput& out) {
  latest_.clear();
  to_send_.clear();
  const NavEstimate& nav = *in.nav;
  const Vec2 velocity = geo::horizontal(nav.v_N);
  for (const SensorSample& sample : in.samples) {
    const auto* fire = std::get_if<FireSample>(&sample);
    if (!fire) continue;
    // Where the aircraft was when the sensor looked.
    const double ago = (nav.time - fire->time).seconds();
    const FireReading reading{fire->time, self_,
                              geo::horizontal(nav.p_N) - ago * velocity +
                                  fire->look_ahead * geo::unit(nav.heading),
                              nav.position_sd, fire->inside};
    latest_.push_back(reading);
    out.records.emplace_back(reading);
    const bool changed = last_ && last_->inside != reading.inside;
    if (changed && !last_sent_) to_send_.push_back(*last_);
    credit_ = std::min(credit_ + share, 1.0);
    last_sent_ = changed || share >= 1 || credit_ >= 1;
    if (last_sent_) {
      to_send_.push_back(reading);
      credit_ = std::max(credit_ - 1, -1.0);
    }
    last_ = reading;
  }
  if (to_send_.empty()) return;
  Message message;
  message.to = station_;
  if (to_send_.size() == 1)
    message.content = to_send_.front();
  else
    message.content = FireReport{to_send_};
  out.outbox.push_back(std::move(message));
}

}  // namespace skein::reasoning
