// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "skein/base/math.h"
#include "skein/link/vehicle_services/message_numbers.h"
#include "skein/link/vehicle_services/places.h"
#include "skein/link/vehicle_services/telemetry.h"

namespace skein::vehicle_services {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint16_t kUnknown16 = 65'535;
// A dilution of precision of 1 is an error of so much per axis [m].
constexpr double kRangeError = 2;
// Slower than this, a direction of flight means nothing [m/s].
constexpr double kMinCourseSpeed = 0.5;

// Hundredths of a degree from 0 to 35999.
std::uint16_t centidegrees(double angle) {
  return static_cast<std::uint16_t>(
      rounded<std::uint16_t>(geo::degrees(geo::wrap_2pi(angle)) * 100) % 36'000);
}

struct MapPlace {
  std::int32_t lat, lon;
};
MapPlace on_map(const ServedVehicle& v, const Vec3& p_N) {
  const geo::Geodetic place = v.frame.from_plane(geo::horizontal(p_N));
  return {degrees_e7(place.latitude_deg), degrees_e7(place.longitude_deg)};
}

std::int32_t millimetres(double metres) {
  return rounded<std::int32_t>(metres * 1000);
}

double ground_speed(const ServedVehicle& v) {
  return geo::horizontal(v.snapshot.motion.v_N).norm();
}

}  // namespace

mavlink::GpsRawInt gps_raw_int(const ServedVehicle& v) {
  const VehicleMotion& motion = v.snapshot.motion;
  mavlink::GpsRawInt m;
  m.time_usec = boot_us(motion.time);
  m.satellites_visible = 255;  // not known
  m.eph = m.epv = m.vel = m.cog = kUnknown16;
  m.fix_type = static_cast<std::uint8_t>(mavlink::GpsFix::kNoFix);
  if (!v.snapshot.condition.position) return m;
  m.fix_type = static_cast<std::uint8_t>(mavlink::GpsFix::k3d);
  const auto [lat, lon] = on_map(v, motion.p_N);
  m.lat = lat;
  m.lon = lon;
  m.alt = m.alt_ellipsoid = millimetres(v.altitude_msl());
  m.eph = rounded_below_max<std::uint16_t>(motion.position_sd / kRangeError * 100);
  m.epv = rounded_below_max<std::uint16_t>(motion.altitude_sd / kRangeError * 100);
  m.vel = rounded_below_max<std::uint16_t>(ground_speed(v) * 100);
  if (ground_speed(v) >= kMinCourseSpeed)
    m.cog = centidegrees(geo::bearing(geo::horizontal(motion.v_N)));
  m.h_acc = rounded<std::uint32_t>(motion.position_sd * 1000);
  m.v_acc = rounded<std::uint32_t>(motion.altitude_sd * 1000);
  return m;
}

mavlink::GlobalPositionInt global_position_int(const ServedVehicle& v) {
  const VehicleMotion& motion = v.snapshot.motion;
  const auto [lat, lon] = on_map(v, motion.p_N);
  mavlink::GlobalPositionInt m;
  m.time_boot_ms = boot_ms(motion.time);
  m.lat = lat;
  m.lon = lon;
  m.alt = millimetres(v.altitude_msl());
  m.relative_alt = millimetres(v.altitude_msl() - v.home_msl());
  m.vx = rounded<std::int16_t>(motion.v_N.x() * 100);
  m.vy = rounded<std::int16_t>(motion.v_N.y() * 100);
  m.vz = rounded<std::int16_t>(motion.v_N.z() * 100);
  m.hdg = centidegrees(geo::yaw(motion.q_NB));
  return m;
}

mavlink::LocalPositionNed local_position_ned(const ServedVehicle& v) {
  const VehicleMotion& motion = v.snapshot.motion;
  const Vec3 p = v.from_origin(motion.p_N);
  mavlink::LocalPositionNed m;
  m.time_boot_ms = boot_ms(motion.time);
  m.x = as_float(p.x());
  m.y = as_float(p.y());
  m.z = as_float(p.z());
  m.vx = as_float(motion.v_N.x());
  m.vy = as_float(motion.v_N.y());
  m.vz = as_float(motion.v_N.z());
  return m;
}

mavlink::Attitude attitude(const ServedVehicle& v) {
  const VehicleMotion& motion = v.snapshot.motion;
  const geo::Euler angles = geo::to_euler(motion.q_NB);
  mavlink::Attitude m;
  m.time_boot_ms = boot_ms(motion.time);
  m.roll = as_float(angles.roll);
  m.pitch = as_float(angles.pitch);
  m.yaw = as_float(angles.yaw);
  m.rollspeed = as_float(motion.w_NB_B.x());
  m.pitchspeed = as_float(motion.w_NB_B.y());
  m.yawspeed = as_float(motion.w_NB_B.z());
  return m;
}

mavlink::AttitudeQuaternion attitude_quaternion(const ServedVehicle& v) {
  const VehicleMotion& motion = v.snapshot.motion;
  mavlink::AttitudeQuaternion m;
  m.time_boot_ms = boot_ms(motion.time);
  m.q1 = as_float(motion.q_NB.w());
  m.q2 = as_float(motion.q_NB.x());
  m.q3 = as_float(motion.q_NB.y());
  m.q4 = as_float(motion.q_NB.z());
  m.rollspeed = as_float(motion.w_NB_B.x());
  m.pitchspeed = as_float(motion.w_NB_B.y());
  m.yawspeed = as_float(motion.w_NB_B.z());
  return m;
}

mavlink::VfrHud vfr_hud(const ServedVehicle& v) {
  const VehicleMotion& motion = v.snapshot.motion;
  mavlink::VfrHud m;
  m.airspeed = as_float(motion.airspeed);
  m.groundspeed = as_float(ground_speed(v));
  m.heading = static_cast<std::int16_t>(centidegrees(geo::yaw(motion.q_NB)) / 100);
  m.throttle = rounded<std::uint16_t>(v.snapshot.throttle * 100);
  m.alt = as_float(v.altitude_msl());
  m.climb = as_float(-motion.v_N.z());
  return m;
}

mavlink::Wind wind(const ServedVehicle& v) {
  mavlink::Wind m;
  // Where it comes from.
  m.direction =
      as_float(geo::degrees(geo::wrap_2pi(geo::bearing(-v.snapshot.motion.wind_N))));
  m.speed = as_float(v.snapshot.motion.wind_N.norm());
  return m;
}

mavlink::WindCov wind_cov(const ServedVehicle& v) {
  mavlink::WindCov m;
  m.time_usec = boot_us(v.snapshot.motion.time);
  m.wind_x = as_float(v.snapshot.motion.wind_N.x());
  m.wind_y = as_float(v.snapshot.motion.wind_N.y());
  m.wind_alt = as_float(v.altitude_msl());
  m.wind_z = m.var_horiz = m.var_vert = m.horiz_accuracy = m.vert_accuracy = kUnknown;
  return m;
}

mavlink::HomePosition home_position(const ServedVehicle& v) {
  const auto [lat, lon] = on_map(v, v.snapshot.home_N);
  const Vec3 p = v.from_origin(v.snapshot.home_N);
  mavlink::HomePosition m;
  m.latitude = lat;
  m.longitude = lon;
  m.altitude = millimetres(v.home_msl());
  m.x = as_float(p.x());
  m.y = as_float(p.y());
  m.z = as_float(p.z());
  m.q.fill(kUnknown);
  m.approach_x = m.approach_y = m.approach_z = kUnknown;
  m.time_usec = boot_us(v.now.simulated);
  return m;
}

mavlink::GpsGlobalOrigin gps_global_origin(const ServedVehicle& v) {
  const auto [lat, lon] = on_map(v, v.origin_N);
  mavlink::GpsGlobalOrigin m;
  m.latitude = lat;
  m.longitude = lon;
  m.altitude = millimetres(-v.origin_N.z());
  m.time_usec = boot_us(v.now.simulated);
  return m;
}

}  // namespace skein::vehicle_services
