// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/hil.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "skein/data/vehicle/air.h"

namespace skein::physics {
namespace {

// Of `fields_updated`.
constexpr std::uint32_t kAccelerometer = 0x007, kGyro = 0x038, kMagnetometer = 0x1C0;
constexpr std::uint32_t kBarometer = 0x1A00;  // pressure, altitude and temperature
constexpr std::uint32_t kPitot = 0x400;

constexpr std::uint16_t kUnknownCourse = 65'535;
constexpr double kSlow = 0.1;  // less has no course [m/s]
constexpr double kFreezing = 273.15;
constexpr std::uint8_t kArmedFlag = 128;    // of `mode`
constexpr std::uint64_t kLockStepFlag = 1;  // of `flags`

// The nearest number of a type.
template <class Int>
Int nearest(double value) {
  using Limits = std::numeric_limits<Int>;
  if (std::isnan(value)) return 0;
  return static_cast<Int>(
      std::clamp<double>(std::round(value), Limits::min(), Limits::max()));
}

std::int32_t degrees_e7(double degrees) {
  return nearest<std::int32_t>(degrees * 1e7);
}

std::uint64_t microseconds(Time time) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(time.ns(), 0) / 1000);
}

std::uint16_t course_cdeg(const Vec2& v) {
  if (!(v.norm() >= kSlow)) return kUnknownCourse;
  const double course = geo::degrees(geo::wrap_2pi(geo::bearing(v)));
  return static_cast<std::uint16_t>(nearest<int>(course * 100) % 36'000);
}

void set(float& x, float& y, float& z, const Vec3& v) {
  x = static_cast<float>(v.x());
  y = static_cast<float>(v.y());
  z = static_cast<float>(v.z());
}

template <class Int>
void set(Int& x, Int& y, Int& z, const Vec3& v, double unit) {
  x = nearest<Int>(v.x() / unit);
  y = nearest<Int>(v.y() / unit);
  z = nearest<Int>(v.z() / unit);
}

}  // namespace

mavlink::HilSensor message_of(const HilSensors& sensors) {
  mavlink::HilSensor m;
  m.time_usec = microseconds(sensors.time);
  m.id = sensors.unit;
  if (sensors.imu) {
    set(m.xacc, m.yacc, m.zacc, sensors.imu->f_B);
    set(m.xgyro, m.ygyro, m.zgyro, sensors.imu->w_NB_B);
    m.fields_updated |= kAccelerometer | kGyro;
  }
  if (sensors.field_B_gauss) {
    set(m.xmag, m.ymag, m.zmag, *sensors.field_B_gauss);
    m.fields_updated |= kMagnetometer;
  }
  if (sensors.barometer) {
    m.abs_pressure = static_cast<float>(sensors.barometer->pressure / 100);
    m.pressure_alt = static_cast<float>(sensors.barometer->altitude);
    m.temperature = static_cast<float>(sensors.barometer->temperature - kFreezing);
    m.fields_updated |= kBarometer;
  }
  if (sensors.pitot_pressure) {
    m.diff_pressure = static_cast<float>(*sensors.pitot_pressure / 100);
    m.fields_updated |= kPitot;
  }
  return m;
}

mavlink::HilGps message_of(const HilFix& fix) {
  mavlink::HilGps m;
  m.time_usec = static_cast<std::uint64_t>(std::max<std::int64_t>(fix.utc_us, 0));
  m.id = fix.unit;
  m.fix_type = static_cast<std::uint8_t>(fix.type);
  m.lat = degrees_e7(fix.latitude_deg);
  m.lon = degrees_e7(fix.longitude_deg);
  m.alt = nearest<std::int32_t>(fix.alt_msl * 1000);
  m.eph = nearest<std::uint16_t>(fix.position_sd * 100);
  m.epv = nearest<std::uint16_t>(fix.altitude_sd * 100);
  m.vel = nearest<std::uint16_t>(geo::horizontal(fix.v_N).norm() * 100);
  set(m.vn, m.ve, m.vd, fix.v_N, 0.01);
  m.cog = course_cdeg(geo::horizontal(fix.v_N));
  m.satellites_visible = fix.satellites;
  return m;
}

mavlink::HilStateQuaternion message_of(const HilTruth& truth) {
  mavlink::HilStateQuaternion m;
  m.time_usec = microseconds(truth.time);
  m.attitude_quaternion = {
      static_cast<float>(truth.q_NB.w()), static_cast<float>(truth.q_NB.x()),
      static_cast<float>(truth.q_NB.y()), static_cast<float>(truth.q_NB.z())};
  set(m.rollspeed, m.pitchspeed, m.yawspeed, truth.w_NB_B);
  m.lat = degrees_e7(truth.latitude_deg);
  m.lon = degrees_e7(truth.longitude_deg);
  m.alt = nearest<std::int32_t>(truth.alt_msl * 1000);
  set(m.vx, m.vy, m.vz, truth.v_N, 0.01);
  m.ind_airspeed = nearest<std::uint16_t>(truth.indicated_airspeed * 100);
  m.true_airspeed = nearest<std::uint16_t>(truth.true_airspeed * 100);
  set(m.xacc, m.yacc, m.zacc, truth.a_B, kGravity / 1000);
  return m;
}

HilControls controls_of(const mavlink::HilActuatorControls& message) {
  constexpr auto kMaxMicroseconds =
      static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() / 1000);
  HilControls controls;
  controls.time = Time::from_ns(
      static_cast<std::int64_t>(std::min(message.time_usec, kMaxMicroseconds)) * 1000);
  for (std::size_t k = 0; k < HilControls::kChannels; ++k) {
    const double value = message.controls[k];
    controls.channel[k] = std::isnan(value) ? 0 : std::clamp(value, -1.0, 1.0);
  }
  controls.armed = (message.mode & kArmedFlag) != 0;
  controls.lock_step = (message.flags & kLockStepFlag) != 0;
  return controls;
}

}  // namespace skein::physics
