// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/remote_entity.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace skein::mixed {
namespace {

EventKind remote_event(LinkChange::Kind kind) {
  switch (kind) {
    case LinkChange::Kind::kUp:
      return EventKind::kLinkUp;
    case LinkChange::Kind::kDown:
      return EventKind::kLinkLost;
    case LinkChange::Kind::kRebooted:
      return EventKind::kAgentRestarted;
    case LinkChange::Kind::kMismatch:
      return EventKind::kWrongAgent;
    case LinkChange::Kind::kDuplicate:
      break;
  }
  return EventKind::kDuplicateAgent;
}

VehicleMotion believed_motion(const NavEstimate& nav) {
  VehicleMotion motion;
  motion.time = nav.time;
  motion.p_N = nav.p_N;
  motion.v_N = nav.v_N;
  motion.q_NB = geo::from_euler({nav.roll, nav.pitch, nav.heading});
  motion.airspeed = (geo::horizontal(nav.v_N) - nav.wind_N).norm();
  motion.wind_N = nav.wind_N;
  motion.position_sd = nav.position_sd;
  motion.altitude_sd = nav.altitude_sd;
  return motion;
}

VehicleMotion true_motion(const VehicleState& state, Time time) {
  VehicleMotion motion;
  motion.time = time;
  motion.p_N = state.p_N;
  motion.v_N = state.v_N;
  motion.q_NB = state.q_NB;
  motion.w_NB_B = state.w_NB_B;
  motion.airspeed = state.airspeed;
  return motion;
}

// Stands for the agent of an entity in another program.
class RemoteAgent final : public Agent {
 public:
  explicit RemoteAgent(std::shared_ptr<RemoteEntity> shared)
      : shared_(std::move(shared)) {}

  void step(const AgentInput& in, AgentOutput& out) override {
    for (const Message& message : in.inbox) shared_->port->send(in.now, message);
    for (const Command& command : in.commands) shared_->port->send(in.now, command);
    AgentOutput& said = shared_->said;
    std::move(said.outbox.begin(), said.outbox.end(), std::back_inserter(out.outbox));
    std::move(said.events.begin(), said.events.end(), std::back_inserter(out.events));
    std::move(said.records.begin(), said.records.end(), std::back_inserter(out.records));
    said = {};
  }

 private:
  std::shared_ptr<RemoteEntity> shared_;
};

}  // namespace

RemoteVehicle::RemoteVehicle(RemoteEntityParts parts)
    : name_(std::move(parts.name)),
      self_(parts.self),
      shared_(std::make_shared<RemoteEntity>()),
      payload_(std::move(parts.payload)),
      max_age_(parts.max_age),
      believed_(!parts.hovers),
      true_(!parts.hovers),
      estimate_(parts.start),
      by_modem_(parts.by_modem) {
  shared_->port = std::move(parts.port);
}

std::unique_ptr<Agent> RemoteVehicle::agent() const {
  return std::make_unique<RemoteAgent>(shared_);
}

// What the entity says. Whose it is nobody outside decides.
struct RemoteVehicle::SayingListener {
  RemoteVehicle& self;

  void operator()(const RemoteState& state) const {
    if (self.state_ && state.nav.time < self.state_->nav.time) return;
    self.state_ = state;
    self.believed_.add(believed_motion(state.nav));
    if (state.truth) self.true_.add(true_motion(*state.truth, state.truth_time));
  }
  void operator()(const Message& message) const {
    self.shared_->said.outbox.push_back(message);
  }
  void operator()(Event event) const {
    event.entity = self.self_;
    self.shared_->said.events.push_back(std::move(event));
  }
  void operator()(FireReading reading) const {
    reading.aircraft = self.self_;
    self.shared_->said.records.emplace_back(reading);
  }
  void operator()(Crossing crossing) const {
    crossing.aircraft = self.self_;
    self.shared_->said.records.emplace_back(crossing);
  }
  void operator()(const RegionOfInterest& region) const {
    self.region_of_interest_ = region.place_N;
  }
  template <class Other>
  void operator()(const Other& other) const {
    self.shared_->said.records.emplace_back(other);
  }
};

struct RemoteVehicle::Listener {
  RemoteVehicle& self;

  void operator()(const LinkChange& change) const {
    self.events_.push_back({remote_event(change.kind), change.text});
    if (change.kind == LinkChange::Kind::kUp) self.up_ = true;
    if (change.kind == LinkChange::Kind::kDown) self.up_ = false;
  }
  void operator()(const OutsideEvent& event) const {
    self.events_.push_back({event.kind, event.text});
    if (event.kind == EventKind::kNeighbourFound) self.heard_ = true;
    if (event.kind == EventKind::kNeighbourLost) self.heard_ = false;
  }
  void operator()(const EntityReport& report) const {
    std::visit(SayingListener{self}, report.said);
  }
  template <class Other>
  void operator()(const Other&) const {}
};

void RemoteVehicle::begin(const Surroundings&, Time now) {
  begin_step(now);
}

void RemoteVehicle::begin_step(Time now) {
  now_ = now;
  const auto begin = static_cast<std::ptrdiff_t>(reports_.size());
  shared_->port->receive(now, reports_);
  if (blocked_) {
    // Of a link that was made to fail only its own state is learnt.
    reports_.erase(std::remove_if(reports_.begin() + begin, reports_.end(),
                                  [](const VehicleReport& report) {
                                    return !std::holds_alternative<LinkChange>(report) &&
                                           !std::holds_alternative<OutsideEvent>(report);
                                  }),
                   reports_.end());
  }
  for (auto report = reports_.begin() + begin; report != reports_.end(); ++report)
    std::visit(Listener{*this}, *report);
  carry_on(now);
}

void RemoteVehicle::carry_on(Time now) {
  const bool old = state_ && !fresh(now);
  if (old && !std::exchange(stale_, true))
    events_.push_back(
        {EventKind::kPositionOld, fmt::format("its last position is {:.1f} s old",
                                              (now - state_->nav.time).seconds())});
  if (!old) stale_ = false;
  if (believed_.known()) {
    estimate_ = as_estimate(believed_.at(now));
    estimate_.time = believed_.time();
  }
  truth_.reset();
  if (!fresh(now) || !state_->truth) return;
  const VehicleMotion motion = true_.at(now);
  truth_ = state_->truth;
  truth_->p_N = motion.p_N;
  truth_->v_N = motion.v_N;
  truth_->q_NB = motion.q_NB;
}

void RemoteVehicle::look(const Surroundings& world, Time now, PayloadSamples& out) {
  if (payload_.empty()) return;
  if (!fresh(now) || blocked_) {
    out.ends.resize(out.ends.size() + payload_.size(), out.samples.size());
    return;
  }
  const VehicleState state =
      truth_ ? *truth_ : as_state(believed_.at(now), state_->status.on_ground);
  Air air;
  air.wind_N = world.wind.wind(state.p_N, now);
  SensorView view{now,           state,           air,
                  world.terrain, world.phenomena, world.objects,
                  std::nullopt,  world.aircraft};
  if (region_of_interest_) view.gaze_N = *region_of_interest_ - estimate_.p_N;
  const std::size_t before = out.samples.size();
  for (const auto& sensor : payload_) {
    sensor->sample(view, out.samples);
    out.ends.push_back(out.samples.size());
  }
  if (out.samples.size() == before) return;
  PayloadReadings readings;
  readings.samples.assign(out.samples.begin() + static_cast<std::ptrdiff_t>(before),
                          out.samples.end());
  shared_->port->send(now, std::move(readings));
}

void RemoteVehicle::advance(const Surroundings&, Time, Time until, const Vehicle*) {
  now_ = until;
  carry_on(until);
}

AutopilotStatus RemoteVehicle::status() const {
  AutopilotStatus status;
  if (!state_) return status;
  status = state_->status;
  status.refused = state_->refused;
  return status;
}

void RemoteVehicle::pilot(const PilotInput& sticks) {
  if (!blocked_)
    shared_->port->send(now_, Command{VehicleCommand{name_, PilotRequest{sticks}}});
}

void RemoteVehicle::take_events(std::vector<VehicleEvent>& out) {
  for (VehicleEvent& event : events_) out.push_back(std::move(event));
  events_.clear();
}

void RemoteVehicle::take_reports(std::vector<VehicleReport>& out) {
  for (VehicleReport& report : reports_) out.push_back(std::move(report));
  reports_.clear();
}

Result<void> RemoteVehicle::set_fault(const std::string& part, bool fails, Time now) {
  if (part != "link") {
    shared_->port->send(now, Command{FaultCommand{name_, part, fails}});
    return {};
  }
  if (blocked_ == fails) return {};
  blocked_ = fails;
  events_.push_back({fails ? EventKind::kFailure : EventKind::kRepaired, "link"});
  return {};
}

}  // namespace skein::mixed
