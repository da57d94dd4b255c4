#include "skein/simulation/run.h"

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <new>

#include "skein/base/log.h"
#include "skein/simulation/entity_step.h"
#include "skein/simulation/fork_join.h"
#include "skein/simulation/pace.h"
#include "skein/simulation/payload_log.h"
#include "skein/simulation/refusals.h"
#include "skein/simulation/working_set.h"

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

std::string text_of(const VehicleState& s) {
  const geo::Euler a = geo::to_euler(s.q_NB);
  return fmt::format(
      "at {:.1f} m north, {:.1f} m east, {:.1f} m above sea level, {:.1f} m/s through "
      "the "
      "air, roll {:.0f}, pitch {:.0f}, heading {:.0f} deg, turning at {:.2f}, {:.2f}, "
      "{:.2f} rad/s",
      s.p_N.x(), s.p_N.y(), -s.p_N.z(), s.airspeed, geo::degrees(a.roll),
      geo::degrees(a.pitch), geo::degrees(geo::wrap_2pi(a.yaw)), s.w_NB_B.x(),
      s.w_NB_B.y(), s.w_NB_B.z());
}

// One run: the world, what is between its phases, and where it is recorded.
class Stepper {
 public:
  Stepper(World& world, const RunOptions& options, Recorder& recorder)
      : world_(world),
        options_(options),
        recorder_(recorder),
        arena_(options.threads),
        states_(world.entities.size()),
        watched_(world.entities.size()) {
    working_sets_.reserve(states_.size());
    for (std::size_t i = 0; i < states_.size(); ++i)
      working_sets_.emplace_back(world.entities[i], states_[i]);
  }

  /// @param wishes  of the operator since the last step.
  Result<void> step(Time now, const std::vector<ZoneChange>& wishes) {
    if (due(now, options_.environment_period)) world_.fire->advance(now);
    update_presence(now);
    take(now, wishes);
    update_parts(now);
    for_each([&](std::size_t i) { sense(world_, now, world_.entities[i], states_[i]); });
    note_payload();
    for_each([&](std::size_t i) { think(now, world_.entities[i], states_[i]); });
    exchange(now);
    record(now);
    const Time next = now + options_.step;
    for_each([&](std::size_t i) {
      const WorkingSet* after = i + 1 < states_.size() ? &working_sets_[i + 1] : nullptr;
      fly(world_, now, next, world_.entities[i], states_[i], after);
    });
    note_accidents(now);
    note_autopilots(next);
    return recorder_.step_done(now);
  }

  void introduce() {
    for (std::size_t i = 0; i < world_.entities.size(); ++i)
      recorder_.entity(id_of(i), world_.entities[i].name, world_.entities[i].kind);
    for (const GroundObject& object : world_.objects) recorder_.object(object);
    for (const Zone& zone : world_.zones) recorder_.zone(Time(), {0, true, zone});
  }

 private:
  template <class Body>
  void for_each(const Body& body) {
    constexpr std::size_t kGrain = 16;  // below this, starting tasks costs more than work
    const std::size_t count = states_.size();
    if (options_.threads <= 1 || count < 2 * kGrain) {
      for (std::size_t i = 0; i < count; ++i) body(i);
      return;
    }
    fork_join::fork();
    arena_.execute([&] {
      oneapi::tbb::parallel_for(
          oneapi::tbb::blocked_range<std::size_t>(0, count, kGrain),
          [&](const oneapi::tbb::blocked_range<std::size_t>& range) {
            fork_join::begin_task();
            for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
            fork_join::end_task();
          });
    });
    fork_join::join();
  }

  // What the operator has asked for goes to the ground stations, where the operator is.
  void take(Time now, const std::vector<ZoneChange>& wishes) {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (world_.entities[i].vehicle || !states_[i].active) continue;
      for (const ZoneChange& wish : wishes) {
        Message message;
        message.from = message.to = id_of(i);
        message.sent = now;
        message.content = wish;
        states_[i].inbox.push_back(std::move(message));
      }
    }
  }

  void tell(Time now, std::size_t i, const char* kind, std::string text) {
    note({now, id_of(i), kind, std::move(text)});
  }

  void note(const Event& event) {
    const std::size_t who = event.entity.value;
    log_info("{:.1f} s, {}: {}: {}", event.time.seconds(),
             who < world_.entities.size() ? std::string_view(world_.entities[who].name)
                                          : std::string_view("?"),
             event.kind, event.text);
    recorder_.event(event);
  }

  void update_presence(Time now) {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      EntityState& state = states_[i];
      const bool active = !state.ended && takes_part(world_.entities[i], now);
      if (active == state.active) continue;
      state.active = active;
      if (active)
        begin(i, now);
      else
        state.inbox.clear();
      tell(now, i, active ? "joined" : "left",
           fmt::format("{} {}", world_.entities[i].name,
                       active ? "takes part" : "no longer takes part"));
    }
  }

  void begin(std::size_t i, Time now) {
    Entity& entity = world_.entities[i];
    simulation::begin(world_, now, entity, states_[i]);
    if (entity.vehicle)
      watched_[i].on_ground = entity.vehicle->autopilot->status().on_ground;
  }

  // What cameras and ranging sensors have said in this step.
  void note_payload() {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const EntityState& state = states_[i];
      const std::span<const SensorSample> samples = state.samples;
      if (!state.active || state.fresh == samples.size()) continue;
      const Autopilot& autopilot = *world_.entities[i].vehicle->autopilot;
      std::size_t begin = state.fresh;
      for (std::uint32_t k = 0; k < state.payload_ends.size(); ++k) {
        const std::size_t end = state.payload_ends[k];
        log_payload(samples.subspan(begin, end - begin), id_of(i), k, autopilot,
                    recorder_);
        begin = end;
      }
    }
  }

  // Parts that fail, or work again.
  void update_parts(Time now) {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      Entity& entity = world_.entities[i];
      if (!states_[i].active || !entity.vehicle || entity.vehicle->faults.empty())
        continue;
      for (const std::size_t k : update_faults(now, entity, states_[i])) {
        const VehicleFault& fault = entity.vehicle->faults[k];
        const bool fails = states_[i].fault_active[k];
        tell(now, i, fails ? "failure" : "repaired",
             fails ? text_of(fault) : text_of_end(fault));
      }
    }
  }

  // What autopilots do by themselves: modes and failsafes, take-offs and landings.
  void note_autopilots(Time now) {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      if (!states_[i].active || states_[i].ended || !world_.entities[i].vehicle) continue;
      const AutopilotStatus& status = states_[i].status;
      AutopilotStatus& told = states_[i].told;
      if (status.mode != told.mode)
        tell(now, i, "mode", std::string(name_of(status.mode)));
      if (status.trigger != told.trigger || status.reaction != told.reaction)
        tell(now, i, "failsafe",
             status.trigger == FailsafeTrigger::kNone
                 ? std::string("over")
                 : fmt::format("{}: {}", name_of(status.trigger),
                               name_of(status.reaction)));
      note_sensors(now, i, status, told);
      Watched& watched = watched_[i];
      if (status.refusals > told.refusals)
        if (auto text = watched.refusals.told(now, status.refusals - told.refusals,
                                              status.refused))
          tell(now, i, "refused", *std::move(text));
      if (status.on_ground != watched.on_ground)
        tell(now, i, status.on_ground ? "landed" : "took-off",
             fmt::format("{} {} the ground", world_.entities[i].name,
                         status.on_ground ? "stands on" : "has left"));
      watched.on_ground = status.on_ground;
      told = status;
    }
  }

  // Flight sensors that an autopilot misses, hears again, or has replaced by a spare.
  void note_sensors(Time now, std::size_t i, const AutopilotStatus& status,
                    const AutopilotStatus& told) {
    if (status.lost_sensors == told.lost_sensors && status.units == told.units) return;
    for (std::size_t k = 0; k < kFlightSensors; ++k) {
      const auto sensor = static_cast<FlightSensor>(k);
      const bool lost = (status.lost_sensors >> k & 1u) != 0;
      if (lost != ((told.lost_sensors >> k & 1u) != 0))
        tell(now, i, lost ? "sensor-lost" : "sensor-back",
             lost ? fmt::format("{}: {}", name_of(sensor), instead_of(sensor))
                  : std::string(name_of(sensor)));
      if (status.units[k] != told.units[k])
        tell(now, i, "sensor-switched",
             fmt::format("{}: flies by number {}", name_of(sensor), status.units[k] + 1));
    }
  }

  // Sends what agents wrote, in entity order, and hands out what has arrived.
  void exchange(Time now) {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      AgentOutput& output = states_[i].output;
      for (Message& message : output.outbox) {
        message.from = id_of(i);
        message.number = states_[i].sent++;
        message.sent = now;
        if (const auto* reading = std::get_if<FireReading>(&message.content))
          recorder_.reading(*reading);
        if (states_[i].link_down)
          recorder_.message(message, now, true);
        else
          world_.radio->send(message);
      }
      for (const Event& event : output.events) note(event);
      for (const Crossing& crossing : output.crossings) recorder_.crossing(crossing);
      for (const ZoneChange& change : output.zone_changes) recorder_.zone(now, change);
      output.outbox.clear();
      output.events.clear();
      output.crossings.clear();
      output.zone_changes.clear();
    }
    arrived_.clear();
    lost_.clear();
    world_.radio->deliver(now, arrived_, lost_);
    for (const Message& message : arrived_) {
      const bool known = message.to.value < states_.size();
      const bool deaf = known && states_[message.to.value].link_down;
      recorder_.message(message, now, deaf);
      if (known && !deaf && states_[message.to.value].active) receive(now, message);
    }
    for (const Message& message : lost_) recorder_.message(message, now, true);
  }

  void receive(Time now, const Message& message) {
    Entity& receiver = world_.entities[message.to.value];
    if (receiver.vehicle && !world_.entities[message.from.value].vehicle)
      receiver.vehicle->autopilot->sense(LinkSample{now});  // the ground is heard
    states_[message.to.value].inbox.push_back(message);
  }

  void record(Time now) {
    if (due(now, options_.record_period))
      for (std::size_t i = 0; i < states_.size(); ++i)
        if (states_[i].active && world_.entities[i].vehicle) {
          recorder_.truth(now, id_of(i), world_.entities[i].vehicle->state);
          const Autopilot& autopilot = *world_.entities[i].vehicle->autopilot;
          recorder_.estimate(id_of(i), autopilot.estimate(), autopilot.status());
        }
    if (due(now, options_.perimeter_period))
      for (std::size_t i = 0; i < states_.size(); ++i)
        if (const BoundaryEstimate* belief = world_.entities[i].agent->perimeter())
          recorder_.perimeter(now, world_.fire->region(), id_of(i), *belief);
  }

  // What ends an aircraft, but not the run.
  void note_accidents(Time now) {
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const Entity& entity = world_.entities[i];
      if (!states_[i].active || !entity.vehicle) continue;
      if (states_[i].accident == EntityState::Accident::kNone) continue;
      states_[i].ended = true;
      tell(now, i, "accident",
           states_[i].accident == EntityState::Accident::kGround
               ? fmt::format("{} hit the ground", entity.name)
               : fmt::format("the motion of {} is no longer finite; before it was {}",
                             entity.name, text_of(states_[i].before)));
    }
  }

  // What has been told of an autopilot, besides its status.
  struct Watched {
    bool on_ground = false;
    Refusals refusals;
  };

  World& world_;
  const RunOptions& options_;
  Recorder& recorder_;
  oneapi::tbb::task_arena arena_;
  std::vector<EntityState> states_;
  std::vector<WorkingSet> working_sets_;
  std::vector<Watched> watched_;
  std::vector<Message> arrived_, lost_;
};

// The most certain thing to say about a run in one line: how well the fire is known.
std::string headline(const World& world) {
  for (const Entity& entity : world.entities)
    if (const BoundaryEstimate* belief = entity.agent->perimeter()) {
      double sum = 0;
      int count = 0;
      for (const auto& ring : belief->rings)
        for (const BoundaryPoint& point : ring) {
          sum += point.sigma * point.sigma;
          ++count;
        }
      if (count > 0) return fmt::format("sigma {:.1f} m", std::sqrt(sum / count));
    }
  return {};
}

// What ended the run at `now`, and when that was.
Error failed_at(Time now, Error error) {
  while (!error.message.empty() && error.message.back() == '.') error.message.pop_back();
  error.message += fmt::format(" (at {:.3f} s of simulated time).", now.seconds());
  return error;
}

// One step; whatever it throws ends the run, not the program: others may be going on.
Result<void> guarded_step(Stepper& stepper, Time now,
                          const std::vector<ZoneChange>& wishes) {
  try {
    return stepper.step(now, wishes);
  } catch (const Bug& bug) {
    return Error{ErrorCode::kUnavailable, "", bug.what(),
                 "This is a fault in Skein, please report it."};
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kUnavailable, "", "not enough memory",
                 "Use a coarser grid or fewer members, or run fewer at a time."};
  } catch (const std::exception& fault) {
    return Error{ErrorCode::kUnavailable, "", fault.what(), ""};
  }
}

}  // namespace

Result<RunOutcome> run(World& world, const RunOptions& options, Recorder& recorder,
                       OperatorConsole& console) {
  Stepper stepper(world, options, recorder);
  Pace pace(options.speed, options.step);
  RunOutcome outcome;
  stepper.introduce();
  Time now;
  for (; now <= options.duration; now += options.step) {
    pace.wait_for(now, console);
    if (console.stop_requested()) {
      outcome.end = RunOutcome::End::kStopped;
      break;
    }
    if (auto stepped = guarded_step(stepper, now, console.zone_wishes()); !stepped)
      return failed_at(now, stepped.error());
    if (pace.show_due())
      console.show(
          {now, options.duration, now.seconds() / pace.wall_s(), headline(world)});
  }
  outcome.simulated = std::min(now, options.duration);
  outcome.wall_s = pace.wall_s();
  outcome.deadline_misses = pace.misses();
  console.show({outcome.simulated, options.duration,
                outcome.simulated.seconds() / outcome.wall_s, headline(world)});
  return outcome;
}

}  // namespace skein::simulation
