// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/simulated_vehicle.h"

#include <utility>

#include "skein/base/check.h"
#include "skein/model/atmosphere/atmosphere.h"
#include "skein/role/plant_flight.h"
#include "skein/simulation/world.h"

namespace skein::simulation {

SimulatedVehicle::SimulatedVehicle(VehicleParts parts)
    : parts_(std::move(parts)),
      working_set_(this, sizeof *this, parts_),
      faults_(parts_.faults, parts_.breakable) {}

SensorView SimulatedVehicle::view(const Surroundings& world, Time now) const {
  SensorView view{now,           parts_.state,    parts_.air,
                  world.terrain, world.phenomena, world.objects,
                  std::nullopt,  world.aircraft};
  if (region_of_interest_)
    view.gaze_N = *region_of_interest_ - parts_.autopilot->estimate().p_N;
  return view;
}

// A sensor that says nothing goes on measuring: its errors wander, its clock runs, and
// when it speaks again it is about now.
void SimulatedVehicle::sample_one(Sensor& sensor, bool silent, const SensorView& view,
                                  std::vector<SensorSample>& out) const {
  const auto before = static_cast<std::ptrdiff_t>(out.size());
  sensor.sample(view, out);
  if (silent) out.erase(out.begin() + before, out.end());
}

void SimulatedVehicle::sense(const Surroundings& world, Time now) {
  flight_samples_.clear();
  const SensorView seen = view(world, now);
  for (std::size_t k = 0; k < parts_.sensors.size(); ++k)
    sample_one(*parts_.sensors[k], faults_.in_force().sensor_silent(k), seen,
               flight_samples_);
  for (const SensorSample& sample : flight_samples_) parts_.autopilot->sense(sample);
}

void SimulatedVehicle::begin(const Surroundings& world, Time now) {
  parts_.air.wind_N = world.wind.wind(parts_.state.p_N, now);
  parts_.autopilot->begin(as_estimate(parts_.state, now), parts_.state.on_ground);
  if (std::exchange(flew_, true)) {
    // What sensors have gathered since the last flight belongs to no flight.
    flight_samples_.clear();
    for (const auto& sensor : parts_.sensors)
      sample_one(*sensor, true, view(world, now), flight_samples_);
  } else {
    sense(world, now);
  }
}

void SimulatedVehicle::begin_step(Time now) {
  if (faults_.update(now, events_)) parts_.state.faults = faults_.in_force().plant;
}

void SimulatedVehicle::look(const Surroundings& world, Time now, PayloadSamples& out) {
  for (std::size_t k = 0; k < parts_.payload.size(); ++k) {
    sample_one(*parts_.payload[k], faults_.in_force().payload_silent(k), view(world, now),
               out.samples);
    out.ends.push_back(out.samples.size());
  }
}

void SimulatedVehicle::advance(const Surroundings& world, Time now, Time until,
                               const Vehicle* next) {
  const double dt = parts_.step.seconds();
  answered_ = true;
  // Within one step of the run no vehicle climbs so far that the density changes.
  parts_.air.density = model::standard_air(-parts_.state.p_N.z()).density;
  PlantFlight flight(parts_.name, *parts_.plant, parts_.turbulence.get(), parts_.state,
                     parts_.air, world.terrain, world.wind);
  const std::int64_t steps = (until - now).ns() / parts_.step.ns();
  for (std::int64_t step = 0; now < until; ++step) {
    if (next) next->prefetch(step, steps);
    const Control control = parts_.autopilot->control(now, dt);
    const bool last = now + parts_.step >= until;
    if (auto accident = flight.step(now, control, dt, last)) {
      lost_ = true;
      return events_.push_back({EventKind::kAccident, *std::move(accident)});
    }
    now += parts_.step;
    sense(world, now);
  }
}

void SimulatedVehicle::command(const AutopilotCommand& command) {
  ++commands_;
  refusals_before_ = parts_.autopilot->status().refusals;
  answered_ = false;
  parts_.autopilot->command(command);
}

CommandFate SimulatedVehicle::command_fate() const {
  if (commands_ == 0) return {};
  const AutopilotStatus status = parts_.autopilot->status();
  if (status.refusals > refusals_before_)
    return {commands_, CommandFate::State::kRefused, status.refused};
  return {commands_,
          answered_ ? CommandFate::State::kAccepted : CommandFate::State::kPending,
          {}};
}

void SimulatedVehicle::take_events(std::vector<VehicleEvent>& out) {
  for (VehicleEvent& event : events_) out.push_back(std::move(event));
  events_.clear();
}

Result<void> SimulatedVehicle::set_fault(const std::string& part, bool fails, Time now) {
  return faults_.set(parts_.name, part, fails, now);
}

const VehicleParts& parts_of(const Entity& entity) {
  const auto* simulated = dynamic_cast<const SimulatedVehicle*>(entity.vehicle.get());
  SKEIN_CHECK(simulated, entity.name);
  return simulated->parts();
}

}  // namespace skein::simulation
