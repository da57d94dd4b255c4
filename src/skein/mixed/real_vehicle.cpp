// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/real_vehicle.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace skein::mixed {
namespace {

// Time over which a climb rate becomes an altitude to fly to: the time constant with
// which guidance closes an altitude error [s].
constexpr double kClimbLead = 3;

// Above its landing point is who is so near and so slow.
constexpr double kOverPoint = 1;  // [m]
constexpr double kOverSpeed = 1;  // [m/s]

bool hovers(const FlightLimits& limits) {
  return limits.slowest == 0;
}

EventKind event_of(LinkChange::Kind kind) {
  switch (kind) {
    case LinkChange::Kind::kUp:
      return EventKind::kLinkUp;
    case LinkChange::Kind::kDown:
      return EventKind::kLinkLost;
    case LinkChange::Kind::kRebooted:
      return EventKind::kVehicleRebooted;
    case LinkChange::Kind::kMismatch:
      return EventKind::kWrongVehicle;
    case LinkChange::Kind::kDuplicate:
      break;
  }
  return EventKind::kDuplicateVehicle;
}

// Wind that may carry it over ground, on top of its own speed [m/s].
constexpr double kMaxWind = 25;

}  // namespace

RealVehicle::RealVehicle(RealVehicleParts parts)
    : parts_(std::move(parts)),
      tracker_(!hovers(parts_.limits)),
      director_(hovers(parts_.limits)),
      position_(parts_.limits.fastest + kMaxWind, parts_.max_age),
      feeds_(std::move(parts_.feeds)),
      estimate_(parts_.start) {}

// What the vehicle says, one report after the other.
struct RealVehicle::Listener {
  RealVehicle& self;
  Time now;

  void operator()(const VehicleMotion& motion) const {
    self.position_.hear(motion);
    self.tracker_.add(motion);
  }
  void operator()(const VehicleCondition& condition) const {
    self.condition_ = condition;
  }
  void operator()(const LinkChange& change) const {
    self.events_.push_back({event_of(change.kind), change.text});
    self.note_link(change);
    self.director_.hear(change);
    self.feeds_.hear(change);
  }
  void operator()(const RequestAnswer& answer) const {
    self.director_.hear(answer, now, self.events_);
    self.feeds_.hear(answer, now, self.events_);
  }
  void operator()(const VehicleText& text) const {
    self.director_.hear(text, now);
    constexpr std::uint8_t kError = 3;  // and what is worse
    if (text.severity <= kError)
      self.events_.push_back({EventKind::kVehicleSays, text.text});
  }
  void operator()(const MissionProgress&) const {}
  void operator()(const VehicleIdentity& identity) const {
    self.events_.push_back({EventKind::kVehicleIdentified, identity.make});
  }
  void operator()(const LinkHealth&) const {}
  void operator()(const EntityReport&) const {}     // its agent is here
  void operator()(const ActuatorOutputs&) const {}  // of a body's drive
  void operator()(const OutsideEvent& event) const {
    // In the air the monitor of its position reports it.
    if (event.kind == EventKind::kPositionJumped && !self.condition_.on_ground) return;
    self.events_.push_back({event.kind, event.text});
  }
  void operator()(const FeedHealth&) const {}
};

void RealVehicle::begin(const Surroundings& world, Time now) {
  if (parts_.body) parts_.body->begin(world, now);
  begin_step(now);
  parts_.guidance->begin(estimate_, condition_.on_ground);
}

void RealVehicle::note_link(const LinkChange& change) {
  if (change.kind == LinkChange::Kind::kUp) up_ = true;
  if (change.kind == LinkChange::Kind::kDown) up_ = false;
}

// Once a step: what it begins with is what a run that is done again begins with. Of what
// comes over a link that was made to fail only the link's own changes count.
void RealVehicle::take_in(Time now) {
  if (std::exchange(received_, now) == now) return;
  const auto begin = static_cast<std::ptrdiff_t>(reports_.size());
  parts_.port->receive(now, reports_);
  if (!blocked_) {
    for (auto report = reports_.begin() + begin; report != reports_.end(); ++report)
      std::visit(Listener{*this, now}, *report);
    return;
  }
  const auto lost = std::remove_if(
      reports_.begin() + begin, reports_.end(),
      [](const VehicleReport& r) { return !std::holds_alternative<LinkChange>(r); });
  reports_.erase(lost, reports_.end());
  for (auto report = reports_.begin() + begin; report != reports_.end(); ++report)
    note_link(std::get<LinkChange>(*report));
}

void RealVehicle::begin_step(Time now) {
  if (parts_.body) {
    parts_.body->begin_step(now);
    set_blocked(parts_.body->faults().link);
  }
  feeds_.look(now);
  take_in(now);
  if (!tracker_.known()) return;
  position_.step(now, condition_, director_.up(), events_);
  estimate_ = as_estimate(tracker_.at(now));
  estimate_.time = tracker_.time();
}

// How its payload sees the world, from `state` in `air`; none when nobody knows where it
// is.
std::optional<SensorView> RealVehicle::view(const Surroundings& world, Time now,
                                            VehicleState& state, Air& air) const {
  if (parts_.body) {
    state = parts_.body->state();
    air = parts_.body->air();
  } else if (position_.is_good()) {
    state = as_state(tracker_.at(now), condition_.on_ground);
    air.wind_N = world.wind.wind(state.p_N, now);
  } else {
    return std::nullopt;
  }
  SensorView view{now,           state,           air,
                  world.terrain, world.phenomena, world.objects,
                  std::nullopt,  world.aircraft};
  if (region_of_interest_) view.gaze_N = *region_of_interest_ - state.p_N;
  return view;
}

void RealVehicle::look(const Surroundings& world, Time now, PayloadSamples& out) {
  if (parts_.payload.empty()) return;
  VehicleState state;
  Air air;
  const auto seen = view(world, now, state, air);
  for (std::size_t k = 0; k < parts_.payload.size(); ++k) {
    const auto before = static_cast<std::ptrdiff_t>(out.samples.size());
    if (seen) parts_.payload[k]->sample(*seen, out.samples);
    if (parts_.body && parts_.body->faults().payload_silent(k))
      out.samples.erase(out.samples.begin() + before, out.samples.end());
    out.ends.push_back(out.samples.size());
  }
}

void RealVehicle::advance(const Surroundings& world, Time now, Time until,
                          const Vehicle*) {
  if (!blocked_) command_autopilot(world, now, until);
  if (parts_.body) parts_.body->advance(world, now, until);
}

void RealVehicle::command_autopilot(const Surroundings& world, Time now, Time until) {
  land_from_above();
  director_.step(now, condition_, -estimate_.p_N.z(), position_.is_good(), *parts_.port,
                 events_);
  watch_command(now);
  if (!tracker_.known())
    return feeds_.step(world, now, nullptr, condition_.on_ground, *parts_.port);
  const VehicleMotion motion = tracker_.at(now);
  const bool good = position_.is_good();
  feeds_.step(world, now, good ? &motion : nullptr, condition_.on_ground, *parts_.port);
  parts_.guidance->sense(TruthSample{now,
                                     motion.p_N,
                                     motion.v_N,
                                     motion.q_NB,
                                     motion.w_NB_B,
                                     {motion.wind_N.x(), motion.wind_N.y(), 0}});
  if (good && !condition_.on_ground) send_setpoint(now, (until - now).seconds());
}

// One that was taken off and cannot be commanded is not left alone.
void RealVehicle::watch_command(Time now) {
  CommandMonitor::Inputs in;
  in.leads = director_.leads(condition_);
  in.taking_off = director_.taking_off();
  in.guided = condition_.mode == VehicleMode::kGuided;
  in.position = tracker_.known() && now - tracker_.time() <= parts_.max_age;
  in.jumped = position_.has_jumped();
  if (tracker_.known()) in.position_age = (now - tracker_.time()).seconds();
  in.mode_name = condition_.mode_name;
  in.altitude_msl = -estimate_.p_N.z();
  in.climbs_to = director_.climbs_to();
  const std::string why = monitor_.step(now, in);
  if (why.empty()) return;
  events_.push_back({EventKind::kNotCommandable, why + "; it is sent back"});
  director_.bring_back(why);
}

// What hovers comes down where it is: so it is led above the point first.
void RealVehicle::land_from_above() {
  if (!over_landing_) return;
  const Vec2 way = *over_landing_->point - geo::horizontal(estimate_.p_N);
  if (!condition_.on_ground &&
      (way.norm() > kOverPoint || geo::horizontal(estimate_.v_N).norm() > kOverSpeed))
    return;
  director_.land(*over_landing_);
  over_landing_.reset();
}

void RealVehicle::send_setpoint(Time now, double dt) {
  const Control control = parts_.guidance->control(now, dt);
  if (!director_.takes_setpoints()) return;
  if (const auto* flight = std::get_if<FlightCommand>(&control)) {
    BankSetpoint setpoint;
    setpoint.roll = flight->roll;
    setpoint.airspeed = flight->airspeed;
    setpoint.climb_rate = flight->climb_rate;
    setpoint.altitude_msl = -estimate_.p_N.z() + kClimbLead * flight->climb_rate;
    parts_.port->send(0, setpoint);
    monitor_.sent(now, setpoint, tracker_.newest());
  } else if (const auto* track = std::get_if<TrackSetpoint>(&control)) {
    parts_.port->send(0, *track);
    monitor_.sent(now, *track, tracker_.newest());
  }
}

void RealVehicle::give(const AutopilotCommand& command) {
  refusals_before_ = parts_.guidance->status().refusals;
  parts_.guidance->command(command);
}

void RealVehicle::command(const AutopilotCommand& command) {
  ++commands_;
  over_landing_.reset();
  if (const auto* up = std::get_if<TakeOff>(&command.guidance)) {
    director_.take_off({command.altitude_msl, up->course});
    give({HoldPosition{geo::horizontal(estimate_.p_N)}, command.altitude_msl, {}});
    return;
  }
  if (const auto* down = std::get_if<Land>(&command.guidance)) {
    const LandRequest land{down->point, down->ground_msl, down->course};
    if (!hovers(parts_.limits)) return director_.land(land);
    over_landing_ = land;
    give({HoldPosition{down->point}, -estimate_.p_N.z(), {}});
    director_.fly();
    return;
  }
  give(command);
  director_.fly();
}

CommandFate RealVehicle::command_fate() const {
  if (commands_ == 0) return {};
  const AutopilotStatus status = parts_.guidance->status();
  if (status.refusals > refusals_before_)
    return {commands_, CommandFate::State::kRefused, status.refused};
  return {
      commands_,
      director_.reached() ? CommandFate::State::kAccepted : CommandFate::State::kPending,
      {}};
}

void RealVehicle::set_return(const ReturnRoute& route) {
  parts_.guidance->set_return(route);
}

AutopilotStatus RealVehicle::status() const {
  AutopilotStatus status = parts_.guidance->status();
  status.on_ground = condition_.on_ground;
  status.charge = parts_.body ? parts_.body->state().energy.charge : condition_.charge;
  status.reserve = status.charge;
  status.mode = FlightMode::kGuided;
  const bool follows = director_.takes_setpoints() && director_.reached();
  if (!follows) {
    status.follows = false;
    status.done = director_.done() && (director_.landing() || director_.taking_off());
  }
  if (over_landing_) status.done = false;
  if (director_.landing() && director_.reached()) status.mode = FlightMode::kAuto;
  const ControlMonitor& control = director_.control();
  if (control.holder() == ControlMonitor::Holder::kPilot)
    status.mode = control.mode() == VehicleMode::kManual ? FlightMode::kManual
                                                         : FlightMode::kStabilized;
  status.trigger = control.trigger();
  status.reaction = control.reaction();
  status.held = control.why();
  if (control.is_taken()) return status;
  if (director_.brings_back()) {
    status.reaction = FailsafeReaction::kReturn;
    status.held = director_.why_back();
  }
  // Where it is not known nobody leads it anywhere; what it does is its own affair.
  if (!status.held.empty() || !director_.up() || condition_.on_ground) return status;
  status.held = position_.why();
  if (!status.held.empty()) status.reaction = FailsafeReaction::kHold;
  return status;
}

void RealVehicle::take_events(std::vector<VehicleEvent>& out) {
  if (parts_.body) parts_.body->take_events(out);
  for (VehicleEvent& event : events_) out.push_back(std::move(event));
  events_.clear();
}

void RealVehicle::take_reports(std::vector<VehicleReport>& out) {
  if (parts_.body) parts_.body->take_reports(out);
  for (VehicleReport& report : reports_) out.push_back(std::move(report));
  reports_.clear();
}

Result<void> RealVehicle::set_fault(const std::string& part, bool fails, Time now) {
  if (parts_.body) return parts_.body->set_fault(part, fails, now);
  if (part != "link")
    return Error{ErrorCode::kBadInput, "",
                 fmt::format("{} is not simulated here: of its parts only \"link\" can "
                             "be made to fail.",
                             parts_.name),
                 ""};
  if (blocked_ != fails)
    events_.push_back({fails ? EventKind::kFailure : EventKind::kRepaired, "link"});
  set_blocked(fails);
  return {};
}

void RealVehicle::set_blocked(bool blocked) {
  if (std::exchange(blocked_, blocked) == blocked || !up_) return;
  const LinkChange change{blocked ? LinkChange::Kind::kDown : LinkChange::Kind::kUp, {}};
  director_.hear(change);
  feeds_.hear(change);
}

Result<void> RealVehicle::hand_back(Time /*now*/) {
  // A place that it has jumped to counts from then on.
  if (director_.up() && !position_.why().empty() && !director_.control().is_taken()) {
    position_.accept();
    return {};
  }
  return director_.hand_back(events_);
}

}  // namespace skein::mixed
