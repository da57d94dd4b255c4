// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/modes/failsafe.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace skein::autopilot {
namespace {

// Far below the range of Time, so that sums of times stay inside it.
constexpr double kLongest = 1e6;

bool is_time(double seconds) {
  return seconds >= 0 && seconds <= kLongest;  // false for what is not a number
}

std::optional<std::string> error_in_rule(const char* name, const FailsafeRule& rule) {
  if (!is_time(rule.delay))
    return fmt::format("{}.delay: {} must be from 0 to {:g} s", name, rule.delay,
                       kLongest);
  if (!is_time(rule.escalates_after))
    return fmt::format("{}.escalates_after: {} must be from 0 to {:g} s", name,
                       rule.escalates_after, kLongest);
  if (rule.escalates_after > 0 && rule.escalates_to <= rule.reaction)
    return fmt::format("{}.escalates_to: must be stronger than the reaction before it",
                       name);
  return std::nullopt;
}

}  // namespace

std::optional<std::string> error_in(const FailsafeOptions& options) {
  const std::pair<const char*, const FailsafeRule*> rules[] = {
      {"link", &options.link},
      {"battery_low", &options.battery_low},
      {"battery_critical", &options.battery_critical},
      {"geofence", &options.geofence},
      {"gnss", &options.gnss},
      {"motor", &options.motor},
      {"imu", &options.imu}};
  for (const auto& [name, rule] : rules)
    if (auto error = error_in_rule(name, *rule)) return error;
  const std::pair<const char*, double> times[] = {
      {"recovery", options.recovery},
      {"pilot_silence", options.pilot_silence},
      {"ground_time", options.ground_time}};
  for (const auto& [name, seconds] : times)
    if (!is_time(seconds))
      return fmt::format("{}: {} must be from 0 to {:g} s", name, seconds, kLongest);
  const std::pair<const char*, double> charges[] = {
      {"battery_reserve", options.battery_reserve},
      {"battery_critical_at", options.battery_critical_at}};
  for (const auto& [name, charge] : charges)
    if (!(charge >= 0 && charge <= 1))
      return fmt::format("{}: {} must be from 0 to 1", name, charge);
  if (options.max_clears < 0 || options.max_clears > 1000)
    return fmt::format("max_clears: {} must be from 0 to 1000", options.max_clears);
  return std::nullopt;
}

AirframeKind kind_of(const Airframe& airframe) {
  return std::holds_alternative<MultirotorAirframe>(airframe) ? AirframeKind::kMultirotor
                                                              : AirframeKind::kFixedWing;
}

FailsafeReaction feasible(FailsafeReaction reaction, const Abilities& abilities) {
  using enum FailsafeReaction;
  if (reaction == kNone || reaction == kDescend) return reaction;
  if (!abilities.motors || !abilities.attitude) return kDescend;
  if (!abilities.position) {
    if (abilities.airframe == AirframeKind::kMultirotor || reaction == kLand)
      return kDescend;
    return kHold;
  }
  if (reaction == kLand && !abilities.home_in_reach) return kDescend;
  return reaction;
}

}  // namespace skein::autopilot
