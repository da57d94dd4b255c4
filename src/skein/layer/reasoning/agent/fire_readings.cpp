// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/fire_readings.h"

#include <algorithm>
#include <utility>

namespace skein::reasoning {
namespace {

constexpr double kBurningApart = 60;    // places of a report, at first [m]
constexpr std::size_t kMaxBurning = 8;  // more are thinned out

}  // namespace

void FireReadings::step(const AgentInput& in, double share, AgentOutput& out) {
  latest_.clear();
  selected_.clear();
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
    take(reading, share);
  }
  if (selected_.empty()) return;
  if (share < 1) {
    out.outbox.push_back(report());
    return;
  }
  for (const Selected& each : selected_) {
    Message message;
    message.to = station_;
    message.content = each.reading;
    out.outbox.push_back(std::move(message));
  }
}

void FireReadings::take(const FireReading& reading, double share) {
  const bool changed = last_ && last_->inside != reading.inside;
  bool adjacent = last_sent_ && !selected_.empty();
  if (changed && !last_sent_) {
    selected_.push_back({*last_, false});
    adjacent = true;
  }
  credit_ = std::min(credit_ + share, 1.0);
  const bool sent = changed || share >= 1 || credit_ >= 1;
  if (sent) {
    selected_.push_back({reading, adjacent});
    credit_ = std::max(credit_ - 1, -1.0);
  } else if (reading.inside) {
    remember(reading);
  }
  last_sent_ = sent;
  last_ = reading;
}

// Keeps places along the way, further apart the longer it is.
void FireReadings::remember(const FireReading& reading) {
  if (burning_.empty()) burning_apart_ = kBurningApart;
  if (!burning_.empty() && (burning_.back() - reading.point).norm() < burning_apart_)
    return;
  burning_.push_back(reading.point);
  if (burning_.size() <= kMaxBurning) return;
  std::vector<Vec2> fewer;
  for (std::size_t k = 0; k < burning_.size(); k += 2) fewer.push_back(burning_[k]);
  burning_ = std::move(fewer);
  burning_apart_ *= 2;
}

Message FireReadings::report() {
  FireReport report;
  report.time = selected_.back().reading.time;
  report.position_sd = static_cast<float>(selected_.back().reading.point_sd);
  for (const Selected& each : selected_)
    report.readings.push_back(brief(each.reading, report.time, each.adjacent));
  for (const Vec2& place : burning_) report.burning.push_back(brief(place));
  burning_.clear();
  Message message;
  message.to = station_;
  message.content = std::move(report);
  return message;
}

}  // namespace skein::reasoning
