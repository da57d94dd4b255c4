// Sensors: one row each.

#include "assemble/kinds_of.h"
#include "layer/sensory/air_data_sensor.h"
#include "layer/sensory/airspeed_sensor.h"
#include "layer/sensory/anemometer.h"
#include "layer/sensory/barometer.h"
#include "layer/sensory/camera.h"
#include "layer/sensory/edge_finder.h"
#include "layer/sensory/fire_sensor.h"
#include "layer/sensory/gnss_receiver.h"
#include "layer/sensory/gnss_sensor.h"
#include "layer/sensory/height_sensor.h"
#include "layer/sensory/ideal_navigation.h"
#include "layer/sensory/imu_sensor.h"
#include "layer/sensory/magnetometer.h"
#include "layer/sensory/power_sensor.h"
#include "layer/sensory/rangefinder.h"
#include "layer/sensory/safety_pilot.h"
#include "layer/sensory/sensor_suite.h"

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

constexpr Range kLatency{.at_least = 0, .at_most = 5};

// Rate and latency, which every sensor has.
template <class T>
Fields<T> sampled() {
  return Fields<T>()
      .number("rate_hz", &T::rate_hz, "Samples per second.", kRate)
      .duration_s("latency_s", &T::latency, "From measuring to arriving.", kLatency);
}

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
              kNotNegative)
      .number("orbit_sd_m", &T::orbit_sd, "By their orbits.", kNotNegative)
      .number("ionosphere_sd_m", &T::ionosphere_sd, "By the ionosphere.", kNotNegative)
      .number("troposphere_sd_m", &T::troposphere_sd, "By the troposphere.", kNotNegative)
      .number("multipath_sd_m", &T::multipath_sd, "By reflections.", kNotNegative)
      .number("noise_sd_m", &T::noise_sd, "By the receiver.", kNotNegative)
      .number("hdop", &T::hdop,
              "Horizontal position error, both axes together, per range error.",
              {.above = 0, .at_most = 100})
      .number("vdop", &T::vdop, "Vertical position error per range error.",
              {.above = 0, .at_most = 100})
      .number("velocity_sd_mps", &T::velocity_sd, "Of the velocity per axis, white.",
              kNotNegative)
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
      .number("gyro_noise", &T::gyro_noise, "White noise, rad/s/sqrt(Hz).", kNotNegative)
      .number("gyro_bias_sd_rad_per_s", &T::gyro_bias_sd, "Constant bias per axis.",
              kNotNegative)
      .number("gyro_bias_walk", &T::gyro_bias_walk,
              "Random walk of the bias, rad/s/sqrt(s).", kNotNegative)
      .number("gyro_scale_sd", &T::gyro_scale_sd, "Relative scale error per axis.",
              kNotNegative)
      .number("gyro_range_rad_per_s", &T::gyro_range, "It saturates beyond.",
              {.above = 0, .at_most = 1e4})
      .number("accelerometer_noise", &T::accelerometer_noise,
              "White noise, m/s^2/sqrt(Hz).", kNotNegative)
      .number("accelerometer_bias_sd_mps2", &T::accelerometer_bias_sd,
              "Constant bias per axis.", kNotNegative)
      .number("accelerometer_bias_walk", &T::accelerometer_bias_walk,
              "Random walk of the bias, m/s^2/sqrt(s).", kNotNegative)
      .number("accelerometer_scale_sd", &T::accelerometer_scale_sd,
              "Relative scale error per axis.", kNotNegative)
      .number("accelerometer_range_mps2", &T::accelerometer_range, "It saturates beyond.",
              {.above = 0, .at_most = 1e5});
}

Fields<sensory::BarometerOptions> barometer_fields() {
  using T = sensory::BarometerOptions;
  return sampled<T>()
      .number("bias_sd_m", &T::bias_sd, "Constant error.", kNotNegative)
      .number("drift_sd_m", &T::drift_sd, "Wandering error.", kNotNegative)
      .duration_s("drift_time_s", &T::drift_time, "Its correlation time.", {.above = 0})
      .number("noise_sd_m", &T::noise_sd, "White.", kNotNegative);
}

Fields<sensory::MagnetometerOptions> magnetometer_fields() {
  using T = sensory::MagnetometerOptions;
  return sampled<T>()
      .angle_deg("declination_deg", &T::declination, "Of the field: east of north.",
                 {.at_least = -180, .at_most = 180})
      .angle_deg("inclination_deg", &T::inclination, "Of the field: below the horizon.",
                 {.at_least = -90, .at_most = 90})
      .number("hard_iron_sd", &T::hard_iron_sd,
              "Constant bias per axis, in field strengths.", kNotNegative)
      .number("noise_sd", &T::noise_sd, "White, per axis, in field strengths.",
              kNotNegative);
}

Fields<sensory::AirspeedOptions> airspeed_fields() {
  using T = sensory::AirspeedOptions;
  return sampled<T>()
      .number("bias_sd_mps", &T::bias_sd, "Constant error.", kNotNegative)
      .number("scale_sd", &T::scale_sd, "Relative scale error.", kNotNegative)
      .number("noise_sd_mps", &T::noise_sd, "White.", kNotNegative)
      .number("floor_mps", &T::floor, "Slower readings say 0: too little pressure.",
              kNotNegative);
}

Fields<sensory::PowerOptions> power_fields() {
  using T = sensory::PowerOptions;
  return sampled<T>()
      .number("voltage_sd_v", &T::voltage_sd, "White.", kNotNegative)
      .number("current_sd_a", &T::current_sd, "White.", kNotNegative)
      .number("gain_sd", &T::gain_sd, "Relative error of the counted charge.",
              kNotNegative)
      .number("drift_sd_per_h", &T::drift_sd,
              "Rate at which counting goes wrong, in charges.", kNotNegative)
      .duration_s("motor_delay_s", &T::motor_delay, "Until a motor is known to stand.");
}

Fields<sensory::IdealNavigationOptions> ideal_navigation_fields() {
  using T = sensory::IdealNavigationOptions;
  return Fields<T>().number("rate_hz", &T::rate_hz, "Samples per second.", kRate);
}

Fields<sensory::HeightOptions> height_fields() {
  using T = sensory::HeightOptions;
  return sampled<T>()
      .number("range_m", &T::range, "Higher up it says nothing.",
              {.above = 0, .at_most = 1e5})
      .number("noise_sd_m", &T::noise_sd, "White.", kNotNegative)
      .number("relative_sd", &T::relative_sd, "White, of the height.", kNotNegative);
}

Fields<sensory::AnemometerOptions> anemometer_fields() {
  using T = sensory::AnemometerOptions;
  return sampled<T>()
      .number("bias_sd_mps", &T::bias_sd, "Wandering error per axis.", kNotNegative)
      .duration_s("bias_time_s", &T::bias_time, "Its correlation time.", {.above = 0})
      .number("noise_sd_mps", &T::noise_sd, "White, per axis.", kNotNegative);
}

// What rangefinder and LiDAR have in common.
template <class T>
Fields<T> ranging() {
  return sampled<T>()
      .number("range_m", &T::range, "Furthest it sees.", {.above = 0, .at_most = 1e5})
      .number("bias_sd_m", &T::bias_sd, "Wandering error.", kNotNegative)
      .duration_s("bias_time_s", &T::bias_time, "Its correlation time.", {.above = 0})
      .number("noise_sd_m", &T::noise_sd, "White.", kNotNegative);
}

Fields<sensory::RangefinderOptions> rangefinder_fields() {
  using T = sensory::RangefinderOptions;
  return ranging<T>()
      .angle_deg("azimuth_deg", &T::azimuth, "Of the beam: from forward to the right.")
      .angle_deg("depression_deg", &T::depression, "Of the beam: below forward.",
                 {.at_least = -90, .at_most = 90});
}

Fields<sensory::LidarOptions> lidar_fields() {
  using T = sensory::LidarOptions;
  return ranging<T>()
      .integer("beams", &T::beams, "Evenly spaced over the field of view.",
               {.at_least = 1, .at_most = 10000})
      .angle_deg("field_of_view_deg", &T::field_of_view,
                 "From the first beam to the last.", {.at_least = 0, .at_most = 360})
      .angle_deg("depression_deg", &T::depression, "Of the middle beam: below forward.",
                 {.at_least = -90, .at_most = 90});
}

Fields<sensory::CameraOptions> camera_fields() {
  using T = sensory::CameraOptions;
  return sampled<T>()
      .angle_deg("width_deg", &T::width, "Field of view across.",
                 {.above = 0, .below = 170})
      .angle_deg("length_deg", &T::length, "Field of view along.",
                 {.above = 0, .below = 170})
      .number("range_m", &T::range, "Furthest at which objects can be made out.",
              {.above = 0, .at_most = 1e5})
      .number("detection", &T::detection,
              "Probability that a visible object is found, per picture.", kProbability)
      .number("position_sd_m", &T::position_sd, "Of a found position per axis.",
              kNotNegative)
      .angle_deg("direction_sd_deg", &T::direction_sd, "Of the direction to it.",
                 {.at_least = 0, .at_most = 45});
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
      .number("rate_hz", &T::rate_hz, "Of the receiver's output.", kRate)
      .object("takeovers", &T::takeovers, takeover_fields(), "When the pilot flies.")
      .items({.at_most = 1000});
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
  kinds.add(
      "gnss-receiver", "Satellite navigation, each source of error by itself; outages.",
      gnss_receiver_fields(), [](const GnssReceiverChoice& o, const AircraftContext& c) {
        sensory::GnssReceiverOptions all = o;
        for (const PlannedOutage& outage : o.planned)
          all.outages.spans.push_back(
              {outage.from, outage.until.value_or(sensory::OutageSpan{}.until)});
        return std::make_unique<sensory::GnssReceiver>(all, c.seed, c.self, c.instance);
      });
  kinds.add("imu", "Inertial measurement: turn rates and accelerations.", imu_fields(),
            [](const sensory::ImuOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::ImuSensor>(o, c.seed, c.self, c.instance);
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
  kinds.add("power", "Battery monitor: voltage, current, charge, standing motors.",
            power_fields(), [](const sensory::PowerOptions& o, const AircraftContext& c) {
              sensory::PowerOptions all = o;
              all.motors = motors_of(c.airframe);
              return std::make_unique<sensory::PowerSensor>(all, c.seed, c.self,
                                                            c.instance);
            });
  kinds.add("flight",
            "What a flight controller has: imu, gnss-receiver, barometer, magnetometer, "
            "airspeed (not on multirotors), height and power, each with its defaults.",
            flight_suite_fields(), [](const FlightSuite& o, const AircraftContext& c) {
              return make_flight_suite(o, c);
            });
  kinds.add("height", "Height above the ground straight below.", height_fields(),
            [](const sensory::HeightOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::HeightSensor>(o, c.seed, c.self,
                                                             c.instance);
            });
  kinds.add("anemometer", "Velocity through the air, on board.", anemometer_fields(),
            [](const sensory::AnemometerOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::Anemometer>(o, c.seed, c.self, c.instance);
            });
  kinds.add("rangefinder", "Distance to the ground along one beam.", rangefinder_fields(),
            [](const sensory::RangefinderOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::Rangefinder>(o, c.seed, c.self,
                                                            c.instance);
            });
  kinds.add("lidar", "Distances to the ground along a fan of beams.", lidar_fields(),
            [](const sensory::LidarOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::Lidar>(o, c.seed, c.self, c.instance);
            });
  kinds.add("camera", "Looks down: its footprint, and objects that it finds there.",
            camera_fields(),
            [](const sensory::CameraOptions& o, const AircraftContext& c) {
              return std::make_unique<sensory::Camera>(o, c.seed, c.self, c.instance);
            });
  kinds.add("safety-pilot", "The safety pilot's transmitter: takes over when planned.",
            safety_pilot_fields(),
            [](const sensory::SafetyPilotOptions& o, const AircraftContext&) {
              return std::make_unique<sensory::SafetyPilot>(o);
            });
  kinds.add("ideal-navigation", "The true motion: for control without an estimator.",
            ideal_navigation_fields(),
            [](const sensory::IdealNavigationOptions& o, const AircraftContext&) {
              return std::make_unique<sensory::IdealNavigation>(o);
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
