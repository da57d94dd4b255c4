// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/asset/body/ground_contact.h"

#include <algorithm>

#include "skein/base/math.h"

namespace skein::asset {
namespace {

// `value`, nearer to `target` by at most `max`.
double pulled(double value, double target, double max) {
  return value + std::clamp(target - value, -max, max);
}

}  // namespace

std::vector<ParameterError> errors(const GroundContactParameters& p) {
  ParameterCheck check;
  check.above("sink_limit", p.sink_limit, 0);
  check.above("speed_limit", p.speed_limit, 0);
  check.within("tilt_limit", p.tilt_limit, 0, geo::kPi);
  check.at_least("friction_along", p.friction_along, 0);
  check.at_least("friction_across", p.friction_across, 0);
  check.at_least("brake_friction", p.brake_friction, 0);
  check.within("rest_pitch", p.rest_pitch, -geo::kPi / 4, geo::kPi / 4);
  check.above("levelling", p.levelling, 0);
  check.require(true, "nose_fall", p.nose_fall, "");
  check.at_least("yaw_grip", p.yaw_grip, 0);
  check.at_least("steering", p.steering, 0);
  return check.take();
}

Contact touch_ground(const GroundContactParameters& p, VehicleState& state,
                     double ground_msl, double dt, double brake, double steer) {
  const bool from_air = !state.on_ground;
  state.on_ground = true;
  const double sink = state.v_N.z();
  const double cos_tilt = geo::down_in_body(state.q_NB).z();
  if (sink > p.sink_limit || cos_tilt < math::cos(p.tilt_limit) ||
      (from_air && state.v_N.head<2>().norm() > p.speed_limit))
    return Contact::kCrash;

  const double press = std::max(0.0, sink);
  state.p_N.z() = -ground_msl;
  state.v_N.z() = std::min(0.0, sink);

  geo::Euler attitude = geo::to_euler(state.q_NB);
  const Vec2 forward = geo::unit(attitude.yaw);
  const Vec2 right = geo::turned_right(forward);
  const Vec2 over_ground = state.v_N.head<2>();
  const double friction = p.friction_along + p.brake_friction * brake;
  const double along = pulled(over_ground.dot(forward), 0, friction * press);
  const double across = pulled(over_ground.dot(right), 0, p.friction_across * press);
  state.v_N.head<2>() = along * forward + across * right;

  const double still_off = math::exp(-dt / p.levelling);
  attitude.roll *= still_off;
  state.w_NB_B.x() = 0;
  const bool feet_all_around = p.nose_fall < 0;
  if (feet_all_around || attitude.pitch <= p.rest_pitch) {
    attitude.pitch = p.rest_pitch + (attitude.pitch - p.rest_pitch) * still_off;
    state.w_NB_B.y() = feet_all_around ? 0 : std::max(0.0, state.w_NB_B.y());
  } else {
    state.w_NB_B.y() -= p.nose_fall * press;
  }
  state.w_NB_B.z() = pulled(state.w_NB_B.z(), steer * along, p.yaw_grip * press);
  state.q_NB = geo::from_euler(attitude);
  return Contact::kRests;
}

}  // namespace skein::asset
