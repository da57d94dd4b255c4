// SPDX-License-Identifier: Apache-2.0
// The sensors of a flight controller: one row each, and all of them as one.

#include <algorithm>

#include "skein/assemble/kinds/sensor_kinds.h"
#include "skein/layer/sensory/airspeed_sensor.h"
#include "skein/layer/sensory/anemometer.h"
#include "skein/layer/sensory/barometer.h"
#include "skein/layer/sensory/gnss_receiver.h"
#include "skein/layer/sensory/gnss_sensor.h"
#include "skein/layer/sensory/height_sensor.h"
#include "skein/layer/sensory/ideal_navigation.h"
#include "skein/layer/sensory/imu_sensor.h"
#include "skein/layer/sensory/magnetometer.h"
#include "skein/layer/sensory/power_sensor.h"
#include "skein/layer/sensory/sensor_suite.h"

namespace skein::assemble {
namespace {

using scenario::Fields;

// A planned loss of fix; without an end it lasts.
struct PlannedOutage {
  double from = 0;
  std::optional<double> until;
};

struct GnssReceiverChoice : sensory::GnssReceiverOptions {
  std::vector<PlannedOutage> planned;
};

Fields<PlannedOutage> planned_outage_fields() {
  using T = PlannedOutage;
  return Fields<T>()
      .duration_s("from_s", &T::from, "When the fix is lost.")
      .duration_s("until_s", &T::until, "When the satellites are back. Null: never.")
      .rule("until_s", [](const T& t) {
        return t.until && *t.until <= t.from ? std::string("must be after from_s.")
                                             : std::string();
      });
}

Fields<GnssReceiverChoice> gnss_receiver_fields() {
  using T = GnssReceiverChoice;
  return sampled<T>()
      .word("receiver", &T::kind, "How it comes by its position.",
            {{"single", GnssKind::kSingle, "by itself"},
             {"differential", GnssKind::kDifferential, "corrected by a station nearby"},
             {"rtk", GnssKind::kRtk, "by carrier phase: centimetres"}})
      .number("clock_sd_m", &T::clock_sd, "Range error by the satellites' clocks.",
              kSensorError)
      .number("orbit_sd_m", &T::orbit_sd, "By their orbits.", kSensorError)
      .number("ionosphere_sd_m", &T::ionosphere_sd, "By the ionosphere.", kSensorError)
      .number("troposphere_sd_m", &T::troposphere_sd, "By the troposphere.", kSensorError)
      .number("multipath_sd_m", &T::multipath_sd, "By reflections.", kSensorError)
      .number("noise_sd_m", &T::noise_sd, "By the receiver.", kSensorError)
      .number("hdop", &T::hdop,
              "Horizontal position error, both axes together, per range error.",
              {.above = 0, .at_most = 100})
      .number("vdop", &T::vdop, "Vertical position error per range error.",
              {.above = 0, .at_most = 100})
      .number("velocity_sd_mps", &T::velocity_sd, "Of the velocity per axis, white.",
              kSensorError)
      .object("outages", &T::planned, planned_outage_fields(), "Planned losses of fix.")
      .items({.at_most = 1000})
      .number("outages_per_hour", [](T & t) -> auto& { return t.outages.per_hour; },
              "Further ones by chance, mean number in an hour with fix.",
              {.at_least = 0, .at_most = 3600})
      .duration_s("outage_mean_s", [](T & t) -> auto& { return t.outages.mean_duration; },
                  "Mean length of those by chance.", {.above = 0, .at_most = 86400})
      .duration_s("reacquisition_s", &T::reacquisition,
                  "From the end of an outage to the next fix.");
}

Fields<sensory::ImuOptions> imu_fields() {
  using T = sensory::ImuOptions;
  return sampled<T>()
      .number("gyro_noise", &T::gyro_noise, "White noise, rad/s/sqrt(Hz).", kSensorError)
      .number("gyro_bias_sd_rad_per_s", &T::gyro_bias_sd, "Constant bias per axis.",
              kSensorError)
      .number("gyro_bias_walk", &T::gyro_bias_walk,
              "Random walk of the bias, rad/s/sqrt(s).", kSensorError)
      .number("gyro_scale_sd", &T::gyro_scale_sd, "Relative scale error per axis.",
              kSensorError)
      .number("gyro_range_rad_per_s", &T::gyro_range, "It saturates beyond.",
              {.above = 0, .at_most = 1e4})
      .number("accelerometer_noise", &T::accelerometer_noise,
              "White noise, m/s^2/sqrt(Hz).", kSensorError)
      .number("accelerometer_bias_sd_mps2", &T::accelerometer_bias_sd,
              "Constant bias per axis.", kSensorError)
      .number("accelerometer_bias_walk", &T::accelerometer_bias_walk,
              "Random walk of the bias, m/s^2/sqrt(s).", kSensorError)
      .number("accelerometer_scale_sd", &T::accelerometer_scale_sd,
              "Relative scale error per axis.", kSensorError)
      .number("accelerometer_range_mps2", &T::accelerometer_range, "It saturates beyond.",
              {.above = 0, .at_most = 1e5});
}

Fields<sensory::BarometerOptions> barometer_fields() {
  using T = sensory::BarometerOptions;
  return sampled<T>()
      .number("bias_sd_m", &T::bias_sd, "Constant error.", kSensorError)
      .number("drift_sd_m", &T::drift_sd, "Wandering error.", kSensorError)
      .duration_s("drift_time_s", &T::drift_time, "Its correlation time.", {.above = 0})
      .number("noise_sd_m", &T::noise_sd, "White.", kSensorError);
}

Fields<sensory::MagnetometerOptions> magnetometer_fields() {
  using T = sensory::MagnetometerOptions;
  return sampled<T>()
      .angle_deg("declination_deg", &T::declination, "Of the field: east of north.",
                 {.at_least = -180, .at_most = 180})
      .angle_deg("inclination_deg", &T::inclination, "Of the field: below the horizon.",
                 {.at_least = -90, .at_most = 90})
      .number("hard_iron_sd", &T::hard_iron_sd,
              "Constant bias per axis, in field strengths.", kSensorError)
      .number("noise_sd", &T::noise_sd, "White, per axis, in field strengths.",
              kSensorError);
}

Fields<sensory::AirspeedOptions> airspeed_fields() {
  using T = sensory::AirspeedOptions;
  return sampled<T>()
      .number("bias_sd_mps", &T::bias_sd, "Constant error.", kSensorError)
      .number("scale_sd", &T::scale_sd, "Relative scale error.", kSensorError)
      .number("noise_sd_mps", &T::noise_sd, "White.", kSensorError)
      .number("floor_mps", &T::floor, "Slower readings say 0: too little pressure.",
              kSensorError);
}

Fields<sensory::PowerOptions> power_fields() {
  using T = sensory::PowerOptions;
  return sampled<T>()
      .number("voltage_sd_v", &T::voltage_sd, "White.", kSensorError)
      .number("current_sd_a", &T::current_sd, "White.", kSensorError)
      .number("gain_sd", &T::gain_sd, "Relative error of the counted charge.",
              kSensorError)
      .number("drift_sd_per_h", &T::drift_sd,
              "Rate at which counting goes wrong, in charges.", kSensorError)
      .duration_s("motor_delay_s", &T::motor_delay, "Until a motor is known to stand.");
}

Fields<sensory::HeightOptions> height_fields() {
  using T = sensory::HeightOptions;
  return sampled<T>()
      .number("range_m", &T::range, "Higher up it says nothing.",
              {.above = 0, .at_most = 1e5})
      .number("noise_sd_m", &T::noise_sd, "White.", kSensorError)
      .number("relative_sd", &T::relative_sd, "White, of the height.", kSensorError);
}

Fields<sensory::AnemometerOptions> anemometer_fields() {
  using T = sensory::AnemometerOptions;
  return sampled<T>()
      .number("bias_sd_mps", &T::bias_sd, "Wandering error per axis.", kSensorError)
      .duration_s("bias_time_s", &T::bias_time, "Its correlation time.", {.above = 0})
      .number("noise_sd_mps", &T::noise_sd, "White, per axis.", kSensorError);
}

// The actuator channels that are motors.
std::uint8_t motors_of(const Airframe& airframe) {
  if (const auto* rotors = std::get_if<MultirotorAirframe>(&airframe))
    return static_cast<std::uint8_t>((1u << rotors->rotors.size()) - 1);
  const auto* wing = std::get_if<FixedWingAirframe>(&airframe);
  return wing && wing->motor ? std::uint8_t{1u << channel::kThrottle} : std::uint8_t{0};
}

// All that a flight controller has, each with its defaults.
struct FlightSuite {
  GnssKind receiver = GnssKind::kSingle;
};

Fields<FlightSuite> flight_suite_fields() {
  using T = FlightSuite;
  return Fields<T>().word(
      "receiver", &T::receiver, "How the GNSS receiver comes by its position.",
      {{"single", GnssKind::kSingle, "by itself"},
       {"differential", GnssKind::kDifferential, "corrected by a station nearby"},
       {"rtk", GnssKind::kRtk, "by carrier phase: centimetres"}});
}

std::unique_ptr<Sensor> make_flight_suite(const FlightSuite& o,
                                          const AircraftContext& c) {
  using namespace sensory;
  std::vector<SensorSuite::Part> parts;
  const auto add = [&](const char* kind, auto sensor) {
    parts.push_back({kind, std::move(sensor)});
  };
  const auto& id = c.self;
  add("imu", std::make_unique<ImuSensor>(ImuOptions{}, c.seed, id, c.instance));
  GnssReceiverOptions gnss;
  gnss.kind = o.receiver;
  add("gnss-receiver", std::make_unique<GnssReceiver>(gnss, c.seed, id, c.instance));
  add("barometer",
      std::make_unique<Barometer>(BarometerOptions{}, c.seed, id, c.instance));
  add("magnetometer",
      std::make_unique<Magnetometer>(MagnetometerOptions{}, c.seed, id, c.instance));
  if (!std::holds_alternative<MultirotorAirframe>(c.airframe))
    add("airspeed",
        std::make_unique<AirspeedSensor>(AirspeedOptions{}, c.seed, id, c.instance));
  add("height", std::make_unique<HeightSensor>(HeightOptions{}, c.seed, id, c.instance));
  PowerOptions power;
  power.motors = motors_of(c.airframe);
  add("power", std::make_unique<PowerSensor>(power, c.seed, id, c.instance));
  return std::make_unique<SensorSuite>(std::move(parts));
}

}  // namespace

std::optional<double> position_age(const scenario::Choice& sensor, double step) {
  const auto age = [step](double rate_hz, double latency) {
    return std::max(1 / rate_hz, step) + latency;
  };
  if (sensor.kind == "gnss") return age(sensor.as<sensory::GnssOptions>().rate_hz, 0);
  if (sensor.kind == "ideal-navigation")
    return age(sensor.as<sensory::IdealNavigationOptions>().rate_hz, 0);
  if (sensor.kind == "gnss-receiver") {
    const auto& options = sensor.as<GnssReceiverChoice>();
    return age(options.rate_hz, options.latency);
  }
  if (sensor.kind != "flight") return std::nullopt;
  const sensory::GnssReceiverOptions suite;
  return age(suite.rate_hz, suite.latency);
}

void add_flight_sensors(Kinds<Sensor, AircraftContext>& kinds) {
  kinds.add("flight",
            "What a flight controller has: imu, gnss-receiver, barometer, magnetometer, "
            "airspeed (not on multirotors), height and power, each with its defaults.",
            flight_suite_fields(), [](const FlightSuite& o, const AircraftContext& c) {
              return make_flight_suite(o, c);
            });
  kinds.add("imu", "Inertial measurement: turn rates and accelerations.", imu_fields(),
            [](const sensory::ImuOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::ImuSensor>(o, c.seed, c.self, c.instance);
            });
  kinds.add(
      "gnss-receiver", "Satellite navigation, each source of error by itself; outages.",
      gnss_receiver_fields(), [](const GnssReceiverChoice& o, const AircraftContext& c) {
        sensory::GnssReceiverOptions all = o;
        for (const PlannedOutage& outage : o.planned)
          all.outages.spans.push_back(
              {outage.from, outage.until.value_or(OutageSpan{}.until)});
        return std::make_unique<sensory::GnssReceiver>(all, c.seed, c.self, c.instance);
      });
  kinds.add("barometer", "Pressure altitude.", barometer_fields(),
            [](const sensory::BarometerOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::Barometer>(o, c.seed, c.self, c.instance);
            });
  kinds.add("magnetometer", "Direction of the Earth's field.", magnetometer_fields(),
            [](const sensory::MagnetometerOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::Magnetometer>(o, c.seed, c.self,
                                                             c.instance);
            });
  kinds.add("airspeed", "Pitot tube.", airspeed_fields(),
            [](const sensory::AirspeedOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::AirspeedSensor>(o, c.seed, c.self,
                                                               c.instance);
            });
  kinds.add("height", "Height above the ground straight below.", height_fields(),
            [](const sensory::HeightOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::HeightSensor>(o, c.seed, c.self,
                                                             c.instance);
            });
  kinds.add("power", "Battery monitor: voltage, current, charge, standing motors.",
            power_fields(), [](const sensory::PowerOptions& o, const AircraftContext& c) {
              sensory::PowerOptions all = o;
              all.motors = motors_of(c.airframe);
              return std::make_unique<sensory::PowerSensor>(all, c.seed, c.self,
                                                            c.instance);
            });
  kinds.add("anemometer", "Velocity through the air, on board.", anemometer_fields(),
            [](const sensory::AnemometerOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::Anemometer>(o, c.seed, c.self, c.instance);
            });
}

}  // namespace skein::assemble
