// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/commanded/commanded_agent.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/math.h"

namespace skein::reasoning {
namespace {

constexpr double kPathBehind = 2;  // of a line that is flown, in flight time [s]
constexpr double kPathAhead = 8;   // the same
constexpr double kMinSpeed = 1;    // below it a track has no direction [m/s]
const Time kPlanAhead = Time::from_seconds(1);

}  // namespace

CommandedAgent::CommandedAgent(const CommandedAgentOptions& options, EntityId self,
                               const FlightLimits& limits,
                               std::shared_ptr<const Terrain> map)
    : options_(options),
      self_(self),
      limits_(limits),
      map_(std::move(map)),
      mission_(limits) {}

// What each request means.
struct CommandedAgent::Obedience {
  CommandedAgent& self;
  const AgentInput& in;
  AgentOutput& out;

  double altitude() const { return -in.nav->p_N.z(); }

  void operator()(const ModeRequest& request) const {
    self.mission_.stop();
    self.setpoint_.reset();
    switch (request.mode) {
      case VehicleMode::kHold:
      case VehicleMode::kGuided:
        if (!in.autopilot.on_ground) self.hold(in, out);
        return;
      case VehicleMode::kMission:
        return self.mission_.start(0);
      case VehicleMode::kTakeOff:
        return (*this)(TakeOffRequest{
            -self.home_.value_or(in.nav->p_N).z() + self.options_.take_off_height, {}});
      case VehicleMode::kReturn:
        return self.give(Return{}, altitude(), out);
      case VehicleMode::kLand:
        return self.land({}, in, out);
      case VehicleMode::kManual:
      case VehicleMode::kStabilized:
      case VehicleMode::kOther:
        return;
    }
  }
  void operator()(const ArmRequest&) const {}  // its motors turn when it is to fly
  void operator()(const TakeOffRequest& request) const {
    self.mission_.stop();
    self.setpoint_.reset();
    if (!in.autopilot.on_ground) {
      self.give(HoldPosition{geo::horizontal(in.nav->p_N)}, request.altitude_msl, out);
      return;
    }
    self.give(TakeOff{request.course.value_or(in.nav->heading)}, request.altitude_msl,
              out);
  }
  void operator()(const LandRequest& request) const {
    self.mission_.stop();
    self.setpoint_.reset();
    self.land(request, in, out);
  }
  void operator()(const FlyToRequest& request) const {
    self.mission_.stop();
    self.setpoint_.reset();
    if (request.airspeed) self.airspeed_ = request.airspeed;
    const Vec2 place = geo::horizontal(request.p_N);
    if (request.radius > 0 && !self.hovers())
      self.give(Circle{place, request.radius, request.clockwise}, -request.p_N.z(), out);
    else
      self.give(HoldPosition{place}, -request.p_N.z(), out);
  }
  void operator()(const BankSetpoint& setpoint) const {
    self.mission_.stop();
    self.setpoint_ = in.now;
    if (setpoint.airspeed > 0) self.airspeed_ = setpoint.airspeed;
    self.give(HoldBank{setpoint.roll}, setpoint.altitude_msl, out);
  }
  void operator()(const TrackSetpoint& setpoint) const {
    self.mission_.stop();
    self.setpoint_ = in.now;
    self.follow(setpoint, in, out);
  }
  void operator()(const SpeedRequest& request) const {
    self.airspeed_ = request.airspeed;
    if (self.last_) self.give(self.last_->guidance, self.last_->altitude_msl, out);
  }
  void operator()(const MissionUpload& upload) const { self.mission_.load(upload.items); }
  void operator()(const MissionStart& start) const {
    self.setpoint_.reset();
    self.mission_.start(start.item);
  }
  // Sticks go to the autopilot past the agent.
  void operator()(const PilotRequest&) const {}
  // Of a virtual world to vehicles that are not in it.
  void operator()(const ObstacleDistances&) const {}
  void operator()(const FenceUpload&) const {}
  void operator()(const PositionFix&) const {}
};

void CommandedAgent::give(decltype(AutopilotCommand::guidance) guidance,
                          double altitude_msl, AgentOutput& out) {
  AutopilotCommand command;
  command.guidance = std::move(guidance);
  command.altitude_msl = altitude_msl;
  if (airspeed_)
    command.airspeed =
        std::clamp(*airspeed_, std::max(limits_.slowest, kMinSpeed), limits_.fastest);
  last_ = command;
  out.command = std::move(command);
}

void CommandedAgent::hold(const AgentInput& in, AgentOutput& out) {
  give(HoldPosition{geo::horizontal(in.nav->p_N)}, -in.nav->p_N.z(), out);
}

// Without a place what hovers lands where it is, and a wing where it took off.
void CommandedAgent::land(const LandRequest& request, const AgentInput& in,
                          AgentOutput& out) {
  const Vec2 here = geo::horizontal(hovers() ? in.nav->p_N : home_.value_or(in.nav->p_N));
  const Vec2 place = request.point.value_or(here);
  give(Land{place, map_->elevation_msl(place), request.course}, -in.nav->p_N.z(), out);
}

// A wing flies the line through the point, bent as the acceleration says; what hovers is
// to be where the setpoint is, and to go on as it goes.
void CommandedAgent::follow(const TrackSetpoint& setpoint, const AgentInput& in,
                            AgentOutput& out) {
  const double altitude = -setpoint.p_N.z();
  if (hovers()) {
    const double dt = kPlanAhead.seconds();
    FollowPlan plan;
    plan.plan.push_back({in.now, setpoint.p_N, setpoint.v_N});
    plan.plan.push_back({in.now + kPlanAhead,
                         setpoint.p_N + dt * setpoint.v_N + 0.5 * dt * dt * setpoint.a_N,
                         setpoint.v_N + dt * setpoint.a_N});
    return give(std::move(plan), altitude, out);
  }
  const Vec2 v = geo::horizontal(setpoint.v_N), a = geo::horizontal(setpoint.a_N);
  const double speed = v.norm();
  if (speed < kMinSpeed)
    return give(HoldPosition{geo::horizontal(setpoint.p_N)}, altitude, out);
  PathElement line;
  line.curvature = geo::cross(v, a) / (speed * speed * speed);
  // Back along the arc, so that it is on the line although it lags behind the point.
  const double back = kPathBehind * speed, turned = line.curvature * back / 2;
  line.course = geo::bearing(v) - 2 * turned;
  const double sinc = std::abs(turned) > 1e-6 ? math::sin(turned) / turned : 1.0;
  line.start =
      geo::horizontal(setpoint.p_N) - back * sinc * geo::unit(geo::bearing(v) - turned);
  line.length = back + kPathAhead * speed;
  give(FollowPath{{line}}, altitude, out);
}

void CommandedAgent::obey(const VehicleRequest& request, const AgentInput& in,
                          AgentOutput& out) {
  std::visit(Obedience{*this, in, out}, request);
}

void CommandedAgent::step(const AgentInput& in, AgentOutput& out) {
  if (!home_) home_ = in.nav->p_N;
  for (const Command& command : in.commands)
    if (const auto* asked = std::get_if<VehicleCommand>(&command))
      obey(asked->request, in, out);
  if (mission_.flies()) {
    if (auto command = mission_.step(in)) {
      last_ = command;
      out.command = std::move(command);
    }
    if (mission_.progress().finished && !in.autopilot.on_ground) hold(in, out);
  }
  if (setpoint_ && (in.now - *setpoint_).seconds() > options_.patience) {
    setpoint_.reset();
    out.events.push_back(
        {in.now, self_, EventKind::kSetpointsEnded, "it holds its place"});
    hold(in, out);
  }
  const MissionProgress now = mission_.progress();
  if (now != reported_) {
    reported_ = now;
    out.records.emplace_back(now);
  }
}

}  // namespace skein::reasoning
