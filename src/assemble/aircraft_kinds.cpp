// Plants, autopilots, sensors, agents and radios: one row each.

#include <fmt/format.h>

#include "assemble/kinds_of.h"
#include "layer/asset/kinematic_plant.h"
#include "layer/autopilot/simple_autopilot.h"
#include "layer/communication/ideal_radio.h"
#include "layer/reasoning/agent/monitor_agent.h"
#include "layer/sensory/air_data_sensor.h"
#include "layer/sensory/edge_finder.h"
#include "layer/sensory/fire_sensor.h"
#include "layer/sensory/gnss_sensor.h"

namespace skein::assemble {
namespace {

using scenario::Fields;
using scenario::Range;

constexpr Range kRate{.above = 0, .at_most = 1000};
constexpr Range kNotNegative{.at_least = 0, .at_most = 1e6};
constexpr Range kProbability{.at_least = 0, .at_most = 1};

Fields<asset::KinematicOptions> kinematic_fields() {
  using T = asset::KinematicOptions;
  return Fields<T>()
      .number("airspeed_mps", &T::airspeed, "Cruise airspeed.",
              {.at_least = 0.1, .at_most = 500})
      .number("airspeed_range", &T::airspeed_range,
              "Slowest and fastest are cruise times (1 -+ this).",
              {.at_least = 0, .below = 1})
      .number("turn_radius_m", &T::turn_radius, "Smallest, in the air mass at cruise.",
              {.above = 0, .at_most = 1e5})
      .number("climb_rate_mps", &T::climb_rate, "Largest, up and down.",
              {.above = 0, .at_most = 200})
      .number("roll_rate_rad_per_s", &T::roll_rate, "Largest; 0: the roll angle jumps.",
              {.at_least = 0, .at_most = 100})
      .duration_s("airspeed_lag_s", &T::airspeed_lag, "Time constant of the airspeed.")
      .rules([](const T& o) {
        std::vector<scenario::RuleFault> faults;
        if (o.climb_rate >= o.slowest())
          faults.push_back(
              {"climb_rate_mps",
               fmt::format("{:.6g} must be below the slowest airspeed, {:.6g} "
                           "(airspeed_mps times 1 - airspeed_range).",
                           o.climb_rate, o.slowest()),
               {"airspeed_mps", "airspeed_range"}});
        return faults;
      });
}

Fields<sensory::GnssOptions> gnss_fields() {
  using T = sensory::GnssOptions;
  return Fields<T>()
      .number("rate_hz", &T::rate_hz, "Fixes per second.", kRate)
      .number("position_sd_m", &T::position_sd,
              "Standard deviation of the error per horizontal axis; 0: perfect.",
              kNotNegative)
      .number("altitude_sd_m", &T::altitude_sd, "Of the vertical error.", kNotNegative)
      .duration_s("correlation_s", &T::correlation_time,
                  "Correlation time of the position error; 0: white.")
      .number("velocity_sd_mps", &T::velocity_sd, "Of the velocity error per axis.",
              kNotNegative);
}

Fields<sensory::AirDataOptions> air_data_fields() {
  using T = sensory::AirDataOptions;
  return Fields<T>()
      .number("rate_hz", &T::rate_hz, "Samples per second.", kRate)
      .number("airspeed_sd_mps", &T::airspeed_sd, "Of the airspeed error.", kNotNegative)
      .angle_deg("heading_sd_deg", &T::heading_sd, "Of the heading error.",
                 {.at_least = 0, .at_most = 90});
}

Fields<sensory::FireSensorOptions> fire_sensor_fields() {
  using T = sensory::FireSensorOptions;
  return Fields<T>()
      .number("rate_hz", &T::rate_hz, "Readings per second.", kRate)
      .number("look_ahead_m", &T::look_ahead,
              "Of the looked-at point, horizontally along the heading.", kNotNegative)
      .number("max_height_m", &T::max_height,
              "Above that point; higher up there are no readings.",
              {.above = 0, .at_most = 1e5})
      .number("false_in", &T::false_in,
              "Probability of `inside` over ground that does not burn.", kProbability)
      .number("false_out", &T::false_out,
              "Probability of `outside` over ground that does.", kProbability);
}

Fields<sensory::EdgeFinderOptions> edge_finder_fields() {
  using T = sensory::EdgeFinderOptions;
  return Fields<T>()
      .number("rate_hz", &T::rate_hz, "Samples per second.", kRate)
      .number("range_m", &T::range, "Boundaries further away are not seen.",
              {.above = 0, .at_most = 1e6});
}

Fields<communication::IdealRadioOptions> ideal_fields() {
  using T = communication::IdealRadioOptions;
  return Fields<T>()
      .duration_s("delay_s", &T::delay, "From sending to arrival.")
      .duration_s("jitter_s", &T::jitter, "Further delay, uniform between 0 and this.")
      .number("loss", &T::loss, "Probability that a message is lost.", kProbability)
      .number("range_m", &T::range, "Messages that go further are lost; 0: no limit.",
              kNotNegative);
}

Fields<autopilot::SimpleAutopilotOptions> autopilot_fields() {
  using T = autopilot::SimpleAutopilotOptions;
  return Fields<T>()
      .number("heading_gain_hz", [](T & t) -> auto& { return t.guidance.heading_gain; },
              "Turn rate per heading error.", {.above = 0, .at_most = 20})
      .duration_s("look_ahead_s", [](T & t) -> auto& { return t.guidance.look_ahead; },
                  "Flight time in which a cross-track error is taken out.", {.above = 0})
      .duration_s(
          "anticipation_s", [](T & t) -> auto& { return t.guidance.anticipation; },
          "Turns of a path are begun this much early.")
      .number("altitude_gain_hz", &T::altitude_gain, "Climb rate per altitude error.",
              {.above = 0, .at_most = 20})
      .duration_s("wind_lag_s", &T::wind_lag, "Time constant of the reported wind.",
                  {.above = 0});
}

Fields<reasoning::MonitorAgentOptions> scout_fields() {
  using T = reasoning::MonitorAgentOptions;
  return Fields<T>()
      .duration_s("report_period_s", &T::report_period, "Between reports to the station.",
                  {.above = 0})
      .angle_deg("edge_angle_deg", [](T & t) -> auto& { return t.edge.angle; },
                 "Following the edge: between course and edge, to cross it again.",
                 {.above = 0, .at_most = 90})
      .number(
          "zone_margin_m", [](T & t) -> auto& { return t.guard.margin; },
          "Kept from the border of no-flight zones.", kNotNegative);
}

}  // namespace

Kinds<Plant, AircraftContext> plant_kinds() {
  Kinds<Plant, AircraftContext> kinds("plant");
  kinds.add("kinematic", "A point in coordinated flight, carried by the wind.",
            kinematic_fields(),
            [](const asset::KinematicOptions& o, const AircraftContext&) {
              return std::make_unique<asset::KinematicPlant>(o);
            });
  return kinds;
}

Kinds<Autopilot, AircraftContext> autopilot_kinds() {
  Kinds<Autopilot, AircraftContext> kinds("autopilot");
  kinds.add("path", "Follows paths, courses and circles over ground in wind.",
            autopilot_fields(),
            [](const autopilot::SimpleAutopilotOptions& o, const AircraftContext& c) {
              return std::make_unique<autopilot::SimpleAutopilot>(o, c.limits, c.initial);
            });
  return kinds;
}

Kinds<Agent, AircraftContext> agent_kinds() {
  Kinds<Agent, AircraftContext> kinds("agent");
  kinds.add("scout", "Reads the fire sensor, tells the station, flies its orders.",
            scout_fields(),
            [](const reasoning::MonitorAgentOptions& o, const AircraftContext& c) {
              reasoning::MonitorAgentOptions all = o;
              all.altitude_agl = c.altitude_agl;
              return std::make_unique<reasoning::MonitorAgent>(all, c.self, c.station,
                                                               c.limits, *c.map, c.zones);
            });
  return kinds;
}

Kinds<Sensor, AircraftContext> sensor_kinds() {
  Kinds<Sensor, AircraftContext> kinds("sensor");
  kinds.add("gnss", "Satellite navigation with a position error that wanders.",
            gnss_fields(), [](const sensory::GnssOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::GnssSensor>(o, c.seed, c.self, c.instance);
            });
  kinds.add("air-data", "Airspeed and heading.", air_data_fields(),
            [](const sensory::AirDataOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::AirDataSensor>(o, c.seed, c.self,
                                                              c.instance);
            });
  kinds.add("fire", "The cheap in/out sensor: does the ground at one point burn?",
            fire_sensor_fields(),
            [](const sensory::FireSensorOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::FireSensor>(o, c.seed, c.self, c.instance);
            });
  kinds.add("edge-finder",
            "Sees the nearest point of the true edge: a benchmark's ideal.",
            edge_finder_fields(),
            [](const sensory::EdgeFinderOptions& o, const AircraftContext&) {
              return std::make_unique<sensory::EdgeFinder>(o);
            });
  return kinds;
}

Kinds<Radio, RadioContext> radio_kinds() {
  Kinds<Radio, RadioContext> kinds("radio");
  kinds.add("ideal", "No medium: messages arrive after a delay, or are lost by chance.",
            ideal_fields(),
            [](const communication::IdealRadioOptions& o, const RadioContext& c) {
              return std::make_unique<communication::IdealRadio>(o, c.seed, c.position);
            });
  return kinds;
}

}  // namespace skein::assemble
