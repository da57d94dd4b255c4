#pragma once

#include <array>
#include <cstdint>
#include <variant>

#include "skein/base/time.h"
#include "skein/data/describe.h"
#include "skein/data/object.h"
#include "skein/data/pilot.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"

namespace skein {

// What sensors say. `time` is when it was measured, which may be before it arrives.

/// How a receiver came by its position.
enum class GnssKind : std::uint8_t { kSingle, kDifferential, kRtk };

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

/// The in/out fire sensor: does the ground at the looked-at point burn?
struct FireSample {
  Time time;
  double look_ahead = 0;  ///< horizontal distance of the point ahead of the vehicle [m]
  bool inside = false;
};

/// An ideal edge finder: where the real boundary is, seen from the vehicle. No cheap
/// aircraft has one; it serves the third reading of the tracking benchmark.
struct EdgeSample {
  Time time;
  Vec2 offset = Vec2::Zero();   ///< from the vehicle to the nearest boundary point [m]
  Vec2 tangent = Vec2::Zero();  ///< unit tangent there, fire on its right
};

/// Airspeed and heading, as an air data and attitude system gives them.
struct AirDataSample {
  Time time;
  double airspeed = 0;  ///< [m/s]
  double heading = 0;   ///< [rad]
};

/// Inertial measurement: means over the time since the last sample, as strapdown units
/// integrate them.
struct ImuSample {
  Time time;                   ///< end of the interval
  double interval = 0;         ///< [s]
  Vec3 w_NB_B = Vec3::Zero();  ///< rate of turn [rad/s]
  Vec3 f_B = Vec3::Zero();     ///< specific force: acceleration less gravity [m/s^2]
  std::uint8_t unit = 0;       ///< which of several on board, from 0
};

struct BarometerSample {
  Time time;
  double altitude_msl = 0;  ///< pressure altitude [m]
  std::uint8_t unit = 0;    ///< which of several on board, from 0
};

struct MagnetometerSample {
  Time time;
  Vec3 m_B = Vec3::Zero();  ///< field over its strength, in the body frame
  std::uint8_t unit = 0;    ///< which of several on board, from 0
};

/// Pitot tube.
struct AirspeedSample {
  Time time;
  double airspeed = 0;    ///< [m/s]
  std::uint8_t unit = 0;  ///< which of several on board, from 0
};

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

/// On-board anemometer: velocity of the vehicle through the air.
struct AnemometerSample {
  Time time;
  Vec3 v_AB_B = Vec3::Zero();  ///< [m/s]
};

/// Battery monitor, with the speed of each motor.
struct PowerSample {
  Time time;
  double voltage = 0;                ///< [V]
  double current = 0;                ///< [A]
  double charge = 1;                 ///< left, by counting, from 0 to 1
  std::uint8_t motors_standing = 0;  ///< bit k: actuator channel k is a motor that stands
};

/// What the camera sees of the ground: corners of its picture in order.
struct FootprintSample {
  Time time;
  std::array<Vec2, 4> corners{};
};

/// An object seen by the camera.
struct DetectionSample {
  Time time;
  std::uint32_t object = 0;      ///< which
  Vec2 position = Vec2::Zero();  ///< relative to the vehicle, axes of N [m]
  double position_sd = 0;        ///< per axis [m]
  ObjectClass what = ObjectClass::kPerson;
};

/// Everything about the own motion, without errors: for control without an estimator.
struct TruthSample {
  Time time;
  Vec3 p_N = Vec3::Zero();
  Vec3 v_N = Vec3::Zero();
  Quat q_NB = Quat::Identity();
  Vec3 w_NB_B = Vec3::Zero();
  Vec3 wind_N = Vec3::Zero();
};

/// Something was received from the ground.
struct LinkSample {
  Time time;
};

using SensorSample =
    std::variant<GnssFix, FireSample, EdgeSample, AirDataSample, ImuSample,
                 BarometerSample, MagnetometerSample, AirspeedSample, RangeSample,
                 HeightSample, AnemometerSample, PowerSample, FootprintSample,
                 DetectionSample, TruthSample, LinkSample, PilotInput>;

}  // namespace skein
