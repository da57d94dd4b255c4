// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/traffic/well_clear_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <vector>

#include "skein/data/describe/strict_json.h"
#include "skein/geo/vec.h"

namespace skein::exchange {
namespace {

using WellClearJson = nlohmann::ordered_json;
using model::AlertRegion;
using model::WellClearConfiguration;

constexpr std::size_t kMaxConfigurationBytes = 1 << 20;
constexpr std::size_t kMaxAlerters = 100;

// The first problem of a file; what is read after one does not count.
struct FirstProblem {
  std::string place, key, message, hint;

  void say(std::string where, std::string what, std::string allowed) {
    if (!message.empty()) return;
    key = std::move(where);
    message = std::move(what);
    hint = std::move(allowed);
  }
  bool found() const { return !message.empty(); }
  Error error() const {
    return {ErrorCode::kBadInput, key.empty() ? place : place + " " + key, message, hint};
  }
};

// One object of the file, whose keys are asked for one by one.
class JsonSection {
 public:
  JsonSection(const WellClearJson* json, std::string name, FirstProblem& problem)
      : json_(json), name_(std::move(name)), problem_(&problem) {
    if (json_ && json_->is_object()) return;
    if (json_) problem_->say(name_, "is no object.", "");
    json_ = nullptr;
  }

  double number(std::string_view key) {
    const WellClearJson* value = find(key, true);
    if (!value) return 0;
    if (!value->is_number()) {
      problem_->say(path(key), fmt::format("{} is no number.", shown_value(*value)), "");
      return 0;
    }
    return value->get<double>();
  }
  int whole(std::string_view key) {
    const double value = number(key);
    constexpr double kLimit = 1e9;
    if (value == std::floor(value) && std::abs(value) <= kLimit)
      return static_cast<int>(value);
    problem_->say(path(key), fmt::format("{} is no whole number.", value), "");
    return 0;
  }
  std::string text(std::string_view key, bool needed = true) {
    const WellClearJson* value = find(key, needed);
    if (!value) return "";
    if (value->is_string() && !value->get_ref<const std::string&>().empty())
      return value->get<std::string>();
    problem_->say(path(key), fmt::format("{} is no text.", shown_value(*value)), "");
    return "";
  }
  AlertRegion region(std::string_view key) {
    const std::string name = text(key);
    if (const auto region = model::alert_region_named(name)) return *region;
    problem_->say(path(key), fmt::format("\"{}\" is no region.", name),
                  "They are NONE, FAR, MID and NEAR.");
    return AlertRegion::kNone;
  }
  JsonSection section(std::string_view key) {
    return {find(key, true), path(key), *problem_};
  }
  // All keys, whatever they are.
  std::vector<std::string> keys() const {
    std::vector<std::string> all;
    if (json_)
      for (const auto& item : json_->items()) all.push_back(item.key());
    return all;
  }
  const WellClearJson* list(std::string_view key) {
    const WellClearJson* value = find(key, true);
    if (!value || value->is_array()) return value;
    problem_->say(path(key), "is no list.", "");
    return nullptr;
  }
  // Says which key has not been asked for.
  void finish() const {
    for (const std::string& key : keys()) {
      if (std::find(asked_.begin(), asked_.end(), key) != asked_.end()) continue;
      problem_->say(path(key), "unknown key.",
                    fmt::format("Keys here are {}.", fmt::join(asked_, ", ")));
    }
  }
  std::string path(std::string_view key) const {
    return name_.empty() ? std::string(key) : fmt::format("{}.{}", name_, key);
  }

 private:
  static std::string shown_value(const WellClearJson& value) {
    constexpr std::size_t kLongest = 40;
    if (value.is_structured()) return value.is_array() ? "a list" : "an object";
    std::string text =
        value.dump(-1, ' ', false, WellClearJson::error_handler_t::replace);
    return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
  }
  const WellClearJson* find(std::string_view key, bool needed) {
    asked_.emplace_back(key);
    if (!json_) return nullptr;
    const auto at = json_->find(std::string(key));
    if (at != json_->end()) return &*at;
    if (needed) problem_->say(path(key), "is missing.", "");
    return nullptr;
  }

  const WellClearJson* json_;
  std::string name_;
  FirstProblem* problem_;
  std::vector<std::string> asked_;
};

// Parses; discarded where it is none.
WellClearJson parse_once(std::string_view text, FirstProblem& problem) {
  strict_json::ParserWatch<WellClearJson> watch;
  const WellClearJson json = WellClearJson::parse(text, std::ref(watch), false);
  if (const std::string wrong = watch.problem(); !wrong.empty())
    problem.say("", wrong, "");
  return json;
}

WellClearConfiguration::Speed read_speed(JsonSection section) {
  const WellClearConfiguration::Speed speed{
      section.number("step_mps"), section.number("accel_mps2"), section.number("min_mps"),
      section.number("max_mps")};
  section.finish();
  return speed;
}

void read_manoeuvres(JsonSection& file, WellClearConfiguration& c) {
  JsonSection track = file.section("track");
  c.track = {geo::radians(track.number("step_deg")),
             geo::radians(track.number("turn_rate_degps"))};
  track.finish();
  c.speed = read_speed(file.section("speed"));
  c.vertical_speed = read_speed(file.section("vs"));
  JsonSection alt = file.section("alt");
  c.altitude = {alt.number("step_m"), alt.number("rate_mps"), alt.number("accel_mps2"),
                alt.number("min_m"), alt.number("max_m")};
  alt.finish();
}

void read_rules(JsonSection& file, WellClearConfiguration& c) {
  JsonSection recovery = file.section("recovery");
  c.recovery = {recovery.number("horizontal_m"),      recovery.number("vertical_m"),
                recovery.number("stability_s"),       recovery.number("ca_factor"),
                recovery.number("nmac_horizontal_m"), recovery.number("nmac_vertical_m")};
  recovery.finish();
  c.corrective = file.region("corrective");
  c.min_airspeed = file.number("min_airspeed_mps");
  JsonSection hysteresis = file.section("hysteresis");
  c.hysteresis = {hysteresis.number("time_s"), hysteresis.number("persistence_s"),
                  hysteresis.whole("m"), hysteresis.whole("n")};
  hysteresis.finish();
}

model::AlertLevel read_level(JsonSection section) {
  model::AlertLevel level;
  level.region = section.region("region");
  level.alerting_time = section.number("alerting_time_s");
  level.early_alerting_time = section.number("early_alerting_time_s");
  level.volume = {section.number("DTHR_m"), section.number("ZTHR_m"),
                  section.number("TTHR_s"), section.number("TCOA_s")};
  section.finish();
  return level;
}

void read_alerters(JsonSection section, WellClearConfiguration& c,
                   FirstProblem& problem) {
  const std::vector<std::string> names = section.keys();
  if (names.size() > kMaxAlerters)
    problem.say("alerters", fmt::format("{} are there.", names.size()),
                fmt::format("At most {} are allowed.", kMaxAlerters));
  for (const std::string& name : names) {
    if (problem.found()) return;
    model::Alerter& alerter = c.alerters.emplace_back();
    alerter.name = name;
    const WellClearJson* levels = section.list(name);
    for (std::size_t i = 0; levels && i < levels->size() && !problem.found(); ++i)
      alerter.levels.push_back(
          read_level({&(*levels)[i], fmt::format("alerters.{}[{}]", name, i), problem}));
  }
}

}  // namespace

Result<WellClearConfiguration> well_clear_configuration_from_json(
    std::string_view text, const std::string& place) {
  FirstProblem problem{place, "", "", ""};
  if (text.size() > kMaxConfigurationBytes)
    return Error{ErrorCode::kBadInput, place,
                 fmt::format("{} bytes; a configuration has at most {}.", text.size(),
                             kMaxConfigurationBytes),
                 ""};
  const WellClearJson json = parse_once(text, problem);
  if (json.is_discarded() || !json.is_object())
    return Error{ErrorCode::kBadInput, place, "is no JSON object.",
                 "docs/well-clear.md has one."};
  JsonSection file(&json, "", problem);
  WellClearConfiguration c{};
  c.name = file.text("name");
  file.text("source", false);
  c.lookahead = file.number("lookahead_s");
  read_manoeuvres(file, c);
  read_rules(file, c);
  read_alerters(file.section("alerters"), c, problem);
  file.finish();
  if (problem.found()) return problem.error();
  if (const auto good = model::check(c); !good) {
    Error error = good.error();
    error.place = place + " " + error.place;
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
