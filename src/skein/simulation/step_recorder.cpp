// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/step_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/log.h"
#include "skein/role/phenomenon.h"
#include "skein/role/radio.h"
#include "skein/role/vehicle.h"

namespace skein::simulation {
namespace {

EntityId entity_at(std::size_t index) {
  return EntityId{static_cast<std::uint32_t>(index)};
}

// "battery: return", and what else is known of it.
std::string failsafe_text(const AutopilotStatus& status) {
  std::string text =
      fmt::format("{}: {}", name_of(status.trigger), name_of(status.reaction));
  if (!status.held.empty()) text.append(": ").append(status.held);
  return text;
}

// Whether something else than its agent flies the aircraft.
bool is_acting(const AutopilotStatus& status) {
  return status.reaction != FailsafeReaction::kNone || !status.held.empty();
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

void StepRecorder::introduce() {
  for (std::size_t i = 0; i < world_.entities.size(); ++i)
    recorder_.record(EntityRecord{entity_at(i), world_.entities[i].name,
                                  world_.entities[i].kind, world_.entities[i].reality});
  for (const WorldObject& each : world_.objects) {
    recorder_.record(each.object);
    if (each.body) recorder_.record(*each.body);
  }
  for (const WorldTraffic& each : world_.traffic) recorder_.record(each.what);
  for (const Zone& zone : world_.zones)
    recorder_.record(ZoneRecord{Time(), {0, true, zone}});
}

void StepRecorder::vehicles(std::span<const EntityState> states, Time now) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    const Vehicle* vehicle = world_.entities[i].vehicle.get();
    if (!states[i].active || !vehicle) continue;
    if (const VehicleState* truth = vehicle->truth())
      recorder_.record(TruthRecord{now, entity_at(i), *truth});
    recorder_.record(
        EstimateRecord{entity_at(i), vehicle->estimate(), vehicle->status()});
  }
}

void StepRecorder::radios(std::span<const EntityState> states, Time now) {
  radios_recorded_ = now;
  lost_before_ = std::exchange(lost_, 0);
  const RadioStatistics statistics = world_.radio->take_statistics();
  for (std::size_t i = 0; i < statistics.radios.size() && i < states.size(); ++i) {
    if (!states[i].active) continue;
    const RadioUse& use = statistics.radios[i];
    air_ = i == 0 ? use.load() : std::max(air_.value_or(0), use.load());
    recorder_.record(RadioUseRecord{now, entity_at(i), use});
  }
  for (const LinkUse& use : statistics.links) recorder_.record(LinkUseRecord{now, use});
}

void StepRecorder::agent(Time now, std::size_t i, const AgentRecord& said) {
  struct Maker {
    StepRecorder& recorder;
    Time now;
    EntityId agent;
    Record operator()(const FireReading& reading) { return reading; }
    Record operator()(const Crossing& crossing) { return crossing; }
    Record operator()(const ZoneChange& change) { return ZoneRecord{now, change}; }
    Record operator()(const PerimeterBelief& belief) {
      recorder.sigma_ = rms_sigma(belief.boundary);
      const auto& all = recorder.world_.phenomena;
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
  recorder_.record(std::visit(Maker{*this, now, entity_at(i)}, said));
}

void StepRecorder::message(const MessageOutcome& outcome, Time ended) {
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

void StepRecorder::separation(const SeparationMonitor& monitor) {
  for (const SeparationLossRecord& loss : monitor.begun()) {
    const Event begun{
        loss.begun,
        loss.id,
        EventKind::kSeparationLost,
        fmt::format("{} and {} are {:.1f} m beside and {:.1f} m above each other; {:g} m "
                    "or {:g} m are required ({})",
                    name_of_entity(loss.id), name_of_entity(loss.other), loss.horizontal,
                    loss.vertical, loss.required_horizontal, loss.required_vertical,
                    name_of(loss.phase)),
        {.other = loss.other,
         .value = loss.horizontal,
         .threshold = loss.required_horizontal}};
    // Where nobody keeps apart it is no news.
    if (monitor.keeps_apart(loss.id) || monitor.keeps_apart(loss.other))
      event(begun);
    else
      event_quietly(begun);
  }
  for (const SeparationLossRecord& loss : monitor.over()) {
    recorder_.record(loss);
    event_quietly(
        {loss.time,
         loss.id,
         loss.over ? EventKind::kSeparationRestored : EventKind::kSeparationNotRestored,
         fmt::format("{} and {}: least distance {:.1f} m, ratio {:.2f} at {:.1f} s ({})",
                     name_of_entity(loss.id), name_of_entity(loss.other), loss.distance,
                     loss.ratio, loss.closest.seconds(), name_of(loss.phase)),
         {.other = loss.other, .value = loss.distance}});
  }
}

void StepRecorder::status_changes(Time now, std::size_t i, EntityState& state) {
  const AutopilotStatus& status = state.status;
  const AutopilotStatus& last = state.last_status;
  if (status.mode != last.mode)
    event(now, i, EventKind::kMode, std::string(name_of(status.mode)));
  // A reaction without a trigger is no failsafe: somebody else flies it.
  const bool acts = status.trigger != FailsafeTrigger::kNone;
  if (status.trigger != last.trigger || (acts && status.reaction != last.reaction))
    event(now, i, EventKind::kFailsafe, acts ? failsafe_text(status) : "over",
          {.value = acts && is_acting(status) ? 1 : 0});
  sensor_changes(now, i, state);
  if (status.refusals > last.refusals)
    if (auto text =
            state.refusals.report(now, status.refusals - last.refusals, status.refused))
      event(now, i, EventKind::kRefused, *std::move(text));
  if (status.on_ground != state.was_on_ground)
    event(now, i, status.on_ground ? EventKind::kLanded : EventKind::kTookOff,
          fmt::format("{} {} the ground", world_.entities[i].name,
                      status.on_ground ? "stands on" : "has left"));
  state.was_on_ground = status.on_ground;
  state.last_status = status;
}

// Flight sensors that an autopilot misses, receives again, or has replaced by a spare.
void StepRecorder::sensor_changes(Time now, std::size_t i, const EntityState& state) {
  const AutopilotStatus& status = state.status;
  const AutopilotStatus& last = state.last_status;
  if (status.lost_sensors == last.lost_sensors && status.units == last.units) return;
  for (std::size_t k = 0; k < kFlightSensors; ++k) {
    const auto sensor = static_cast<FlightSensor>(k);
    const bool lost = (status.lost_sensors >> k & 1u) != 0;
    if (lost != ((last.lost_sensors >> k & 1u) != 0))
      event(now, i, lost ? EventKind::kSensorLost : EventKind::kSensorBack,
            lost ? fmt::format("{}: {}", name_of(sensor), instead_of(sensor))
                 : std::string(name_of(sensor)));
    if (status.units[k] != last.units[k])
      event(now, i, EventKind::kSensorSwitched,
            fmt::format("{}: flies by number {}", name_of(sensor), status.units[k] + 1),
            {.value = status.units[k] + 1});
  }
}

void StepRecorder::event(Time now, std::size_t i, EventLabel kind, std::string text,
                         EventNumbers numbers) {
  event({now, entity_at(i), std::move(kind), std::move(text), numbers});
}

void StepRecorder::event(const Event& event) {
  event_quietly(event);
  if (is_announced(event)) announcements_.push_back(event);
}

void StepRecorder::event_quietly(const Event& event) {
  log_info("{:.1f} s, {}: {}: {}", event.time.seconds(), name_of_entity(event.entity),
           event.kind.name(), event.text);
  recorder_.record(event);
}

std::string_view StepRecorder::name_of_entity(EntityId id) const {
  return id.value < world_.entities.size()
             ? std::string_view(world_.entities[id.value].name)
             : std::string_view("?");
}

std::string StepRecorder::headline() const {
  std::string line = sigma_ ? fmt::format("sigma {:.1f} m", *sigma_) : std::string();
  if (air_)
    line += fmt::format("{}air {:.0f} %, {} lost", line.empty() ? "" : ", ", 100 * *air_,
                        lost_before_);
  return line;
}

}  // namespace skein::simulation
