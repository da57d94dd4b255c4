// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/setpoint_sender.h"

#include <cmath>

#include "skein/base/math.h"
#include "skein/link/autopilot_client/request_steps.h"

namespace skein::autopilot_client {
namespace {

using vehicle_services::Channel;
using vehicle_services::Outbox;

constexpr std::uint8_t kTargetComponent = 1;
constexpr std::uint8_t kAltitudeMsl = 5;  // MAV_FRAME: global, above mean sea level
const Time kAltitudePeriod = Time::from_seconds(0.5);
const Time kAirspeedPeriod = Time::from_seconds(1);
constexpr double kAltitudeStep = 0.5;  // sent at once [m]
constexpr double kAirspeedStep = 0.3;  // [m/s]

bool has_moved(const std::optional<double>& last, double now, double step) {
  return !last || std::abs(*last - now) > step;
}

}  // namespace

void SetpointSender::forget() {
  altitude_.reset();
  airspeed_.reset();
}

void SetpointSender::send(const BankSetpoint& setpoint, Time now, Channel channel,
                          Outbox& out, CommandSender& commands) {
  mavlink::SetAttitudeTarget attitude;
  attitude.time_boot_ms = static_cast<std::uint32_t>(now.ns() / 1'000'000);
  attitude.target_system = system_;
  attitude.target_component = kTargetComponent;
  // Roll alone counts: ArduPilot takes it for such a mask, and height and speed are its
  // own affair.
  attitude.type_mask = 0b1100'0110;
  const double half = setpoint.roll / 2;
  attitude.q = {static_cast<float>(math::cos(half)), static_cast<float>(math::sin(half)),
                0, 0};
  out.send(channel, attitude);

  if (has_moved(altitude_, setpoint.altitude_msl, kAltitudeStep) ||
      now >= altitude_due_) {
    altitude_ = setpoint.altitude_msl;
    altitude_due_ = now + kAltitudePeriod;
    mavlink::SetPositionTargetGlobalInt target;
    target.time_boot_ms = attitude.time_boot_ms;
    target.target_system = system_;
    target.target_component = kTargetComponent;
    target.coordinate_frame = kAltitudeMsl;
    target.type_mask = 0xfffb;  // nothing but the altitude
    target.alt = static_cast<float>(setpoint.altitude_msl);
    out.send(channel, target);
  }
  if (has_moved(airspeed_, setpoint.airspeed, kAirspeedStep) && now >= airspeed_due_) {
    airspeed_ = setpoint.airspeed;
    airspeed_due_ = now + kAirspeedPeriod;
    commands.add(
        {0, {command(kDoChangeSpeed, 0, static_cast<float>(setpoint.airspeed), -1)}});
  }
}

void SetpointSender::send(const TrackSetpoint& setpoint, Channel channel,
                          Outbox& out) const {
  mavlink::SetPositionTargetGlobalInt target;
  target.target_system = system_;
  target.target_component = kTargetComponent;
  target.coordinate_frame = kAltitudeMsl;
  constexpr std::uint16_t kIgnoreYaw = 0x400, kIgnoreYawRate = 0x800;
  target.type_mask =
      setpoint.heading ? kIgnoreYawRate : std::uint16_t{kIgnoreYaw | kIgnoreYawRate};
  const ScaledPlace place = scaled_place(setpoint.p_N.head<2>(), frame_);
  target.lat_int = place.latitude;
  target.lon_int = place.longitude;
  target.alt = static_cast<float>(-setpoint.p_N.z());
  const Eigen::Vector3f v = setpoint.v_N.cast<float>(), a = setpoint.a_N.cast<float>();
  target.vx = v.x();
  target.vy = v.y();
  target.vz = v.z();
  target.afx = a.x();
  target.afy = a.y();
  target.afz = a.z();
  target.yaw = static_cast<float>(setpoint.heading.value_or(0));
  out.send(channel, target);
}

}  // namespace skein::autopilot_client
