// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <variant>

#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/perimeter/object.h"
#include "skein/data/traffic/traffic.h"
#include "skein/data/vehicle/pilot.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

namespace skein {

// What sensors say. `time` is when it was measured, which may be before it arrives.

/// How a receiver came by its position.
enum class GnssKind : std::uint8_t { kSingle, kDifferential, kRtk };
constexpr auto names_of(const GnssKind*) {
  return std::to_array<std::string_view>({"single", "differential", "rtk"});
}

/// Position and velocity from satellites. Without a fix there is none.
struct GnssFix {
  Time time;
  Vec3 p_N = Vec3::Zero();
  Vec3 v_N = Vec3::Zero();
  double position_sd = 0;  ///< per horizontal axis, as the receiver states it [m]
  double altitude_sd = 0;  ///< [m]
  double velocity_sd = 0;  ///< per axis [m/s]
  GnssKind kind = GnssKind::kSingle;
  std::uint8_t unit = 0;  ///< which of several on board, from 0
};

constexpr auto describe(const GnssFix*) {
  using T = GnssFix;
  return described<T>(
      {"gnss_fix"}, "Position and velocity from satellites.",
      field("time", &T::time, "when it was measured"),
      field("", &T::p_N, axes::kPlace, "position"),
      field("", &T::v_N, axes::kVelocity, "over ground"),
      field("position_sd", &T::position_sd, unit::kMetre, "per horizontal axis"),
      field("altitude_sd", &T::altitude_sd, unit::kMetre, "of the altitude"),
      field("velocity_sd", &T::velocity_sd, unit::kMetrePerSecond, "per axis"),
      field("gnss_kind", &T::kind, "how the receiver came by it"),
      field("unit", &T::unit, "which of several on board"));
}

/// The in/out fire sensor: does the ground at the looked-at point burn?
struct FireSample {
  Time time;
  double look_ahead = 0;  ///< horizontal distance of the point ahead of the vehicle [m]
  bool inside = false;
};

constexpr auto describe(const FireSample*) {
  using T = FireSample;
  return described<T>(
      {"fire"}, "Whether the ground at the point looked at burns.",
      field("time", &T::time, "when it was measured"),
      field("look_ahead", &T::look_ahead, unit::kMetre, "from the vehicle to the point"),
      field("inside", &T::inside, "it burns"));
}

/// An ideal edge finder: where the real boundary is, seen from the vehicle. No cheap
/// aircraft has one; it serves the third reading of the tracking benchmark.
struct EdgeSample {
  Time time;
  Vec2 offset = Vec2::Zero();   ///< from the vehicle to the nearest boundary point [m]
  Vec2 tangent = Vec2::Zero();  ///< unit tangent there, fire on its right
};

constexpr auto describe(const EdgeSample*) {
  using T = EdgeSample;
  return described<T>(
      {"edge"}, "Where the real boundary is, seen from the vehicle.",
      field("time", &T::time, "when it was measured"),
      field("", &T::offset, axes::kOffset, "to the nearest point of the boundary"),
      field("tangent", &T::tangent, axes::kDirection, "there, fire on its right"));
}

/// Airspeed and heading, as an air data and attitude system gives them.
struct AirDataSample {
  Time time;
  double airspeed = 0;  ///< [m/s]
  double heading = 0;   ///< [rad]
};

constexpr auto describe(const AirDataSample*) {
  using T = AirDataSample;
  return described<T>(
      {"air_data"}, "Airspeed and heading of an air data system.",
      field("time", &T::time, "when it was measured"),
      field("airspeed", &T::airspeed, unit::kMetrePerSecond, "through the air"),
      field("heading", &T::heading, unit::kDegree, "clockwise from north"));
}

/// Inertial measurement: means over the time since the last sample, as strapdown units
/// integrate them.
struct ImuSample {
  Time time;                   ///< end of the interval
  double interval = 0;         ///< [s]
  Vec3 w_NB_B = Vec3::Zero();  ///< rate of turn [rad/s]
  Vec3 f_B = Vec3::Zero();     ///< specific force: acceleration less gravity [m/s^2]
  std::uint8_t unit = 0;       ///< which of several on board, from 0
};

constexpr auto describe(const ImuSample*) {
  using T = ImuSample;
  return described<T>(
      {"imu"}, "Means of inertial measurements over an interval.",
      field("time", &T::time, "when it was measured"),
      field("interval", &T::interval, unit::kSecond, "that ends at the time"),
      field("", &T::w_NB_B, axes::kBodyRates, "rates of turn"),
      field("force", &T::f_B, axes::kBodyDirection, "specific, in m/s^2"),
      field("unit", &T::unit, "which of several on board"));
}

struct BarometerSample {
  Time time;
  double altitude_msl = 0;  ///< pressure altitude [m]
  std::uint8_t unit = 0;    ///< which of several on board, from 0
};

constexpr auto describe(const BarometerSample*) {
  using T = BarometerSample;
  return described<T>(
      {"barometer"}, "Altitude by pressure.",
      field("time", &T::time, "when it was measured"),
      field("altitude_msl", &T::altitude_msl, unit::kMetre, "by pressure"),
      field("unit", &T::unit, "which of several on board"));
}

struct MagnetometerSample {
  Time time;
  Vec3 m_B = Vec3::Zero();  ///< field over its strength, in the body frame
  std::uint8_t unit = 0;    ///< which of several on board, from 0
};

constexpr auto describe(const MagnetometerSample*) {
  using T = MagnetometerSample;
  return described<T>({"magnetometer"}, "Direction of the magnetic field.",
                      field("time", &T::time, "when it was measured"),
                      field("field", &T::m_B, axes::kBodyDirection, "over its strength"),
                      field("unit", &T::unit, "which of several on board"));
}

/// Pitot tube.
struct AirspeedSample {
  Time time;
  double airspeed = 0;    ///< [m/s]
  std::uint8_t unit = 0;  ///< which of several on board, from 0
};

constexpr auto describe(const AirspeedSample*) {
  using T = AirspeedSample;
  return described<T>(
      {"airspeed"}, "Pitot tube.", field("time", &T::time, "when it was measured"),
      field("airspeed", &T::airspeed, unit::kMetrePerSecond, "through the air"),
      field("unit", &T::unit, "which of several on board"));
}

/// Distance along one beam.
struct RangeSample {
  Time time;
  Vec3 beam_B = Vec3::Zero();  ///< unit vector
  double range = 0;            ///< [m]; 0 = nothing within reach
};

constexpr auto describe(const RangeSample*) {
  using T = RangeSample;
  return described<T>(
      {"range"}, "Distance along one beam.",
      untabled(field("time", &T::time, "when it was measured")),
      field("", &T::beam_B, axes::kBodyDirection, "unit vector of the beam in the body"),
      field("range", &T::range, unit::kMetre, "0: nothing within reach"));
}

/// Height above the ground straight below.
struct HeightSample {
  Time time;
  double height_agl = 0;  ///< [m]
};

constexpr auto describe(const HeightSample*) {
  using T = HeightSample;
  return described<T>(
      {"height"}, "Height above the ground straight below.",
      field("time", &T::time, "when it was measured"),
      field("height_agl", &T::height_agl, unit::kMetre, "above the ground"));
}

/// On-board anemometer: velocity of the vehicle through the air.
struct AnemometerSample {
  Time time;
  Vec3 v_AB_B = Vec3::Zero();  ///< [m/s]
};

constexpr auto describe(const AnemometerSample*) {
  using T = AnemometerSample;
  return described<T>({"anemometer"}, "Velocity of the vehicle through the air.",
                      field("time", &T::time, "when it was measured"),
                      field("air_velocity", &T::v_AB_B, axes::kBodyDirection, "in m/s"));
}

/// Battery monitor, with the speed of each motor.
struct PowerSample {
  Time time;
  double voltage = 0;                ///< [V]
  double current = 0;                ///< [A]
  double charge = 1;                 ///< left, by counting, from 0 to 1
  std::uint8_t motors_standing = 0;  ///< bit k: actuator channel k is a motor that stands
};

constexpr auto describe(const PowerSample*) {
  using T = PowerSample;
  return described<T>(
      {"power"}, "Battery monitor.", field("time", &T::time, "when it was measured"),
      field("voltage", &T::voltage, unit::kVolt, "under load"),
      field("current", &T::current, "in ampere"),
      field("charge", &T::charge, "left, from 0 to 1"),
      field("motors_standing", &T::motors_standing, "bit k: motor k stands"));
}

/// What the camera sees of the ground: corners of its picture in order.
struct FootprintSample {
  Time time;
  std::array<Vec2, 4> corners{};
};

constexpr auto describe(const FootprintSample*) {
  using T = FootprintSample;
  return described<T>({"footprint"}, "The ground in a camera's picture.",
                      field("time", &T::time, "when it was measured"),
                      field("corner", &T::corners, axes::kOffset, "in order"));
}

/// An object seen by the camera.
struct DetectionSample {
  Time time;
  std::uint32_t object = 0;      ///< which
  Vec2 position = Vec2::Zero();  ///< relative to the vehicle, axes of N [m]
  double position_sd = 0;        ///< per axis [m]
  ObjectClass what = ObjectClass::kPerson;
};

constexpr auto describe(const DetectionSample*) {
  using T = DetectionSample;
  return described<T>({"detection"}, "An object seen by a camera.",
                      field("time", &T::time, "when it was measured"),
                      field("object_id", &T::object, "which"),
                      field("", &T::position, axes::kOffset, "from the vehicle"),
                      field("position_sd", &T::position_sd, unit::kMetre, "per axis"),
                      field("class", &T::what, "what it is"));
}

/// Everything about the own motion, without errors: for control without an estimator.
struct TruthSample {
  Time time;
  Vec3 p_N = Vec3::Zero();
  Vec3 v_N = Vec3::Zero();
  Quat q_NB = Quat::Identity();
  Vec3 w_NB_B = Vec3::Zero();
  Vec3 wind_N = Vec3::Zero();
};

constexpr auto describe(const TruthSample*) {
  using T = TruthSample;
  return described<T>({"truth"}, "Everything about the own motion, without errors.",
                      field("time", &T::time, "when it was measured"),
                      field("", &T::p_N, axes::kPlace, "position"),
                      field("", &T::v_N, axes::kVelocity, "over ground"),
                      field("", &T::q_NB, "attitude"),
                      field("", &T::w_NB_B, axes::kBodyRates, "rates of turn"),
                      field("", &T::wind_N, axes::kWind, "at the vehicle"));
}

/// Something was received from the ground.
struct LinkSample {
  Time time;
};

constexpr auto describe(const LinkSample*) {
  using T = LinkSample;
  return described<T>({"link"}, "Something was received from the ground.",
                      field("time", &T::time, "when it was measured"));
}

/// New kinds go to the end: the place in this list is part of the wire form.
using SensorSample =
    std::variant<GnssFix, FireSample, EdgeSample, AirDataSample, ImuSample,
                 BarometerSample, MagnetometerSample, AirspeedSample, RangeSample,
                 HeightSample, AnemometerSample, PowerSample, FootprintSample,
                 DetectionSample, TruthSample, LinkSample, PilotInput, TrafficBroadcast,
                 RadarPlot, TransponderContact>;

}  // namespace skein
