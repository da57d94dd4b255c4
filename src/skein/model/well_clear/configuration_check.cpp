// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "skein/geo/vec.h"
#include "skein/model/well_clear/configuration.h"

namespace skein::model {
namespace {

constexpr double kMaxOptions = 10'000;  // of one kind; real configurations have some 500

// The first problem that was found.
class Problems {
 public:
  void above_zero(std::string_view key, double value) {
    within(key, value, value > 0, "above 0");
  }
  void not_negative(std::string_view key, double value) {
    within(key, value, value >= 0, "at least 0");
  }
  void within(std::string_view key, double value, bool good, std::string_view allowed) {
    if (first_.empty() && !(good && std::abs(value) <= kMaxValue)) {
      first_ = key;
      message_ = good ? fmt::format("{} must be at most {}.", value, kMaxValue)
                      : fmt::format("{} must be {}.", value, allowed);
    }
  }
  void say(std::string_view key, std::string message) {
    if (!first_.empty()) return;
    first_ = key;
    message_ = std::move(message);
  }
  Result<void> result() const {
    if (first_.empty()) return {};
    return Error{ErrorCode::kBadInput, first_, message_, ""};
  }

 private:
  static constexpr double kMaxValue = 1e6;

  std::string first_, message_;
};

void check_range(Problems& problems, std::string_view group, std::string_view unit,
                 double step, double min, double max) {
  const auto key = [&](std::string_view name) {
    return fmt::format("{}.{}_{}", group, name, unit);
  };
  problems.above_zero(key("step"), step);
  problems.within(key("min"), min, std::isfinite(min), "a number");
  problems.within(key("max"), max, max > min, fmt::format("above the least, {}", min));
  problems.within(key("step"), step, (max - min) / step <= kMaxOptions,
                  fmt::format("at least {}: a range has {} steps at most",
                              (max - min) / kMaxOptions, kMaxOptions));
}

void check_manoeuvres(Problems& problems, const WellClearConfiguration& c) {
  const double step_deg = geo::degrees(c.track.step);
  problems.within("track.step_deg", step_deg, step_deg >= 0.02 && step_deg <= 45,
                  "from 0.02 to 45");
  problems.above_zero("track.turn_rate_degps", geo::degrees(c.track.turn_rate));
  check_range(problems, "speed", "mps", c.speed.step, c.speed.min, c.speed.max);
  problems.above_zero("speed.accel_mps2", c.speed.accel);
  problems.not_negative("speed.min_mps", c.speed.min);
  check_range(problems, "vs", "mps", c.vertical_speed.step, c.vertical_speed.min,
              c.vertical_speed.max);
  problems.above_zero("vs.accel_mps2", c.vertical_speed.accel);
  check_range(problems, "alt", "m", c.altitude.step, c.altitude.min, c.altitude.max);
  problems.above_zero("alt.rate_mps", c.altitude.rate);
  problems.above_zero("alt.accel_mps2", c.altitude.accel);
}

void check_recovery(Problems& problems, const WellClearConfiguration& c) {
  const auto& r = c.recovery;
  problems.above_zero("recovery.nmac_horizontal_m", r.nmac_horizontal);
  problems.above_zero("recovery.nmac_vertical_m", r.nmac_vertical);
  problems.within("recovery.horizontal_m", r.horizontal,
                  r.horizontal >= r.nmac_horizontal,
                  fmt::format("at least nmac_horizontal_m, {}", r.nmac_horizontal));
  problems.within("recovery.vertical_m", r.vertical, r.vertical >= r.nmac_vertical,
                  fmt::format("at least nmac_vertical_m, {}", r.nmac_vertical));
  problems.not_negative("recovery.stability_s", r.stability);
  problems.within("recovery.ca_factor", r.ca_factor,
                  r.ca_factor >= 0.001 && r.ca_factor < 1, "from 0.001 to below 1");
}

void check_hysteresis(Problems& problems, const WellClearConfiguration& c) {
  const auto& h = c.hysteresis;
  problems.not_negative("hysteresis.time_s", h.time);
  problems.not_negative("hysteresis.persistence_s", h.persistence);
  problems.within("hysteresis.n", h.n, h.n >= 1 && h.n <= kMaxHysteresisAnswers,
                  fmt::format("from 1 to {}", kMaxHysteresisAnswers));
  problems.within("hysteresis.m", h.m, h.m >= 1 && h.m <= h.n,
                  fmt::format("from 1 to n, {}", h.n));
}

void check_level(Problems& problems, const std::string& place, const AlertLevel& level,
                 double lookahead) {
  if (level.region == AlertRegion::kRecovery)
    problems.say(place + ".region", "RECOVERY must be NONE, FAR, MID or NEAR.");
  problems.within(place + ".alerting_time_s", level.alerting_time,
                  level.alerting_time >= 0 && level.alerting_time <= lookahead,
                  fmt::format("from 0 to lookahead_s, {}", lookahead));
  problems.within(place + ".early_alerting_time_s", level.early_alerting_time,
                  level.early_alerting_time >= level.alerting_time,
                  fmt::format("at least alerting_time_s, {}", level.alerting_time));
  problems.above_zero(place + ".DTHR_m", level.volume.horizontal);
  problems.above_zero(place + ".ZTHR_m", level.volume.vertical);
  problems.not_negative(place + ".TTHR_s", level.volume.tau);
  problems.not_negative(place + ".TCOA_s", level.volume.coaltitude);
}

void check_alerter(Problems& problems, const WellClearConfiguration& c,
                   const Alerter& alerter) {
  constexpr std::size_t kMaxLevels = 8;
  const std::string place = fmt::format("alerters.{}", alerter.name);
  if (alerter.levels.empty() || alerter.levels.size() > kMaxLevels)
    problems.say(place, fmt::format("has {} levels; 1 to {} are allowed.",
                                    alerter.levels.size(), kMaxLevels));
  bool corrective = false;
  AlertRegion before = AlertRegion::kNone;
  for (std::size_t i = 0; i < alerter.levels.size(); ++i) {
    const AlertLevel& level = alerter.levels[i];
    const std::string at = fmt::format("{}[{}]", place, i);
    check_level(problems, at, level, c.lookahead);
    corrective = corrective || level.region == c.corrective;
    if (level.region == AlertRegion::kNone) continue;
    if (level.region <= before)
      problems.say(at + ".region",
                   fmt::format("{} comes after {}; regions must rise: FAR, MID, NEAR.",
                               name_of(level.region), name_of(before)));
    before = level.region;
  }
  if (!corrective)
    problems.say(place, fmt::format("has no level of the corrective region, {}.",
                                    name_of(c.corrective)));
}

}  // namespace

Result<void> check(const WellClearConfiguration& c) {
  Problems problems;
  problems.within("lookahead_s", c.lookahead, c.lookahead > 0 && c.lookahead <= 3600,
                  "above 0 and at most 3600");
  check_manoeuvres(problems, c);
  check_recovery(problems, c);
  if (c.corrective == AlertRegion::kNone || c.corrective == AlertRegion::kRecovery)
    problems.say("corrective",
                 fmt::format("{} must be FAR, MID or NEAR.", name_of(c.corrective)));
  problems.not_negative("min_airspeed_mps", c.min_airspeed);
  check_hysteresis(problems, c);
  if (c.alerters.empty()) problems.say("alerters", "must have one alerter at least.");
  for (std::size_t i = 0; i < c.alerters.size(); ++i) {
    if (alerter_named(c, c.alerters[i].name) != i)
      problems.say(fmt::format("alerters.{}", c.alerters[i].name), "is there twice.");
    check_alerter(problems, c, c.alerters[i]);
  }
  return problems.result();
}

}  // namespace skein::model
