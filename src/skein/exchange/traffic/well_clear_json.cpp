// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/traffic/well_clear_json.h"

#include <fmt/format.h>

#include <string>

#include "skein/data/describe/strict_json.h"
#include "skein/geo/vec.h"

namespace skein::exchange {
namespace {

using strict_json::Fields;
using strict_json::Value;
using WellClearJson = strict_json::Json;
using model::AlertRegion;
using model::WellClearConfiguration;

constexpr std::size_t kMaxConfigurationBytes = 1 << 20;
constexpr std::size_t kMaxAlerters = 100, kMaxLevels = 100;

// Every number of a configuration is within it; model::check() knows the narrower bounds.
constexpr double kMaxNumber = 1e9;

double number(Fields& fields, std::string_view key) {
  return fields.number(key, -kMaxNumber, kMaxNumber);
}

int whole(Fields& fields, std::string_view key) {
  return static_cast<int>(fields.whole(key, -1'000'000, 1'000'000));
}

AlertRegion region(Fields& fields, std::string_view key) {
  const auto value = fields.value(key);
  if (!value) return AlertRegion::kNone;
  if (value->json().is_string())
    if (const auto found =
            model::alert_region_named(value->json().get_ref<const std::string&>()))
      return *found;
  value->report("must be one of: NONE, FAR, MID, NEAR.");
  return AlertRegion::kNone;
}

// Takes the object that is the value of a key apart; nothing where it is missing.
template <class Take>
void with_section(Fields& file, std::string_view key, Take take) {
  const auto value = file.value(key);
  if (!value) return;
  Fields section(*value);
  take(section);
}

WellClearConfiguration::Speed read_speed(Fields& section) {
  return {number(section, "step_mps"), number(section, "accel_mps2"),
          number(section, "min_mps"), number(section, "max_mps")};
}

void read_manoeuvres(Fields& file, WellClearConfiguration& c) {
  with_section(file, "track", [&](Fields& track) {
    c.track = {geo::radians(number(track, "step_deg")),
               geo::radians(number(track, "turn_rate_degps"))};
  });
  with_section(file, "speed", [&](Fields& speed) { c.speed = read_speed(speed); });
  with_section(file, "vs", [&](Fields& vs) { c.vertical_speed = read_speed(vs); });
  with_section(file, "alt", [&](Fields& alt) {
    c.altitude = {number(alt, "step_m"), number(alt, "rate_mps"),
                  number(alt, "accel_mps2"), number(alt, "min_m"), number(alt, "max_m")};
  });
}

void read_rules(Fields& file, WellClearConfiguration& c) {
  with_section(file, "recovery", [&](Fields& recovery) {
    c.recovery = {
        number(recovery, "horizontal_m"),      number(recovery, "vertical_m"),
        number(recovery, "stability_s"),       number(recovery, "ca_factor"),
        number(recovery, "nmac_horizontal_m"), number(recovery, "nmac_vertical_m")};
  });
  c.corrective = region(file, "corrective");
  c.min_airspeed = number(file, "min_airspeed_mps");
  with_section(file, "hysteresis", [&](Fields& hysteresis) {
    c.hysteresis = {number(hysteresis, "time_s"), number(hysteresis, "persistence_s"),
                    whole(hysteresis, "m"), whole(hysteresis, "n")};
  });
}

model::AlertLevel read_level(const Value& value) {
  Fields section(value);
  model::AlertLevel level;
  level.region = region(section, "region");
  level.alerting_time = number(section, "alerting_time_s");
  level.early_alerting_time = number(section, "early_alerting_time_s");
  level.volume = {number(section, "DTHR_m"), number(section, "ZTHR_m"),
                  number(section, "TTHR_s"), number(section, "TCOA_s")};
  return level;
}

void read_alerters(Fields& file, WellClearConfiguration& c) {
  for (const auto& [name, levels] : file.members("alerters", kMaxAlerters)) {
    model::Alerter& alerter = c.alerters.emplace_back();
    alerter.name = name;
    for (const Value& level : levels.items(kMaxLevels))
      alerter.levels.push_back(read_level(level));
  }
}

WellClearConfiguration read_configuration(const Value& value) {
  Fields file(value);
  WellClearConfiguration c{};
  c.name = file.text("name");
  (void)file.text("source", "");
  c.lookahead = number(file, "lookahead_s");
  read_manoeuvres(file, c);
  read_rules(file, c);
  read_alerters(file, c);
  return c;
}

}  // namespace

Result<WellClearConfiguration> well_clear_configuration_from_json(
    std::string_view text, const std::string& place) {
  if (text.size() > kMaxConfigurationBytes)
    return Error{ErrorCode::kBadInput, place,
                 fmt::format("{} bytes; a configuration has at most {}.", text.size(),
                             kMaxConfigurationBytes),
                 ""};
  strict_json::Problems problems(place);
  const auto json = strict_json::parse(text, problems);
  if (json && !json->is_object()) problems.add("", "is no JSON object.");
  if (problems.any()) {
    Error error = problems.error();
    error.hint = "docs/well-clear.md has one.";
    return error;
  }
  const WellClearConfiguration c = read_configuration(Value(*json, "", problems));
  if (problems.any()) return problems.error();
  if (const auto good = model::check(c); !good) {
    Error error = good.error();
    error.place = place + ": " + error.place;
    return error;
  }
  return c;
}

std::string to_json(const WellClearConfiguration& c) {
  const auto speed = [](const WellClearConfiguration::Speed& s) {
    return WellClearJson{{"step_mps", s.step},
                         {"accel_mps2", s.accel},
                         {"min_mps", s.min},
                         {"max_mps", s.max}};
  };
  WellClearJson json;
  json["name"] = c.name;
  json["lookahead_s"] = c.lookahead;
  json["track"] = {{"step_deg", geo::degrees(c.track.step)},
                   {"turn_rate_degps", geo::degrees(c.track.turn_rate)}};
  json["speed"] = speed(c.speed);
  json["vs"] = speed(c.vertical_speed);
  json["alt"] = {{"step_m", c.altitude.step},
                 {"rate_mps", c.altitude.rate},
                 {"accel_mps2", c.altitude.accel},
                 {"min_m", c.altitude.min},
                 {"max_m", c.altitude.max}};
  json["recovery"] = {{"horizontal_m", c.recovery.horizontal},
                      {"vertical_m", c.recovery.vertical},
                      {"stability_s", c.recovery.stability},
                      {"ca_factor", c.recovery.ca_factor},
                      {"nmac_horizontal_m", c.recovery.nmac_horizontal},
                      {"nmac_vertical_m", c.recovery.nmac_vertical}};
  json["corrective"] = std::string(name_of(c.corrective));
  json["min_airspeed_mps"] = c.min_airspeed;
  json["hysteresis"] = {{"time_s", c.hysteresis.time},
                        {"persistence_s", c.hysteresis.persistence},
                        {"m", c.hysteresis.m},
                        {"n", c.hysteresis.n}};
  json["alerters"] = WellClearJson::object();
  for (const model::Alerter& alerter : c.alerters) {
    WellClearJson& levels = json["alerters"][alerter.name] = WellClearJson::array();
    for (const model::AlertLevel& level : alerter.levels)
      levels.push_back({{"region", std::string(name_of(level.region))},
                        {"alerting_time_s", level.alerting_time},
                        {"early_alerting_time_s", level.early_alerting_time},
                        {"DTHR_m", level.volume.horizontal},
                        {"ZTHR_m", level.volume.vertical},
                        {"TTHR_s", level.volume.tau},
                        {"TCOA_s", level.volume.coaltitude}});
  }
  return json.dump(1, ' ', false, WellClearJson::error_handler_t::replace);
}

}  // namespace skein::exchange
