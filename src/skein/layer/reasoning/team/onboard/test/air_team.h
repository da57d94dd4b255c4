// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "skein/base/random.h"
#include "skein/layer/reasoning/team/onboard/onboard_team.h"
#include "skein/layer/reasoning/team/onboard/team_server.h"

namespace skein::reasoning {

/// A station (id 0) and aircraft on one radio, stepped twice a second. Aircraft do not
/// move; a task takes `task_time` of each.
struct AirTeam {
  struct Aircraft {
    std::unique_ptr<OnboardTeam> team;
    NavEstimate nav;
    TeamWork work;
    double begun = 0;
    std::vector<Message> inbox;
  };

  TeamConfig config;
  TaskSharing sharing = TaskSharing::kCoalitions;
  double loss = 0, task_time = 40;
  bool station_receives = true;
  std::set<std::uint32_t> impossible;    ///< tasks that nobody can fly
  std::set<std::uint32_t> out_of_reach;  ///< aircraft that the station does not hear
  std::unique_ptr<TeamServer> desk;
  std::map<EntityId, Aircraft> aircraft;
  std::vector<Event> events;
  std::map<EntityId, TeamLead> leads;
  std::vector<TeamAllocationReport> allocations;
  std::map<std::uint32_t, std::vector<std::string>> states;  ///< of tasks, one by one
  std::vector<Message> to_station;
  std::map<std::uint32_t, int> executed;  // how often each task was done
  std::map<std::string, int> said;        // how many messages of each kind
  RandomStream random{7, 0, Purpose::kTeam};
  double now = 0;

  explicit AirTeam(TeamStructure structure = TeamStructure::kMaster,
                   bool approval = false) {
    config.structure = structure;
    config.approval = approval;
    config.times.radio_range = 0;
    config.times.mission_diameter = 0;
    if (structure == TeamStructure::kMaster) config.operators = {EntityId{0}};
    if (structure == TeamStructure::kFixedMaster) config.fixed_leader = EntityId{0};
    restart();
  }
  /// The station begins anew.
  void restart() {
    desk = std::make_unique<TeamServer>(TeamServerOptions{EntityId{0}, config, sharing});
  }

  void add(std::uint32_t id, const Vec2& place, std::uint32_t sensors = 0) {
    OnboardTeamOptions options;
    options.config = config;
    options.sensors = sensors;
    options.sharing = sharing;
    Aircraft& made = aircraft[EntityId{id}];
    made.team = std::make_unique<OnboardTeam>(EntityId{id}, options);
    made.nav.p_N = {place.x(), place.y(), -100};
  }

  bool arrives() { return random.uniform() >= loss; }
  void deliver(const Message& message) {
    if (const auto* team = std::get_if<TeamMessage>(&message.content))
      ++said[std::string(kind_of(team->content))];
    const auto give = [&](EntityId to, std::vector<Message>& inbox) {
      if (to == message.from || (message.to != kEveryone && message.to != to)) return;
      if (arrives()) inbox.push_back(message);
    };
    const auto reaches = [&](EntityId id) {
      return station_receives && !out_of_reach.contains(id.value);
    };
    if (reaches(message.from)) give(EntityId{0}, to_station);
    for (auto& [id, one] : aircraft)
      if (message.from != EntityId{0} || reaches(id)) give(id, one.inbox);
  }

  // What an aircraft does with the task that it has.
  void work(Aircraft& one) {
    const TeamTask* task = one.team->task();
    const auto number = task ? std::optional(task->number) : std::nullopt;
    if (number != one.work.task) {
      one.work.task = number;
      one.work.state = number && impossible.contains(*number) ? TaskState::kImpossible
                                                              : TaskState::kFlying;
      one.begun = now;
    }
    if (!number) return;
    one.work.share = std::min(1.0, (now - one.begun) / task_time);
    if (one.work.share >= 1 && one.work.state == TaskState::kFlying) {
      one.work.state = TaskState::kDone;
      ++executed[*number];
    }
  }

  void run(double duration) {
    for (const double end = now + duration; now < end - 1e-9;) {
      now += 0.5;
      std::vector<Message> sent;
      const auto take = [&](EntityId id, AgentOutput& out) {
        for (Message& message : out.outbox) {
          message.from = id;
          sent.push_back(std::move(message));
        }
        for (const AgentRecord& record : out.records) {
          if (const auto* lead = std::get_if<TeamLead>(&record)) leads[id] = *lead;
          if (const auto* report = std::get_if<TeamAllocationReport>(&record))
            allocations.push_back(*report);
          if (const auto* task = std::get_if<TeamTaskReport>(&record))
            states[task->number].emplace_back(name_of(task->state));
        }
        events.insert(events.end(), out.events.begin(), out.events.end());
      };
      AgentInput in;
      in.now = Time::from_seconds(now);
      const std::vector<Message> heard = std::exchange(to_station, {});
      in.inbox = heard;
      AgentOutput of_station;
      desk->step(in, of_station);
      take(EntityId{0}, of_station);
      for (auto& [id, one] : aircraft) {
        const std::vector<Message> inbox = std::exchange(one.inbox, {});
        in.inbox = inbox;
        in.nav = &one.nav;
        AgentOutput out;
        one.team->step(in, one.work, out);
        work(one);
        take(id, out);
      }
      for (const Message& message : sent) deliver(message);
    }
  }

  /// Who leads each aircraft; 1000: nobody.
  std::set<std::uint32_t> masters() const {
    std::set<std::uint32_t> all;
    for (const auto& [id, one] : aircraft)
      all.insert(one.team->member().status().master.value_or(EntityId{1000}).value);
    return all;
  }
  std::multiset<std::uint32_t> flown() const {
    std::multiset<std::uint32_t> all;
    for (const auto& [id, one] : aircraft)
      if (one.team->task()) all.insert(one.team->task()->number);
    return all;
  }
  /// What the operator says of a proposal; 0: of the one that waits.
  /// @returns  why that cannot be.
  std::string decide(AllocationAction action, std::uint32_t number = 0) {
    return desk->decide({action, number}, Time::from_seconds(now));
  }
  int count(EventKind kind) const {
    return static_cast<int>(std::ranges::count(events, kind, &Event::kind));
  }
  /// What became of the proposal of a number, the last of it.
  std::string state_of(std::uint32_t number) const {
    std::string state = "unknown";
    for (const TeamAllocationReport& each : allocations)
      if (each.number == number) state = name_of(each.state);
    return state;
  }
  std::string story() const {
    std::string all;
    for (const Event& event : events)
      all += std::to_string(event.time.seconds()) + " " +
             std::to_string(event.entity.value) + " " + std::string(event.kind.name()) +
             " " + event.text + "\n";
    return all;
  }
};

}  // namespace skein::reasoning
