// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/sampling.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "skein/scenario/numbers.h"

namespace skein::assemble {
namespace {

using scenario::Scenario;
using scenario::seconds_text;

struct Sampling {
  std::string key;  // of the sensor's rate
  double rate_hz = 0;
  bool fire = false;  // looks at the fire
  Time step;          // at which it can sample
};

// Sensors of the autopilot, and those of the agent that look at other things.
constexpr std::array kNotAtTheFire = {
    "gnss",   "gnss-receiver", "air-data", "imu",          "barometer",
    "power",  "magnetometer",  "airspeed", "height",       "anemometer",
    "camera", "rangefinder",   "lidar",    "safety-pilot", "ideal-navigation"};

// Sensors of the autopilot sample at the vehicle's own step, which may be finer.
bool of_agent(const std::string& kind) {
  return kind == "camera" || kind == "rangefinder" || kind == "lidar";
}

bool looks_at_fire(const std::string& kind) {
  return std::find(kNotAtTheFire.begin(), kNotAtTheFire.end(), kind) ==
         kNotAtTheFire.end();
}

// Every sensor whose kind has the key rate_hz. Kinds that are not known here count as
// looking at the fire: that costs time, never truth.
std::vector<Sampling> all_sensors(const Scenario& scenario,
                                  const scenario::KindTable& kinds) {
  std::vector<Time> steps;
  for (const scenario::AircraftGroup& group : scenario.aircraft) {
    const Result<Time> step = flight_step(scenario, group);
    steps.push_back(step ? step.value() : scenario.step);  // the build says why not
  }
  std::vector<Sampling> all;
  for (std::size_t g = 0; g < scenario.aircraft.size(); ++g)
    for (std::size_t s = 0; s < scenario.aircraft[g].sensors.size(); ++s) {
      const scenario::Choice& sensor = scenario.aircraft[g].sensors[s];
      const scenario::Object& keys = *kinds.find("sensor", sensor.kind)->options;
      const scenario::Field* rate = keys.find("rate_hz");
      // The ideal one is meant to speak in each step, however long that is.
      if (rate == nullptr || sensor.kind == "ideal-navigation") continue;
      std::any options = sensor.options;
      const bool fire = looks_at_fire(sensor.kind);
      all.push_back({fmt::format("aircraft[{}].sensors[{}].rate_hz", g, s),
                     *static_cast<const double*>(rate->in(keys.content(options))), fire,
                     fire || of_agent(sensor.kind) ? scenario.step : steps[g]});
    }
  return all;
}

// The longest period that meets every look of a sensor. Samples are taken in the first
// step after they are due: when the rate does not fit the steps, that may be any step.
Time look_period(double rate_hz, Time step) {
  const Time period = Time::from_seconds(1 / rate_hz);
  return period > step && period.ns() % step.ns() == 0 ? period : step;
}

Time derived_period(const Scenario& scenario, const scenario::KindTable& kinds) {
  std::int64_t ns =
      std::gcd(Time::from_seconds(1).ns(), scenario.record.metrics_period.ns());
  for (const Sampling& sensor : all_sensors(scenario, kinds))
    if (sensor.fire) ns = std::gcd(ns, look_period(sensor.rate_hz, scenario.step).ns());
  return ns % scenario.step.ns() == 0 ? Time::from_ns(ns) : scenario.step;
}

}  // namespace

Result<Time> flight_step(const Scenario& scenario, const scenario::AircraftGroup& group) {
  if (group.flight_step) return *group.flight_step;
  const std::string& plant = group.plant.kind;
  const bool takes_actuators = plant == "fixed-wing" || plant == "multirotor";
  if (!takes_actuators || scenario.step < kFlightStep) return scenario.step;
  if (scenario.step.ns() % kFlightStep.ns() == 0) return kFlightStep;
  return Error{ErrorCode::kBadInput, "",
               fmt::format("steps of {} s do not divide step_s, {} s.",
                           seconds_text(kFlightStep), seconds_text(scenario.step)),
               "Give flight_step_s, or another step_s."};
}

Time truth_period(const Scenario& scenario, const scenario::KindTable& kinds) {
  return scenario.environment.period.value_or(derived_period(scenario, kinds));
}

std::vector<std::string> sampling_warnings(const Scenario& scenario,
                                           const scenario::KindTable& kinds) {
  std::vector<std::string> warnings;
  const Time period = truth_period(scenario, kinds);
  for (const Sampling& sensor : all_sensors(scenario, kinds)) {
    const double steps_per_s = 1 / sensor.step.seconds();
    if (sensor.rate_hz > steps_per_s * (1 + 1e-9))
      warnings.push_back(fmt::format(
          "{}: {:.6g} samples a second are more than the {:.6g} steps a second of {} "
          "{}: the sensor has one in each step.",
          sensor.key, sensor.rate_hz, steps_per_s,
          sensor.step == scenario.step ? "step_s" : "flight_step_s",
          seconds_text(sensor.step)));
    const Time look = look_period(sensor.rate_hz, scenario.step);
    if (sensor.fire && look.ns() % period.ns() != 0)
      warnings.push_back(fmt::format(
          "environment.period_s: the fire moves every {} s, and {} looks at it every {} "
          "s: "
          "it sees a fire that stands still in between. Leave the key out, or write {}.",
          seconds_text(period), sensor.key, seconds_text(look),
          seconds_text(derived_period(scenario, kinds))));
  }
  return warnings;
}

}  // namespace skein::assemble
