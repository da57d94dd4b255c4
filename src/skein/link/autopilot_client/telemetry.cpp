// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/telemetry.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"

namespace skein::autopilot_client {
namespace {

// What is beyond is no telemetry.
constexpr double kMaxAngle = 10;    // [rad]
constexpr double kMaxTurn = 1000;   // [rad/s]
constexpr double kMaxSpeed = 1000;  // [m/s], and of a direction [deg]
constexpr std::int32_t kPole = 900'000'000, kHalfTurn = 1'800'000'000;  // [1e-7 deg]

constexpr std::uint8_t kLandedOnGround = 1;  // MAV_LANDED_STATE
constexpr std::uint8_t kStatusCritical = 5;  // MAV_STATE
constexpr std::uint8_t kStatusEmergency = 6;
constexpr std::uint32_t kPreArmCheck = 0x1000'0000;  // MAV_SYS_STATUS
constexpr std::uint16_t kUnknown16 = 0xffff;
constexpr std::uint8_t kUnknown8 = 0xff;
constexpr double kTypicalPositionSd = 2;  // of a receiver that does not say [m]
constexpr double kDeadReckoning = 2;      // growth of its deviation [m/s]: unknown wind
constexpr double kTypicalVerticalShare = 1.5;  // the same, of its altitude, over that

// MAV_TYPE of what flies on rotors: quadrotor, coaxial, helicopter, hexa-, octo-,
// tricopter, dodecarotor.
bool rotorcraft(std::uint8_t type) {
  constexpr std::uint8_t kTypes[] = {2, 3, 4, 13, 14, 15, 29};
  return std::find(std::begin(kTypes), std::end(kTypes), type) != std::end(kTypes);
}

// Whether all are numbers that a vehicle can mean.
template <class... Numbers>
bool sound(double limit, Numbers... numbers) {
  return ((std::abs(static_cast<double>(numbers)) <= limit) && ...);
}

// Until its estimator has an origin it says zeros, or nearly.
bool about_zero(std::int32_t latitude, std::int32_t longitude) {
  constexpr std::int64_t kNear = 10'000;  // [1e-7 deg]: 110 m
  return std::abs(std::int64_t{latitude}) <= kNear &&
         std::abs(std::int64_t{longitude}) <= kNear;
}

}  // namespace

bool Telemetry::hovers() const {
  return rotorcraft(type_);
}

void Telemetry::handle(const mavlink::Heartbeat& m) {
  make_ = mavlink::make_of(m.autopilot);
  type_ = m.type;
  custom_mode_ = m.custom_mode;
  condition_.armed = (m.base_mode & mavlink::kModeArmed) != 0;
  condition_.emergency =
      m.system_status == kStatusEmergency || m.system_status == kStatusCritical;
  const VehicleMode mode = mavlink::mode_of(make_, hovers(), m.custom_mode);
  const std::string name = mavlink::mode_name(make_, hovers(), m.custom_mode);
  condition_.mode = mode;
  if (condition_.mode_name != name) condition_.mode_name = name;
  // Until it says more: what is not armed stands.
  if (!landed_known_) condition_.on_ground = !condition_.armed;
}

void Telemetry::handle(const mavlink::Attitude& m) {
  if (!sound(kMaxAngle, m.roll, m.pitch, m.yaw) ||
      !sound(kMaxTurn, m.rollspeed, m.pitchspeed, m.yawspeed))
    return;
  motion_.q_NB = geo::from_euler({m.roll, m.pitch, m.yaw});
  motion_.w_NB_B = {m.rollspeed, m.pitchspeed, m.yawspeed};
}

void Telemetry::handle(const mavlink::VfrHud& m) {
  if (sound(kMaxSpeed, m.airspeed)) motion_.airspeed = m.airspeed;
}

void Telemetry::handle(const mavlink::Wind& m) {
  if (!sound(kMaxSpeed, m.direction, m.speed)) return;
  const double from = geo::radians(m.direction);
  motion_.wind_N = -static_cast<double>(m.speed) * geo::unit(from);
}

void Telemetry::handle(const mavlink::WindCov& m) {
  if (sound(kMaxSpeed, m.wind_x, m.wind_y)) motion_.wind_N = {m.wind_x, m.wind_y};
}

void Telemetry::handle(const mavlink::GpsRawInt& m) {
  quality_.receiver = true;
  quality_.fix = m.fix_type;
  quality_.satellites.reset();
  if (m.satellites_visible != kUnknown8) quality_.satellites = m.satellites_visible;
  quality_.hdop.reset();
  if (m.eph != kUnknown16) quality_.hdop = m.eph / 100.0;
  quality_.sd.reset();
  if (m.h_acc > 0) quality_.sd = m.h_acc / 1000.0;
  constexpr std::uint8_t kFix3D = 3;
  if (m.fix_type < kFix3D) return;  // what it says of accuracy is of no fix
  motion_.position_sd = m.h_acc > 0 ? m.h_acc / 1000.0 / std::sqrt(2.0)
                        : m.eph != kUnknown16 && m.eph > 0
                            ? m.eph / 100.0 * kTypicalPositionSd
                            : kTypicalPositionSd;
  motion_.altitude_sd = m.v_acc > 0 ? m.v_acc / 1000.0
                        : m.epv != kUnknown16 && m.epv > 0
                            ? m.epv / 100.0 * kTypicalPositionSd
                            : kTypicalVerticalShare * motion_.position_sd;
}

void Telemetry::handle(const mavlink::SysStatus& m) {
  if ((m.onboard_control_sensors_present & kPreArmCheck) != 0)
    condition_.ready = (m.onboard_control_sensors_health & kPreArmCheck) != 0;
  if (m.battery_remaining >= 0) {
    condition_.charge = m.battery_remaining / 100.0;
    charge_ = condition_.charge;
  }
  if (m.voltage_battery != kUnknown16) condition_.voltage = m.voltage_battery / 1000.0;
  if (m.current_battery >= 0) condition_.current = m.current_battery / 100.0;
}

void Telemetry::handle(const mavlink::ExtendedSysState& m) {
  landed_known_ = m.landed_state != 0;
  if (landed_known_) condition_.on_ground = m.landed_state == kLandedOnGround;
}

void Telemetry::handle(const mavlink::HomePosition& m) {
  if (std::abs(std::int64_t{m.latitude}) > kPole ||
      std::abs(std::int64_t{m.longitude}) > kHalfTurn)
    return;
  if (about_zero(m.latitude, m.longitude)) return;
  home_msl_ = m.altitude / 1000.0;
  const Vec2 place = frame_.to_plane(m.latitude * 1e-7, m.longitude * 1e-7);
  home_ = Vec3(place.x(), place.y(), -*home_msl_);
}

void Telemetry::handle(const mavlink::EkfStatusReport& m) {
  quality_.estimator = m.flags;
}

void Telemetry::handle(const mavlink::EstimatorStatus& m) {
  quality_.estimator = m.flags;
}

std::optional<VehicleMotion> Telemetry::handle(const mavlink::GlobalPositionInt& m,
                                               Time now, const ClockAlignment& clock) {
  if (std::abs(std::int64_t{m.lat}) > kPole || std::abs(std::int64_t{m.lon}) > kHalfTurn)
    return std::nullopt;
  at_origin_ = about_zero(m.lat, m.lon);
  condition_.position = !at_origin_ && knows_position(quality_);
  if (condition_.position) {
    known_ = true;
    known_at_ = now;
  }
  if (!known_ || at_origin_) return std::nullopt;
  const Vec2 place = frame_.to_plane(m.lat * 1e-7, m.lon * 1e-7);
  motion_.time =
      clock.to_here(Time::from_ns(std::int64_t{m.time_boot_ms} * 1'000'000), now);
  motion_.p_N = {place.x(), place.y(), -m.alt / 1000.0};
  motion_.v_N = {m.vx / 100.0, m.vy / 100.0, m.vz / 100.0};
  VehicleMotion said = motion_;
  said.position_sd += kDeadReckoning * (now - known_at_).seconds();
  return said;
}

}  // namespace skein::autopilot_client
