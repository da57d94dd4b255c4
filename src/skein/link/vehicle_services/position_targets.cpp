// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <optional>

#include "skein/link/vehicle_services/guided_inputs.h"
#include "skein/link/vehicle_services/places.h"

namespace skein::vehicle_services {
namespace {

using mavlink::CoordinateFrame;

// A setpoint in N; what it leaves out is missing.
struct Target {
  std::array<std::optional<double>, 3> p, v, a;
  std::optional<double> heading;
  bool relative = false;  // the place counts from where the vehicle is

  bool has_place() const { return p[0] && p[1] && p[2]; }
  bool has_velocity() const { return v[0] || v[1] || v[2]; }
};

// Three numbers of a message, of which its mask leaves some out.
std::array<std::optional<double>, 3> present(std::uint16_t mask, std::uint16_t first,
                                             double x, double y, double z) {
  std::array<std::optional<double>, 3> axes;
  const std::array<double, 3> values{x, y, z};
  for (std::size_t k = 0; k < 3; ++k)
    if ((mask & (first << k)) == 0) axes[k] = values[k];
  return axes;
}

// What of a target is the same for both messages.
template <class Message>
Target velocities_of(const Message& m) {
  using namespace mavlink::position_target;
  Target target;
  target.v = present(m.type_mask, kIgnoreVx, static_cast<double>(m.vx),
                     static_cast<double>(m.vy), static_cast<double>(m.vz));
  if ((m.type_mask & kForce) == 0)
    target.a = present(m.type_mask, kIgnoreAx, static_cast<double>(m.afx),
                       static_cast<double>(m.afy), static_cast<double>(m.afz));
  if ((m.type_mask & kIgnoreYaw) == 0) target.heading = static_cast<double>(m.yaw);
  return target;
}

// All that is given are numbers that a flight may have.
bool is_sensible(const Target& target) {
  const auto within = [](const std::optional<double>& value, double limit) {
    return !value || std::abs(*value) <= limit;
  };
  for (const auto& metres : target.p)
    if (!within(metres, 1e6)) return false;
  for (const auto* axes : {&target.v, &target.a})
    for (const auto& value : *axes)
      if (!within(value, 1e3)) return false;
  return within(target.heading, 1e3) && (!target.p[2] || is_altitude(*target.p[2]));
}

// Turns what is given along the axes of the body, as seen from above, into N.
void turn(std::array<std::optional<double>, 3>& axes, double heading) {
  if (!axes[0] && !axes[1]) return;
  const Vec2 forward = geo::unit(heading);
  const Vec2 turned =
      forward * axes[0].value_or(0) + geo::turned_right(forward) * axes[1].value_or(0);
  axes[0] = turned.x();
  axes[1] = turned.y();
}

Vec3 filled(const std::array<std::optional<double>, 3>& axes, const Vec3& missing) {
  return {axes[0].value_or(missing.x()), axes[1].value_or(missing.y()),
          axes[2].value_or(missing.z())};
}

void fly(const Target& target, ServedVehicle& vehicle) {
  if (!is_sensible(target)) return;
  GuidedState& guided = vehicle.guided;
  guided.last_setpoint = vehicle.now.wall;
  if (!why_not_guided(vehicle).empty()) return;
  if (target.has_velocity()) {
    TrackSetpoint setpoint;
    setpoint.p_N = filled(target.p, vehicle.snapshot.motion.p_N);
    setpoint.v_N = filled(target.v, Vec3::Zero());
    setpoint.a_N = filled(target.a, Vec3::Zero());
    setpoint.heading = target.heading;
    guided.place.reset();
    guided.heading.reset();
    if (target.p[2]) guided.altitude_msl = -*target.p[2];
    vehicle.request(setpoint);
    return;
  }
  const bool stays =
      target.relative && target.has_place() &&
      geo::horizontal(filled(target.p, Vec3::Zero()) - vehicle.snapshot.motion.p_N)
          .isZero(1e-6);
  if (target.p[2] && (stays || (!target.p[0] && !target.p[1])))
    change_altitude(vehicle, -*target.p[2], 0);
  else if (target.has_place())
    fly_to(vehicle, default_fly_to(vehicle, filled(target.p, Vec3::Zero())));
}

}  // namespace

void handle(const mavlink::SetPositionTargetGlobalInt& m, ServedVehicle& vehicle) {
  Target target = velocities_of(m);
  const auto altitude =
      altitude_msl(m.coordinate_frame, static_cast<double>(m.alt), vehicle.home_msl());
  if (!altitude) return;
  target.p = present(m.type_mask, mavlink::position_target::kIgnoreX, 0, 0, -*altitude);
  if (target.p[0] && target.p[1]) {
    const auto point = map_point(vehicle.frame, coordinate(m.coordinate_frame, m.lat_int),
                                 coordinate(m.coordinate_frame, m.lon_int));
    if (!point) return;
    target.p[0] = point->x();
    target.p[1] = point->y();
  } else {
    target.p[0] = target.p[1] = std::nullopt;
  }
  fly(target, vehicle);
}

void handle(const mavlink::SetPositionTargetLocalNed& m, ServedVehicle& vehicle) {
  Target target = velocities_of(m);
  target.p =
      present(m.type_mask, mavlink::position_target::kIgnoreX, static_cast<double>(m.x),
              static_cast<double>(m.y), static_cast<double>(m.z));
  Vec3 begin_N = vehicle.origin_N;
  switch (static_cast<CoordinateFrame>(m.coordinate_frame)) {
    case CoordinateFrame::kLocalNed:
      break;
    case CoordinateFrame::kBodyNed:
    case CoordinateFrame::kBodyOffsetNed:
    case CoordinateFrame::kBodyFrd: {
      const double heading = geo::yaw(vehicle.snapshot.motion.q_NB);
      for (auto* axes : {&target.p, &target.v, &target.a}) turn(*axes, heading);
      if (target.heading) *target.heading += heading;
      [[fallthrough]];
    }
    case CoordinateFrame::kLocalOffsetNed:
      target.relative = true;
      begin_N = vehicle.snapshot.motion.p_N;
      break;
    default:
      return;
  }
  for (Eigen::Index k = 0; k < 3; ++k)
    if (auto& value = target.p[static_cast<std::size_t>(k)]) *value += begin_N[k];
  fly(target, vehicle);
}

}  // namespace skein::vehicle_services
