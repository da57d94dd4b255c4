// SPDX-License-Identifier: Apache-2.0
// What a run does on a command.

#include <fmt/format.h>

#include <algorithm>

#include "skein/simulation/commanded_wind.h"
#include "skein/simulation/stepper.h"

namespace skein::simulation {

Result<void> Stepper::command(Time now, std::string sender, const Command& command) {
  recorder_.record(CommandRecord{now, std::move(sender), command});
  refusal_.reset();
  obey(now, command);
  if (!refusal_) return {};
  return Error{ErrorCode::kBadInput, std::string(kind_of(command)), *refusal_, ""};
}

std::optional<std::size_t> Stepper::find(const std::string& aircraft) const {
  for (std::size_t i = 0; i < world_.entities.size(); ++i)
    if (world_.entities[i].vehicle && world_.entities[i].name == aircraft) return i;
  return std::nullopt;
}

bool Stepper::is_station(const std::string& name) const {
  return std::ranges::any_of(world_.entities, [&](const Entity& entity) {
    return !entity.vehicle && entity.name == name;
  });
}

void Stepper::refuse(Time now, const std::string& why) {
  refusal_ = why;
  records_.event({now, EntityId{}, EventKind::kCommandRefused, why});
}

void Stepper::obey(Time now, const Command& command) {
  // To the ground stations, where the operator is: those that take part, or will in the
  // step that begins.
  const auto pass_on = [&] {
    for (std::size_t i = 0; i < states_.size(); ++i)
      if (!world_.entities[i].vehicle && will_take_part(i, now))
        states_[i].commands.push_back(command);
  };
  const auto with = [&](const std::string& aircraft, const auto& act) {
    if (const auto i = find(aircraft))
      act(*i);
    else
      refuse(now, fmt::format("there is no aircraft \"{}\".", aircraft));
  };
  struct Visitor {
    Stepper& run;
    Time now;
    const decltype(pass_on)& pass_on_to_stations;
    const decltype(with)& with_aircraft;
    void operator()(const ZoneChange&) const { pass_on_to_stations(); }
    void operator()(const TaskCommand& c) const {
      with_aircraft(c.aircraft, [&](std::size_t) { pass_on_to_stations(); });
    }
    void operator()(const TaskChangeCommand& c) const {
      with_aircraft(c.aircraft, [&](std::size_t) {
        if (!c.to.empty() && !run.find(c.to))
          return run.refuse(now, fmt::format("there is no aircraft \"{}\".", c.to));
        pass_on_to_stations();
      });
    }
    void operator()(const FlightChangeCommand& c) const {
      with_aircraft(c.aircraft, [&](std::size_t) { pass_on_to_stations(); });
    }
    void operator()(const MissionCommand&) const { pass_on_to_stations(); }
    void operator()(const AllocationCommand& c) const {
      if (!c.station.empty() && !run.is_station(c.station))
        return run.refuse(now, fmt::format("there is no station \"{}\".", c.station));
      pass_on_to_stations();
    }
    void operator()(const TeamTaskCommand& c) const {
      if (!c.station.empty() && !run.is_station(c.station))
        return run.refuse(now, fmt::format("there is no station \"{}\".", c.station));
      pass_on_to_stations();
    }
    // The clock is of whoever steps.
    void operator()(const PauseCommand&) const {}
    void operator()(const StepCommand&) const {}
    void operator()(const SpeedCommand& c) const {
      if (run.options_.real_time_only && c.factor != 1)
        run.refuse(now,
                   "aircraft that are not simulated fly in real time: no other speed can "
                   "be had.");
    }
    void operator()(const FaultCommand& c) const {
      with_aircraft(c.aircraft, [&](std::size_t i) {
        Vehicle& vehicle = *run.world_.entities[i].vehicle;
        if (auto done = vehicle.set_fault(c.part, c.fails, now); !done)
          run.refuse(now, done.error().text());
      });
    }
    void operator()(const HandBackCommand& c) const {
      with_aircraft(c.aircraft, [&](std::size_t i) {
        if (!run.states_[i].active)
          return run.refuse(now, fmt::format("{} takes no part.", c.aircraft));
        if (auto done = run.world_.entities[i].vehicle->hand_back(now); !done)
          run.refuse(now, fmt::format("{}: {}", c.aircraft, done.error().text()));
      });
    }
    void operator()(const RefusedCommand& c) const {
      if (const auto i = run.find(c.aircraft))
        return run.records_.event(now, *i, EventKind::kCommandRefused, c.text);
      run.records_.event({now, EntityId{}, EventKind::kCommandRefused, c.text});
    }
    void operator()(const WindCommand& c) const {
      run.world_.wind->set_added({c.added.x(), c.added.y(), 0});
    }
    // Sticks go to the autopilot, everything else to the agent on board.
    void operator()(const VehicleCommand& c) const {
      with_aircraft(c.aircraft, [&](std::size_t i) {
        if (const auto* pilot = std::get_if<PilotRequest>(&c.request)) {
          PilotInput sticks = pilot->input;
          sticks.time = now;
          run.world_.entities[i].vehicle->pilot(sticks);
        } else if (run.states_[i].active) {
          run.states_[i].commands.emplace_back(c);
        }
      });
    }
    void operator()(const AddCommand& c) const {
      with_aircraft(c.aircraft,
                    [&](std::size_t i) { run.states_[i].commanded_active = true; });
    }
    void operator()(const RemoveCommand& c) const {
      with_aircraft(c.aircraft,
                    [&](std::size_t i) { run.states_[i].commanded_active = false; });
    }
  };
  std::visit(Visitor{*this, now, pass_on, with}, command);
}

}  // namespace skein::simulation
