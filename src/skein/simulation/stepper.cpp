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

// "battery: return", and what else is known of it.
std::string failsafe_text(const AutopilotStatus& status) {
  std::string text =
      fmt::format("{}: {}", name_of(status.trigger), name_of(status.reaction));
  if (!status.held.empty()) text.append(": ").append(status.held);
  return text;
}

std::optional<double> rms_sigma(const BoundaryEstimate& belief) {
  double sum = 0;
  int count = 0;
  for (const auto& ring : belief.rings)
    for (const BoundaryPoint& point : ring) {
      sum += point.sigma * point.sigma;
      ++count;
    }
  if (count == 0) return std::nullopt;
  return std::sqrt(sum / count);
}

}  // namespace

Stepper::Stepper(World& world, const RunOptions& options, Recorder& recorder)
    : world_(world),
      options_(options),
      recorder_(recorder),
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

void Stepper::introduce() {
  for (std::size_t i = 0; i < world_.entities.size(); ++i)
    recorder_.record(EntityRecord{id_of(i), world_.entities[i].name,
                                  world_.entities[i].kind, world_.entities[i].reality});
  for (const WorldObject& each : world_.objects) {
    recorder_.record(each.object);
    if (each.body) recorder_.record(*each.body);
  }
  for (const WorldTraffic& each : world_.traffic) recorder_.record(each.what);
  for (const Zone& zone : world_.zones)
    recorder_.record(ZoneRecord{Time(), {0, true, zone}});
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
  record_vehicles(now);
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
  for (const MessageOutcome& outcome : news_.ended) record_message(outcome, last_step_);
  separation_.finish(last_step_);
  record_separation();
  if (last_step_ > radios_recorded_) record_radios(last_step_);
}

std::string Stepper::headline() const {
  std::string line = sigma_ ? fmt::format("sigma {:.1f} m", *sigma_) : std::string();
  if (air_)
    line += fmt::format("{}air {:.0f} %, {} lost", line.empty() ? "" : ", ", 100 * *air_,
                        lost_before_);
  return line;
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
    state.inbox.clear();
    if (active && entity.vehicle) {
      entity.vehicle->begin(surroundings(i), now);
      state.last_status = entity.vehicle->status();
      state.was_on_ground = state.last_status.on_ground;
    }
    record_event(now, i, active ? "joined" : "left",
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
      record_event(now, i, std::move(event.kind), std::move(event.text));
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
  for (const Event& each : memory_events_) record_event(each);
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
    for (const Event& event : output.events) record_event(event);
    for (const AgentRecord& said : output.records) record_agent(now, i, said);
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
  if (now > Time() && due(now, options_.radio_period)) record_radios(now);
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
    record_message({message, LossCause::kLinkDown}, message.sent);
}

void Stepper::receive(Time now) {
  news_.clear();
  world_.radio->deliver(now, news_);
  for (const Event& event : news_.events) record_event(event);
  for (MessageOutcome& outcome : news_.ended) {
    Message& message = outcome.message;
    const bool known =
        message.to.value < states_.size() && states_[message.to.value].active;
    Vehicle* vehicle = known ? world_.entities[message.to.value].vehicle.get() : nullptr;
    if (outcome.cause == LossCause::kNone) {
      if (!known) outcome.cause = LossCause::kNobody;
      if (vehicle && !vehicle->link_works()) outcome.cause = LossCause::kLinkDown;
    }
    record_message(outcome, now);
    if (outcome.cause != LossCause::kNone) continue;
    if (vehicle && world_.entities[message.from.value].kind == "station")
      vehicle->ground_received(now);
    states_[message.to.value].inbox.push_back(std::move(message));
  }
}

void Stepper::record_radios(Time now) {
  radios_recorded_ = now;
  lost_before_ = std::exchange(lost_, 0);
  const RadioStatistics statistics = world_.radio->take_statistics();
  for (std::size_t i = 0; i < statistics.radios.size() && i < states_.size(); ++i) {
    if (!states_[i].active) continue;
    const RadioUse& use = statistics.radios[i];
    air_ = i == 0 ? use.load() : std::max(air_.value_or(0), use.load());
    recorder_.record(RadioUseRecord{now, id_of(i), use});
  }
  for (const LinkUse& use : statistics.links) recorder_.record(LinkUseRecord{now, use});
}

void Stepper::record_vehicles(Time now) {
  if (!due(now, options_.record_period)) return;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const Vehicle* vehicle = world_.entities[i].vehicle.get();
    if (!states_[i].active || !vehicle) continue;
    if (const VehicleState* truth = vehicle->truth())
      recorder_.record(TruthRecord{now, id_of(i), *truth});
    recorder_.record(EstimateRecord{id_of(i), vehicle->estimate(), vehicle->status()});
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
      record_event(now, i, std::move(event.kind), std::move(event.text));
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
  record_separation();
}

void Stepper::record_separation() {
  for (const SeparationLossRecord& loss : separation_.begun()) {
    const Event event{
        loss.begun, loss.id, "separation-lost",
        fmt::format("{} and {} are {:.1f} m beside and {:.1f} m above each other; {:g} m "
                    "or {:g} m are required ({})",
                    name_of_entity(loss.id), name_of_entity(loss.other), loss.horizontal,
                    loss.vertical, loss.required_horizontal, loss.required_vertical,
                    name_of(loss.phase))};
    // Where nobody keeps apart it is no news.
    if (separation_.keeps_apart(loss.id) || separation_.keeps_apart(loss.other))
      record_event(event);
    else
      record_quietly(event);
  }
  for (const SeparationLossRecord& loss : separation_.over()) {
    recorder_.record(loss);
    record_quietly(
        {loss.time, loss.id,
         loss.over ? "separation-restored" : "separation-not-restored",
         fmt::format("{} and {}: least distance {:.1f} m, ratio {:.2f} at {:.1f} s ({})",
                     name_of_entity(loss.id), name_of_entity(loss.other), loss.distance,
                     loss.ratio, loss.closest.seconds(), name_of(loss.phase))});
  }
}

// What autopilots do by themselves: modes and failsafes, take-offs and landings.
void Stepper::record_status_changes(Time now) {
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (states_[i].active && world_.entities[i].vehicle && !states_[i].lost)
      record_status_changes(now, i);
}

void Stepper::record_status_changes(Time now, std::size_t i) {
  EntityState& state = states_[i];
  const AutopilotStatus& status = state.status;
  const AutopilotStatus& last = state.last_status;
  if (status.mode != last.mode)
    record_event(now, i, "mode", std::string(name_of(status.mode)));
  // A reaction without a trigger is no failsafe: somebody else flies it.
  const bool acts = status.trigger != FailsafeTrigger::kNone;
  if (status.trigger != last.trigger || (acts && status.reaction != last.reaction))
    record_event(now, i, "failsafe", acts ? failsafe_text(status) : "over");
  record_sensor_changes(now, i);
  if (status.refusals > last.refusals)
    if (auto text =
            state.refusals.report(now, status.refusals - last.refusals, status.refused))
      record_event(now, i, "refused", *std::move(text));
  if (status.on_ground != state.was_on_ground)
    record_event(now, i, status.on_ground ? "landed" : "took-off",
                 fmt::format("{} {} the ground", world_.entities[i].name,
                             status.on_ground ? "stands on" : "has left"));
  state.was_on_ground = status.on_ground;
  state.last_status = status;
}

// Flight sensors that an autopilot misses, receives again, or has replaced by a spare.
void Stepper::record_sensor_changes(Time now, std::size_t i) {
  const AutopilotStatus& status = states_[i].status;
  const AutopilotStatus& last = states_[i].last_status;
  if (status.lost_sensors == last.lost_sensors && status.units == last.units) return;
  for (std::size_t k = 0; k < kFlightSensors; ++k) {
    const auto sensor = static_cast<FlightSensor>(k);
    const bool lost = (status.lost_sensors >> k & 1u) != 0;
    if (lost != ((last.lost_sensors >> k & 1u) != 0))
      record_event(now, i, lost ? "sensor-lost" : "sensor-back",
                   lost ? fmt::format("{}: {}", name_of(sensor), instead_of(sensor))
                        : std::string(name_of(sensor)));
    if (status.units[k] != last.units[k])
      record_event(
          now, i, "sensor-switched",
          fmt::format("{}: flies by number {}", name_of(sensor), status.units[k] + 1));
  }
}

void Stepper::record_agent(Time now, std::size_t i, const AgentRecord& said) {
  struct Maker {
    Stepper& stepper;
    Time now;
    EntityId agent;
    Record operator()(const FireReading& reading) { return reading; }
    Record operator()(const Crossing& crossing) { return crossing; }
    Record operator()(const ZoneChange& change) { return ZoneRecord{now, change}; }
    Record operator()(const PerimeterBelief& belief) {
      stepper.sigma_ = rms_sigma(belief.boundary);
      const auto& all = stepper.world_.phenomena;
      return PerimeterRecord{now,
                             agent,
                             belief.phenomenon < all.size()
                                 ? all[belief.phenomenon]->region()
                                 : geo::Region(),
                             belief.boundary,
                             belief.mission,
                             belief.phenomenon};
    }
    Record operator()(const PerimeterForecast& forecast) {
      return ForecastRecord{agent, forecast};
    }
    Record operator()(const ArrivalForecast& forecast) {
      return ArrivalRecord{agent, forecast};
    }
    Record operator()(const ObjectBelief& belief) {
      return ObjectBeliefRecord{now, agent, belief};
    }
    Record operator()(const MissionChange& change) {
      return MissionRecord{now, agent, change};
    }
    Record operator()(const PluginRecord& record) { return record; }
    Record operator()(const MissionProgress& progress) {
      return MissionProgressRecord{now, agent, progress};
    }
    Record operator()(const ConflictReport& report) {
      return ConflictRecord{now, agent, report};
    }
    Record operator()(const TeamLead& lead) { return TeamLeadRecord{now, agent, lead}; }
    Record operator()(const TeamAllocationReport& report) {
      return TeamAllocationRecord{now, agent, report};
    }
    Record operator()(const TeamTaskReport& report) {
      return TeamTaskRecord{now, agent, report};
    }
    Record operator()(const TrafficBelief& belief) {
      return TrafficBeliefRecord{now, agent, belief};
    }
    Record operator()(const TrafficAlert& alert) {
      return AlertRecord{now, agent, alert};
    }
    Record operator()(const FlightBands& bands) { return BandRecord{now, agent, bands}; }
    Record operator()(const Recommendation& recommendation) {
      return RecommendationRecord{now, agent, recommendation};
    }
    Record operator()(const PlannerChange& change) {
      return PlannerRecord{now, agent, change};
    }
    Record operator()(const TaskReason& reason) {
      return TaskReasonRecord{now, agent, reason};
    }
  };
  recorder_.record(std::visit(Maker{*this, now, id_of(i)}, said));
}

void Stepper::record_message(const MessageOutcome& outcome, Time ended) {
  const Message& message = outcome.message;
  const auto* team = std::get_if<TeamMessage>(&message.content);
  const bool arrived = outcome.cause == LossCause::kNone;
  const bool lost = !arrived && outcome.cause != LossCause::kPending;
  if (lost && !message.forged) ++lost_;
  std::optional<Time> read;
  if (arrived) {
    // The first step of its receiver's agent from now on; this step's is over.
    const Time period = world_.entities[message.to.value].agent_period;
    read = period * (ended.ns() / period.ns() + 1);
  }
  recorder_.record(
      MessageRecord{message, ended, static_cast<std::uint32_t>(coded_size(message)), lost,
                    team ? std::string(kind_of(team->content)) : std::string(),
                    message.copy, outcome.cause, outcome.way, message.forged, read});
}

void Stepper::record_event(Time now, std::size_t i, std::string kind, std::string text) {
  record_event({now, id_of(i), std::move(kind), std::move(text)});
}

std::string_view Stepper::name_of_entity(EntityId id) const {
  return id.value < world_.entities.size()
             ? std::string_view(world_.entities[id.value].name)
             : std::string_view("?");
}

void Stepper::record_event(const Event& event) {
  record_quietly(event);
  if (is_announced(event)) announcements_.push_back(event);
}

void Stepper::record_quietly(const Event& event) {
  log_info("{:.1f} s, {}: {}: {}", event.time.seconds(), name_of_entity(event.entity),
           event.kind, event.text);
  recorder_.record(event);
}

}  // namespace skein::simulation
