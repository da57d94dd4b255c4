// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "skein/base/time.h"
#include "skein/geo/rotation.h"
#include "skein/geo/vec.h"
#include "skein/link/mavlink/messages.h"

/// What a simulator exchanges with an autopilot that has its sensors from outside (PX4's
/// simulator interface, HIL messages of MAVLink). SI units here; the messages have
/// theirs.
namespace skein::physics {

struct HilImu {
  Vec3 f_B = Vec3::Zero();     ///< specific force: acceleration less gravity [m/s^2]
  Vec3 w_NB_B = Vec3::Zero();  ///< rate of turn [rad/s]
};

struct HilBarometer {
  double pressure = 0;     ///< static [Pa]
  double altitude = 0;     ///< that this pressure stands for [m]
  double temperature = 0;  ///< of the air [K]
};

/// What the sensors of an autopilot measure at one time. PX4 takes a sensor whole or not
/// at all: what is not there has no new value.
struct HilSensors {
  Time time;
  /// Which of several: up to 3 inertial units, 2 magnetometers, 2 barometers, from 0.
  /// The time of number 0 is the autopilot's clock in lock-step.
  std::uint8_t unit = 0;
  std::optional<HilImu> imu;
  std::optional<Vec3> field_B_gauss;  ///< magnetic
  std::optional<HilBarometer> barometer;
  std::optional<double> pitot_pressure;  ///< over static; positive forward [Pa]
};

enum class HilFixType : std::uint8_t { kNone = 0, k2D = 2, k3D = 3 };

/// A fix of a satellite receiver.
struct HilFix {
  std::int64_t utc_us = 0;  ///< microseconds since 1970: sets the autopilot's calendar
  std::uint8_t unit = 0;    ///< which of up to 3 receivers, from 0
  HilFixType type = HilFixType::k3D;
  double latitude_deg = 0;
  double longitude_deg = 0;
  double alt_msl = 0;       ///< [m]
  double position_sd = 0;   ///< horizontal [m]
  double altitude_sd = 0;   ///< [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
  std::uint8_t satellites = 0;
};

/// The true motion. PX4 in SITL writes it to its log, nothing more.
struct HilTruth {
  Time time;
  double latitude_deg = 0;
  double longitude_deg = 0;
  double alt_msl = 0;            ///< [m]
  Vec3 v_N = Vec3::Zero();       ///< over ground [m/s]
  Quat q_NB = Quat::Identity();  ///< attitude
  Vec3 w_NB_B = Vec3::Zero();    ///< rate of turn [rad/s]
  Vec3 a_B = Vec3::Zero();  ///< change of the velocity over ground; 0 at rest [m/s^2]
  double indicated_airspeed = 0;  ///< [m/s]
  double true_airspeed = 0;       ///< [m/s]
};

/// What the autopilot commands: motors from 0 to 1, surfaces from -1 to 1.
struct HilControls {
  static constexpr std::size_t kChannels = 16;

  Time time;  ///< by the autopilot's clock
  std::array<double, kChannels> channel{};
  bool armed = false;
  bool lock_step = false;  ///< it runs by the simulator's clock
};

/// HIL_SENSOR: accelerations m/s^2, rates rad/s, field gauss, pressures hPa, temperature
/// degC; `fields_updated` has all bits of the sensors that are there, and no others.
mavlink::HilSensor message_of(const HilSensors& sensors);

/// HIL_GPS: degrees 1e-7, mm, cm, cm/s; the course is unknown below 0.1 m/s. What no
/// number of the message can say becomes the nearest that it can.
mavlink::HilGps message_of(const HilFix& fix);

/// HIL_STATE_QUATERNION: degrees 1e-7, mm, cm/s, thousandths of gravity. As above.
mavlink::HilStateQuaternion message_of(const HilTruth& truth);

/// What an autopilot has sent, made safe: not a number is 0, others are within -1 to 1.
HilControls controls_of(const mavlink::HilActuatorControls& message);

}  // namespace skein::physics
