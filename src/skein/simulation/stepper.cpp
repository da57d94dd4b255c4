// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/stepper.h"

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <utility>

#include "skein/base/log.h"
#include "skein/role/agent.h"
#include "skein/role/phenomenon.h"
#include "skein/role/terrain.h"
#include "skein/role/world_memory.h"
#include "skein/simulation/commanded_wind.h"
#include "skein/simulation/fork_join.h"
#include "skein/simulation/payload_log.h"

namespace skein::simulation {
namespace {

EntityId id_of(std::size_t index) {
  return EntityId{static_cast<std::uint32_t>(index)};
}

bool due(Time now, Time period) {
  return now.ns() % period.ns() == 0;
}

bool takes_part(const Entity& entity, Time now) {
  for (const ActiveSpan& span : entity.active)
    if (span.from <= now && now < span.until) return true;
  return false;
}

}  // namespace

Stepper::Stepper(World& world, const RunOptions& options, Recorder& recorder)
    : world_(world),
      options_(options),
      recorder_(recorder),
      records_(world, recorder),
      arena_(options.threads),
      objects_(world.objects),
      traffic_(world.traffic),
      tap_(recorder),
      states_(world.entities.size()),
      separation_(world.entities.size()) {
  for (const auto& each : world_.phenomena) phenomena_.push_back(each.get());
}

Surroundings Stepper::surroundings(std::size_t i) const {
  return {*world_.terrain, *world_.wind, phenomena_,
          objects_.visible_to(world_.entities[i].reality), traffic_.visible()};
}

Result<void> Stepper::step(Time now) {
  last_step_ = now;
  if (due(now, options_.environment_period))
    for (const auto& each : world_.phenomena) each->advance(now);
  move_objects(now);
  move_traffic(now);
  update_presence(now);
  update_parts(now);
  look(now);
  record_memory();
  think(now);
  exchange(now);
  if (due(now, options_.record_period)) records_.vehicles(states_, now);
  const Time next = now + options_.step;
  advance(now, next);
  record_accidents(now);
  watch_separation(next);
  record_status_changes(next);
  return recorder_.step_done(now);
}

void Stepper::finish() {
  news_.clear();
  world_.radio->end(news_);
  for (const MessageOutcome& outcome : news_.ended) records_.message(outcome, last_step_);
  separation_.finish(last_step_);
  records_.separation(separation_);
  if (last_step_ > records_.radios_recorded()) records_.radios(states_, last_step_);
}

template <class Body>
void Stepper::for_each(Body body) {
  constexpr std::size_t kGrain = 16;  // below this, starting tasks costs more than work
  const std::size_t count = states_.size();
  if (options_.threads <= 1 || count < 2 * kGrain) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  fork_join::fork();
  arena_.execute([&] {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, count, kGrain),
                              [&](const oneapi::tbb::blocked_range<std::size_t>& range) {
                                fork_join::begin_task();
                                for (std::size_t i = range.begin(); i < range.end(); ++i)
                                  body(i);
                                fork_join::end_task();
                              });
  });
  fork_join::join();
}

void Stepper::move_objects(Time now) {
  if (world_.objects.empty()) return;
  aircraft_places_.clear();
  physical_places_.clear();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const Vehicle* vehicle = world_.entities[i].vehicle.get();
    if (!states_[i].active || !vehicle) continue;
    const VehicleState* truth = vehicle->truth();
    const Vec3 place = truth ? truth->p_N : vehicle->estimate().p_N;
    aircraft_places_.push_back(place);
    if (world_.entities[i].reality.presence == Reality::kPhysical)
      physical_places_.push_back(place);
    if (world_.memory) world_.memory->take_position(now, id_of(i), place);
  }
  objects_.advance({now, aircraft_places_}, {now, physical_places_});
  if (world_.memory) {
    world_.memory->begin_step(now);
    objects_.remember(world_.memory->remembered());
  }
  if (due(now, options_.record_period)) objects_.record(now, recorder_);
}

void Stepper::move_traffic(Time now) {
  if (world_.traffic.empty() && !world_.finds_aircraft) return;
  visible_aircraft_.clear();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const Entity& entity = world_.entities[i];
    if (!states_[i].active || !entity.vehicle) continue;
    VisibleAircraft& seen = visible_aircraft_.emplace_back();
    if (const VehicleState* truth = entity.vehicle->truth()) {
      seen.p_N = truth->p_N;
      seen.v_N = truth->v_N;
    } else {
      const NavEstimate nav = entity.vehicle->estimate();
      seen.p_N = nav.p_N;
      seen.v_N = nav.v_N;
    }
    seen.address = entity.address;
    seen.sends = entity.sends;
    seen.entity = id_of(i);
  }
  traffic_.advance(now, visible_aircraft_);
  if (due(now, options_.record_period)) traffic_.record(now, recorder_);
}

bool Stepper::will_take_part(std::size_t i, Time now) const {
  const EntityState& state = states_[i];
  return !state.lost &&
         state.commanded_active.value_or(takes_part(world_.entities[i], now));
}

void Stepper::update_presence(Time now) {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    EntityState& state = states_[i];
    Entity& entity = world_.entities[i];
    const bool active = will_take_part(i, now);
    if (active == state.active) continue;
    state.active = active;
    state.begun = true;
    state.inbox.clear();
    if (active && entity.vehicle) {
      entity.vehicle->begin(surroundings(i), now);
      state.last_status = entity.vehicle->status();
      state.was_on_ground = state.last_status.on_ground;
    }
    records_.event(now, i, active ? EventKind::kJoined : EventKind::kLeft,
                   fmt::format("{} {}", entity.name,
                               active ? "takes part" : "no longer takes part"));
  }
}

void Stepper::update_parts(Time now) {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    Vehicle* vehicle = world_.entities[i].vehicle.get();
    if (!states_[i].active || !vehicle) continue;
    vehicle->begin_step(now);
    record_reports(now, i);
    vehicle_events_.clear();
    vehicle->take_events(vehicle_events_);
    for (VehicleEvent& event : vehicle_events_)
      records_.event(now, i, std::move(event.kind), std::move(event.text));
  }
}

// What a vehicle was told from outside of the run.
void Stepper::record_reports(Time now, std::size_t i) {
  vehicle_reports_.clear();
  world_.entities[i].vehicle->take_reports(vehicle_reports_);
  for (VehicleReport& report : vehicle_reports_)
    recorder_.record(VehicleReportRecord{now, id_of(i), std::move(report)});
}

void Stepper::look(Time now) {
  for_each([&](std::size_t i) {
    EntityState& state = states_[i];
    if (!state.active || !world_.entities[i].vehicle) return;
    state.fresh = state.payload.samples.size();
    state.payload.ends.clear();
    world_.entities[i].vehicle->look(surroundings(i), now, state.payload);
  });
  log_payload_samples(now);
}

// What cameras and ranging sensors have said in this step.
void Stepper::log_payload_samples(Time now) {
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (states_[i].active && states_[i].fresh < states_[i].payload.samples.size())
      log_payload_samples(now, i);
}

void Stepper::log_payload_samples(Time now, std::size_t i) {
  const EntityState& state = states_[i];
  const std::span<const SensorSample> samples = state.payload.samples;
  const NavEstimate nav = world_.entities[i].vehicle->estimate();
  Recorder& recorder = world_.memory ? tap_ : recorder_;
  std::size_t begin = state.fresh;
  for (std::uint32_t k = 0; k < state.payload.ends.size(); ++k) {
    const std::size_t end = state.payload.ends[k];
    log_payload(samples.subspan(begin, end - begin), id_of(i), k, nav, recorder);
    begin = end;
    if (!world_.memory) continue;
    world_.memory->take_payload(now, id_of(i), tap_.pictures, tap_.detections);
    tap_.clear();
  }
}

// What has become of what was seen of the physical world.
void Stepper::record_memory() {
  if (!world_.memory) return;
  observations_.clear();
  memory_events_.clear();
  world_.memory->take_news(observations_, memory_events_);
  for (const ObservationRecord& each : observations_) recorder_.record(each);
  for (const Event& each : memory_events_) records_.event(each);
}

void Stepper::think(Time now) {
  for_each([&](std::size_t i) { think(now, i); });
}

void Stepper::think(Time now, std::size_t i) {
  Entity& entity = world_.entities[i];
  EntityState& state = states_[i];
  if (!state.active || !due(now, entity.agent_period)) return;
  AgentInput in;
  in.now = now;
  NavEstimate nav;
  if (entity.vehicle) {
    nav = entity.vehicle->estimate();
    in.nav = &nav;
    in.autopilot = entity.vehicle->status();
    in.command_fate = entity.vehicle->command_fate();
  }
  in.samples = state.payload.samples;
  in.inbox = state.inbox;
  in.commands = state.commands;
  in.radio = world_.radio->status(id_of(i));
  entity.agent->step(in, state.output);
  if (entity.vehicle) {
    const auto& command = state.output.command;
    state.path = state.ahead.step(command ? &*command : nullptr, nav, now);
    if (command) entity.vehicle->command(*command);
  }
  if (state.output.return_route && entity.vehicle)
    entity.vehicle->set_return(*state.output.return_route);
  if (state.output.region_of_interest && entity.vehicle)
    entity.vehicle->set_region_of_interest(*state.output.region_of_interest);
  if (state.output.zones && entity.vehicle)
    entity.vehicle->set_zones(*state.output.zones);
  state.output.command.reset();
  state.output.return_route.reset();
  state.output.region_of_interest.reset();
  state.output.zones.reset();
  state.payload.samples.clear();
  state.fresh = 0;
  state.inbox.clear();
  state.commands.clear();
}

// Sends what agents wrote, in entity order, and hands out what has arrived.
void Stepper::exchange(Time now) {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    AgentOutput& output = states_[i].output;
    send(now, i);
    for (const Event& event : output.events) records_.event(event);
    for (const AgentRecord& said : output.records) records_.agent(now, i, said);
    if (auto path = std::exchange(states_[i].path, std::nullopt))
      recorder_.record(FlightPathRecord{now, id_of(i), *std::move(path)});
    output.outbox.clear();
    output.events.clear();
    output.records.clear();
  }
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const Vehicle* vehicle = world_.entities[i].vehicle.get();
    world_.radio->turn(id_of(i),
                       states_[i].active && (!vehicle || vehicle->link_works()));
  }
  receive(now);
  if (now > Time() && due(now, options_.radio_period)) records_.radios(states_, now);
}

void Stepper::send(Time now, std::size_t i) {
  const Vehicle* vehicle = world_.entities[i].vehicle.get();
  const bool works = !vehicle || vehicle->link_works();
  for (Message& message : states_[i].output.outbox) {
    message.from = id_of(i);
    message.sent = now;
    separation_.listen(message);
    if (message.to == kEveryone && !world_.radio->carries_broadcasts()) {
      send_to_all(std::move(message), works);
      continue;
    }
    message.number = states_[i].sent++;
    send(message, works);
  }
}

// To each of the others a copy of its own, which may be lost or late on its own.
void Stepper::send_to_all(Message message, bool works) {
  const std::size_t from = message.from.value;
  for (std::size_t k = 0; k < states_.size(); ++k) {
    if (k == from || !states_[k].active) continue;
    message.to = id_of(k);
    message.number = states_[from].sent++;
    send(message, works);
    message.copy = true;
  }
}

void Stepper::send(const Message& message, bool works) {
  if (works)
    world_.radio->send(message);
  else
    records_.message({message, LossCause::kLinkDown}, message.sent);
}

void Stepper::receive(Time now) {
  news_.clear();
  world_.radio->deliver(now, news_);
  for (const Event& event : news_.events) records_.event(event);
  for (MessageOutcome& outcome : news_.ended) {
    Message& message = outcome.message;
    const bool known =
        message.to.value < states_.size() && states_[message.to.value].active;
    Vehicle* vehicle = known ? world_.entities[message.to.value].vehicle.get() : nullptr;
    if (outcome.cause == LossCause::kNone) {
      if (!known) outcome.cause = LossCause::kNobody;
      if (vehicle && !vehicle->link_works()) outcome.cause = LossCause::kLinkDown;
    }
    records_.message(outcome, now);
    if (outcome.cause != LossCause::kNone) continue;
    if (vehicle && world_.entities[message.from.value].kind == "station")
      vehicle->ground_received(now);
    states_[message.to.value].inbox.push_back(std::move(message));
  }
}

void Stepper::advance(Time now, Time until) {
  for_each([&](std::size_t i) {
    Vehicle* vehicle = world_.entities[i].vehicle.get();
    if (!states_[i].active || !vehicle) return;
    const Vehicle* next =
        i + 1 < states_.size() ? world_.entities[i + 1].vehicle.get() : nullptr;
    vehicle->advance(surroundings(i), now, until, next);
    states_[i].status = vehicle->status();  // as long as it is at hand
    states_[i].lost = vehicle->lost();
  });
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (states_[i].active && world_.entities[i].vehicle) record_reports(now, i);
}

// What ends an aircraft, but not the run.
void Stepper::record_accidents(Time now) {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    Vehicle* vehicle = world_.entities[i].vehicle.get();
    if (!states_[i].active || !states_[i].lost) continue;
    vehicle_events_.clear();
    vehicle->take_events(vehicle_events_);
    for (VehicleEvent& event : vehicle_events_)
      records_.event(now, i, std::move(event.kind), std::move(event.text));
  }
}

// How near aircraft came to each other since the last step, by the truth; where nobody
// knows that, by what autopilots believe.
void Stepper::watch_separation(Time now) {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const Vehicle* vehicle = world_.entities[i].vehicle.get();
    if (!states_[i].active || states_[i].lost || !vehicle) continue;
    if (const VehicleState* truth = vehicle->truth()) {
      separation_.place(id_of(i), truth->p_N, truth->v_N, truth->on_ground);
    } else {
      const NavEstimate nav = vehicle->estimate();
      separation_.place(id_of(i), nav.p_N, nav.v_N, states_[i].status.on_ground);
    }
  }
  separation_.look(now);
  records_.separation(separation_);
}

// What autopilots do by themselves: modes and failsafes, take-offs and landings.
void Stepper::record_status_changes(Time now) {
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (states_[i].active && world_.entities[i].vehicle && !states_[i].lost)
      records_.status_changes(now, i, states_[i]);
}

}  // namespace skein::simulation
