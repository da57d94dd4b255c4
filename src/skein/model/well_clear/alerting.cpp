// SPDX-License-Identifier: Apache-2.0
#include "skein/model/well_clear/alerting.h"

#include <algorithm>

#include "skein/base/check.h"

namespace skein::model {
namespace {

// `held`: its early alerting time counts, as that of all levels below.
int raw_level(const WellClearConfiguration& configuration, const AircraftMotion& own,
              const Intruder& intruder, int held) {
  SKEIN_CHECK(intruder.alerter < configuration.alerters.size(), intruder.alerter);
  const std::vector<AlertLevel>& levels = configuration.alerters[intruder.alerter].levels;
  for (std::size_t i = levels.size(); i-- > 0;) {
    const AlertLevel& level = levels[i];
    const ConflictSpan span = level_conflict(configuration, level, own, intruder);
    const int number = static_cast<int>(i) + 1;
    const double time = number <= held ? level.early_alerting_time : level.alerting_time;
    if (span.conflict() && span.in <= time) return number;
  }
  return 0;
}

}  // namespace

WellClearVolume grown(const WellClearVolume& volume, const Intruder& intruder) {
  WellClearVolume result = volume;
  result.horizontal += intruder.horizontal_margin;
  result.vertical += intruder.vertical_margin;
  return result;
}

OwnMotion own_motion(const AircraftMotion& own) {
  return {-own.p_N.z(), own.v_N.x(), own.v_N.y(), -own.v_N.z()};
}

IntruderMotion intruder_motion(const AircraftMotion& own, const Intruder& intruder) {
  const AircraftMotion& other = intruder.motion;
  return {other.p_N.x() - own.p_N.x(),
          other.p_N.y() - own.p_N.y(),
          -other.p_N.z(),
          other.v_N.x(),
          other.v_N.y(),
          -other.v_N.z()};
}

ConflictSpan level_conflict(const WellClearConfiguration& configuration,
                            const AlertLevel& level, const AircraftMotion& own,
                            const Intruder& intruder) {
  const RelativeMotion motion = relative_motion(
      own_motion(own), ManoeuvrePoint{0, 0, 0, 0, own.v_N.x(), own.v_N.y(), -own.v_N.z()},
      intruder_motion(own, intruder));
  return conflict_span(grown(level.volume, intruder), motion, configuration.lookahead);
}

int alert_level(const WellClearConfiguration& configuration, const AircraftMotion& own,
                const Intruder& intruder) {
  return raw_level(configuration, own, intruder, 0);
}

int AlertHysteresis::level(const WellClearConfiguration& configuration,
                           const AircraftMotion& own, const Intruder& intruder,
                           double time) {
  const auto& rule = configuration.hysteresis;
  if (asked_ && time - last_ > rule.time) *this = {};
  const int raw = raw_level(configuration, own, intruder, held_);
  const auto n = static_cast<std::size_t>(rule.n), m = static_cast<std::size_t>(rule.m);
  for (std::size_t k = 0; k < (asked_ ? 1 : m); ++k) {
    std::copy_backward(answers_.begin(), answers_.end() - 1, answers_.end());
    answers_[0] = raw;
    count_ = std::min(count_ + 1, n);
  }
  std::array<int, kMaxHysteresisAnswers> sorted = answers_;
  std::sort(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count_),
            std::greater<>());
  // The highest level that m of them had or exceeded.
  const int agreed = count_ >= m ? sorted[m - 1] : 0;
  const bool keeps = asked_ && agreed < held_ && time - raised_ < rule.persistence;
  if (!keeps && agreed != held_) {
    if (agreed > held_) raised_ = time;
    held_ = agreed;
  }
  asked_ = true;
  last_ = time;
  return held_;
}

}  // namespace skein::model
