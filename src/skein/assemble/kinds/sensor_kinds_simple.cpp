// SPDX-License-Identifier: Apache-2.0
// What stands in for sensors or for a transmitter, simpler than the real ones: one row
// each.

#include "skein/assemble/kinds/sensor_kinds.h"
#include "skein/layer/sensory/air_data_sensor.h"
#include "skein/layer/sensory/gnss_sensor.h"
#include "skein/layer/sensory/ideal_navigation.h"
#include "skein/layer/sensory/safety_pilot.h"

namespace skein::assemble {
namespace {

using scenario::Fields;
using scenario::Range;

Fields<sensory::GnssOptions> gnss_fields() {
  using T = sensory::GnssOptions;
  return Fields<T>()
      .number("rate_hz", &T::rate_hz, "Fixes per second.", kSensorRate)
      .number("position_sd_m", &T::position_sd,
              "Standard deviation of the error per horizontal axis; 0: perfect.",
              kSensorError)
      .number("altitude_sd_m", &T::altitude_sd, "Of the vertical error.", kSensorError)
      .duration_s("correlation_s", &T::correlation_time,
                  "Correlation time of the position error; 0: white.")
      .number("velocity_sd_mps", &T::velocity_sd, "Of the velocity error per axis.",
              kSensorError);
}

Fields<sensory::AirDataOptions> air_data_fields() {
  using T = sensory::AirDataOptions;
  return Fields<T>()
      .number("rate_hz", &T::rate_hz, "Samples per second.", kSensorRate)
      .number("airspeed_sd_mps", &T::airspeed_sd, "Of the airspeed error.", kSensorError)
      .angle_deg("heading_sd_deg", &T::heading_sd, "Of the heading error.",
                 {.at_least = 0, .at_most = 90});
}

Fields<sensory::IdealNavigationOptions> ideal_navigation_fields() {
  using T = sensory::IdealNavigationOptions;
  return Fields<T>().number("rate_hz", &T::rate_hz, "Samples per second.", kSensorRate);
}

Fields<sensory::Takeover> takeover_fields() {
  using T = sensory::Takeover;
  constexpr Range kStick{.at_least = -1, .at_most = 1};
  return Fields<T>()
      .duration_s("from_s", &T::from, "When the pilot takes over.")
      .duration_s("until_s", &T::until, "When the pilot hands back.")
      .word("mode", &T::mode, "What the sticks say.",
            {{"manual", FlightMode::kManual, "surfaces, or turn rates of a multirotor"},
             {"stabilized", FlightMode::kStabilized, "the attitude"}})
      .number("roll", &T::roll, "Stick: right positive.", kStick)
      .number("pitch", &T::pitch, "Stick: nose up positive.", kStick)
      .number("yaw", &T::yaw, "Stick: right positive.", kStick)
      .number("throttle", &T::throttle, "Stick.", {.at_least = 0, .at_most = 1})
      .rule("until_s", [](const T& t) {
        return t.until <= t.from ? std::string("must be after from_s.") : std::string();
      });
}

Fields<sensory::SafetyPilotOptions> safety_pilot_fields() {
  using T = sensory::SafetyPilotOptions;
  return Fields<T>()
      .number("rate_hz", &T::rate_hz, "Of the receiver's output.", kSensorRate)
      .object("takeovers", &T::takeovers, takeover_fields(), "When the pilot flies.")
      .items({.at_most = 1000});
}

}  // namespace

void add_simple_sensors(Kinds<Sensor, AircraftContext>& kinds) {
  kinds.add("gnss", "Satellite navigation with a position error that wanders.",
            gnss_fields(), [](const sensory::GnssOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::GnssSensor>(o, c.seed, c.self, c.instance);
            });
  kinds.add("air-data", "Airspeed and heading.", air_data_fields(),
            [](const sensory::AirDataOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::AirDataSensor>(o, c.seed, c.self,
                                                              c.instance);
            });
  kinds.add("ideal-navigation", "The true motion: for control without an estimator.",
            ideal_navigation_fields(),
            [](const sensory::IdealNavigationOptions& o, const AircraftContext&) {
              return std::make_unique<sensory::IdealNavigation>(o);
            });
  kinds.add("safety-pilot", "The safety pilot's transmitter: takes over when planned.",
            safety_pilot_fields(),
            [](const sensory::SafetyPilotOptions& o, const AircraftContext&) {
              return std::make_unique<sensory::SafetyPilot>(o);
            });
}

}  // namespace skein::assemble
