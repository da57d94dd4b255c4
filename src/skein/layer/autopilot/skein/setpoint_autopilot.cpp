// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/skein/setpoint_autopilot.h"

#include <algorithm>

namespace skein::autopilot {
namespace {

NavState state_of(const NavEstimate& nav) {
  NavState state;
  state.time = nav.time;
  state.p_N = nav.p_N;
  state.v_N = nav.v_N;
  state.q_NB = geo::from_euler({nav.roll, nav.pitch, nav.heading});
  state.wind_N = {nav.wind_N.x(), nav.wind_N.y(), 0};
  state.airspeed = (geo::horizontal(nav.v_N) - nav.wind_N).norm();
  return state;
}

// What hovers but is known by its limits only.
MultirotorAirframe airframe_of(const FlightLimits& limits) {
  MultirotorAirframe airframe;
  airframe.cruise = limits.airspeed;
  airframe.fastest = limits.fastest;
  airframe.climb_rate = limits.climb_rate;
  airframe.sink_rate = limits.sink_rate;
  return airframe;
}

std::variant<PointController, MultirotorGuidance> controller_of(const SkeinSetup& setup,
                                                                const Vec3& home_N) {
  if (const auto* rotors = std::get_if<MultirotorAirframe>(&setup.airframe))
    return MultirotorGuidance(setup.options.rotor_guidance, *rotors, home_N);
  return PointController(setup, home_N);
}

}  // namespace

std::shared_ptr<const SkeinSetup> setpoint_setup(const SkeinOptions& options,
                                                 const FlightLimits& limits,
                                                 const Airframe& airframe) {
  if (std::holds_alternative<MultirotorAirframe>(airframe))
    return std::make_shared<SkeinSetup>(options, limits, airframe);
  if (limits.slowest == 0)
    return std::make_shared<SkeinSetup>(options, limits, airframe_of(limits));
  return std::make_shared<SkeinSetup>(options, limits, SelfStabilised{span_of(airframe)});
}

SetpointAutopilot::SetpointAutopilot(std::shared_ptr<const SkeinSetup> setup,
                                     const NavEstimate& initial)
    : setup_(std::move(setup)),
      nav_(state_of(initial)),
      home_N_(initial.p_N),
      controller_(controller_of(*setup_, home_N_)) {}

void SetpointAutopilot::begin(const NavEstimate& start, bool /*on_ground*/) {
  nav_ = state_of(start);
  if (auto* point = std::get_if<PointController>(&controller_))
    point->take_over(view());
  else
    std::get<MultirotorGuidance>(controller_).forget(nav_);
}

void SetpointAutopilot::sense(const SensorSample& sample) {
  const auto* motion = std::get_if<TruthSample>(&sample);
  if (!motion) return;
  nav_.time = motion->time;
  nav_.p_N = motion->p_N;
  nav_.v_N = motion->v_N;
  nav_.q_NB = motion->q_NB;
  nav_.w_NB_B = motion->w_NB_B;
  nav_.wind_N = motion->wind_N;
  nav_.airspeed = (motion->v_N - motion->wind_N).norm();
}

// A return without a place leads along the route, if there is one.
AutopilotCommand SetpointAutopilot::led_home(const AutopilotCommand& command) const {
  const auto* back = std::get_if<Return>(&command.guidance);
  if (!back || back->point || return_.points.empty()) return command;
  AutopilotCommand led = command;
  FlyWaypoints route;
  const double low = -home_N_.z() + (setup_->limits.slowest > 0
                                         ? setup_->options.wing_guidance.return_height
                                         : setup_->options.rotor_guidance.return_height);
  for (const Vec2& point : return_.points)
    route.points.push_back({point, std::max(command.altitude_msl, low)});
  led.guidance = std::move(route);
  return led;
}

void SetpointAutopilot::command(const AutopilotCommand& command) {
  const AutopilotCommand led = led_home(command);
  std::optional<std::string> reason;
  if (std::holds_alternative<TakeOff>(led.guidance) ||
      std::holds_alternative<Land>(led.guidance))
    reason = "taking off and landing are not flown by setpoints";
  else if (auto* point = std::get_if<PointController>(&controller_))
    reason = point->command(led, view());
  else
    reason = std::get<MultirotorGuidance>(controller_).command(led, nav_);
  if (!reason) {
    command_ = command;
    return;
  }
  refused_ = std::move(*reason);
  ++refusals_;
}

void SetpointAutopilot::set_return(const ReturnRoute& route) {
  if (route == return_) return;
  return_ = route;
  const auto* back = std::get_if<Return>(&command_.guidance);
  if (back && !back->point) command(AutopilotCommand(command_));
}

TrackSetpoint SetpointAutopilot::setpoint(const MultirotorDemand& demand) const {
  TrackSetpoint setpoint;
  setpoint.p_N = {demand.position.x(), demand.position.y(), -demand.altitude_msl};
  // Where only the velocity counts it is to be where it is.
  if (!demand.holds_position) setpoint.p_N.head<2>() = nav_.p_N.head<2>();
  setpoint.v_N = {demand.velocity.x(), demand.velocity.y(), -demand.climb_rate};
  setpoint.a_N = {demand.acceleration.x(), demand.acceleration.y(), 0};
  setpoint.heading = demand.heading;
  return setpoint;
}

Control SetpointAutopilot::control(Time now, double dt) {
  nav_.time = now;
  if (auto* point = std::get_if<PointController>(&controller_))
    return point->fly(view(), dt);
  return setpoint(std::get<MultirotorGuidance>(controller_).step(nav_, dt));
}

NavEstimate SetpointAutopilot::estimate() const {
  const geo::Euler attitude = geo::to_euler(nav_.q_NB);
  NavEstimate nav;
  nav.time = nav_.time;
  nav.p_N = nav_.p_N;
  nav.v_N = nav_.v_N;
  nav.heading = attitude.yaw;
  nav.roll = attitude.roll;
  nav.pitch = attitude.pitch;
  nav.wind_N = geo::horizontal(nav_.wind_N);
  return nav;
}

AutopilotStatus SetpointAutopilot::status() const {
  AutopilotStatus status = std::visit(
      [](const auto& controller) -> const AutopilotStatus& {
        return controller.status();
      },
      controller_);
  status.refusals = refusals_;
  status.refused = refused_;
  return status;
}

}  // namespace skein::autopilot
