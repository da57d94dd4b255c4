// Sensors: one row each.

#include "assemble/kinds_of.h"
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

}  // namespace

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

}  // namespace skein::assemble
