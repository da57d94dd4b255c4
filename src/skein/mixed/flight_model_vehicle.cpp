// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/flight_model_vehicle.h"

#include <fmt/format.h>

#include <utility>

#include "skein/model/atmosphere/atmosphere.h"

namespace skein::mixed {

FlightModelVehicle::FlightModelVehicle(FlightModelVehicleParts parts)
    : parts_(std::move(parts)),
      faults_(std::move(parts_.faults), std::move(parts_.breakable)) {}

// What the model says, one report after the other; other kinds it does not have.
struct FlightModelVehicle::Listener {
  FlightModelVehicle& self;

  void operator()(const VehicleMotion& motion) const { self.hear(motion); }
  void operator()(const VehicleCondition& condition) const {
    self.parts_.state.on_ground = condition.on_ground;
    self.parts_.state.energy.charge = condition.charge;
  }
  void operator()(const LinkChange& change) const {
    if (change.kind != LinkChange::Kind::kRebooted) return;
    self.events_.push_back({EventKind::kFlightModelReset, change.text});
    self.motion_.forget();
    self.begins_ = true;
  }
  void operator()(const OutsideEvent& event) const {
    self.events_.push_back({event.kind, event.text});
  }
  template <class Other>
  void operator()(const Other&) const {}
};

void FlightModelVehicle::hear(const VehicleMotion& motion) {
  motion_.add(motion);
  if (contact_ == Contact::kHeard) return;
  const bool first = contact_ == Contact::kNone;
  events_.push_back(
      {first ? EventKind::kFlightModelHeard : EventKind::kFlightModelBack, ""});
  contact_ = Contact::kHeard;
  begins_ = true;
}

void FlightModelVehicle::begin(const Surroundings& world, Time now) {
  parts_.air.wind_N = world.wind.wind(parts_.state.p_N, now);
  begin_step(now);
  begin_flight(now);
}

// The autopilot's flight begins (again) where the model is.
void FlightModelVehicle::begin_flight(Time now) {
  begins_ = false;
  NavEstimate start = as_estimate(parts_.state, now);
  start.wind_N = geo::horizontal(parts_.air.wind_N);
  parts_.autopilot->begin(start, parts_.state.on_ground);
  if (commanded_) parts_.autopilot->command(*commanded_);
}

void FlightModelVehicle::begin_step(Time now) {
  faults_.update(now, events_);
  const auto first = static_cast<std::ptrdiff_t>(reports_.size());
  // Once a step: what it begins with is what a run that is done again begins with.
  if (std::exchange(received_, now) != now) parts_.model->receive(now, reports_);
  for (auto report = reports_.begin() + first; report != reports_.end(); ++report)
    std::visit(Listener{*this}, *report);
  const bool old = !motion_.known() || now - motion_.newest().time > parts_.max_age;
  if (old && contact_ == Contact::kHeard) {
    contact_ = Contact::kSilent;
    events_.push_back({EventKind::kFlightModelSilent,
                       fmt::format("nothing for {:.1f} s; its controls stay",
                                   parts_.max_age.seconds())});
  }
  if (contact_ == Contact::kHeard) place(now);
}

// The truth at `now`.
void FlightModelVehicle::place(Time now) {
  const VehicleMotion motion = motion_.at(now);
  VehicleState& state = parts_.state;
  state.p_N = motion.p_N;
  state.v_N = motion.v_N;
  state.q_NB = motion.q_NB;
  state.w_NB_B = motion.w_NB_B;
  state.airspeed = motion.airspeed;
  state.actuators = actuators_.channel;
  parts_.air.wind_N = {motion.wind_N.x(), motion.wind_N.y(), 0};
  parts_.air.density = model::standard_air(-state.p_N.z()).density;
}

SensorView FlightModelVehicle::view(const Surroundings& world, Time now) const {
  SensorView view{now,           parts_.state,    parts_.air,
                  world.terrain, world.phenomena, world.objects,
                  std::nullopt,  world.aircraft};
  if (region_of_interest_)
    view.gaze_N = *region_of_interest_ - parts_.autopilot->estimate().p_N;
  return view;
}

void FlightModelVehicle::look(const Surroundings& world, Time now, PayloadSamples& out) {
  for (std::size_t k = 0; k < parts_.payload.size(); ++k) {
    const auto before = static_cast<std::ptrdiff_t>(out.samples.size());
    if (contact_ == Contact::kHeard)
      parts_.payload[k]->sample(view(world, now), out.samples);
    if (faults_.in_force().payload_silent(k))
      out.samples.erase(out.samples.begin() + before, out.samples.end());
    out.ends.push_back(out.samples.size());
  }
}

// A sensor that says nothing goes on measuring, as a simulated vehicle's.
void FlightModelVehicle::sense(const Surroundings& world, Time now) {
  samples_.clear();
  const SensorView seen = view(world, now);
  for (std::size_t k = 0; k < parts_.sensors.size(); ++k) {
    const auto before = static_cast<std::ptrdiff_t>(samples_.size());
    parts_.sensors[k]->sample(seen, samples_);
    if (faults_.in_force().sensor_silent(k))
      samples_.erase(samples_.begin() + before, samples_.end());
  }
  // What has been gathered since an earlier flight belongs to no flight.
  if (begins_) return begin_flight(now);
  for (const SensorSample& sample : samples_) parts_.autopilot->sense(sample);
}

void FlightModelVehicle::advance(const Surroundings& world, Time now, Time until,
                                 const Vehicle*) {
  if (contact_ == Contact::kHeard) {
    sense(world, now);
    const Control control = parts_.autopilot->control(now, (until - now).seconds());
    if (const auto* actuators = std::get_if<Actuators>(&control)) actuators_ = *actuators;
    answered_ = true;
  }
  parts_.model->send(actuators_, world.wind.wind(parts_.state.p_N, now));
}

void FlightModelVehicle::command(const AutopilotCommand& command) {
  ++commands_;
  refusals_before_ = parts_.autopilot->status().refusals;
  answered_ = false;
  commanded_ = command;
  parts_.autopilot->command(command);
}

CommandFate FlightModelVehicle::command_fate() const {
  if (commands_ == 0) return {};
  const AutopilotStatus status = parts_.autopilot->status();
  if (status.refusals > refusals_before_)
    return {commands_, CommandFate::State::kRefused, status.refused};
  return {commands_,
          answered_ ? CommandFate::State::kAccepted : CommandFate::State::kPending,
          {}};
}

void FlightModelVehicle::take_events(std::vector<VehicleEvent>& out) {
  for (VehicleEvent& event : events_) out.push_back(std::move(event));
  events_.clear();
}

void FlightModelVehicle::take_reports(std::vector<VehicleReport>& out) {
  for (VehicleReport& report : reports_) out.push_back(std::move(report));
  reports_.clear();
}

}  // namespace skein::mixed
