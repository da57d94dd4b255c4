// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "skein/layer/reasoning/team/onboard/onboard_team.h"
#include "skein/layer/reasoning/team/onboard/team_server.h"
#include "skein/layer/reasoning/team/onboard/test/model_air.h"

namespace skein::reasoning {

/// Aircraft that fly the tasks of their team, and the station (id 0) that hands them in:
/// what is true, whatever the members believe.
class TeamWorld {
 public:
  static constexpr double kStep = 0.2;    // [s]
  static constexpr double kRefused = 60;  // a task that cannot be flown, at first [s]
  static constexpr double kSpeed = 15;    // [m/s]
  static constexpr EntityId kStation{0};

  /// What an entity has been told, or has seen itself.
  struct Informed {
    bool of_mission = false;
    std::set<std::uint32_t> tasks, done;
  };
  struct Aircraft {
    std::unique_ptr<OnboardTeam> team;
    NavEstimate nav;
    TeamWork work;
    std::uint32_t sensors = 0;
    std::map<std::uint32_t, std::pair<double, int>> refused;  ///< until, how often
    std::uint32_t sent = 0;  // messages since begin_quiet()
  };
  struct Wanted {
    Vec2 place = Vec2::Zero();
    double stay = 0;
    std::uint32_t sensors = 0;
    bool group = false;
    std::vector<std::uint32_t> after = {};  ///< tasks that are over before
  };

  TeamWorld(std::uint64_t seed, const TeamConfig& config, TaskSharing sharing)
      : air(seed), sharing_(sharing), config_(config) {
    config_.seed = seed;
    start_station();
  }

  ModelAir air;
  double now = 0;
  bool quiet = false;  ///< nobody moves, nothing is done
  std::map<EntityId, Aircraft> aircraft;
  std::map<EntityId, Informed> informed;
  std::map<std::uint32_t, Wanted> wanted;
  std::set<std::uint32_t> done;
  std::optional<EntityId> master_of_station;
  std::string team_of_station;
  std::map<std::pair<EntityId, EntityId>, int>
      encounters;  ///< of leaders, lower id first
  std::vector<Event> events;
  std::vector<std::string> faults;

  void start(EntityId id, std::uint32_t sensors, const Vec2& place, std::size_t group) {
    OnboardTeamOptions options;
    options.config = config_;
    options.sensors = sensors;
    options.cruise = kSpeed;
    options.sharing = sharing_;
    Aircraft& made = aircraft[id];
    made = {};
    made.team = std::make_unique<OnboardTeam>(id, options);
    made.sensors = sensors;
    made.nav.p_N = {place.x(), place.y(), -100};
    informed[id] = {};
    air.put(id, group);
  }
  void lose(EntityId id) {
    aircraft.erase(id);
    informed.erase(id);
    air.remove(id);
  }
  /// A pilot or the operator flies it, or not any more.
  void take(EntityId id, bool taken) {
    TeamWork& work = aircraft.at(id).work;
    work = {};
    work.free = !taken;
  }
  /// Whom the radio parts from whom, and joins with whom: leaders that meet are counted.
  void regroup(const std::map<EntityId, std::size_t>& groups) {
    std::vector<EntityId> leaders;
    for (const auto& [id, one] : aircraft)
      if (one.team->member().leads()) leaders.push_back(id);
    for (const EntityId a : leaders)
      for (const EntityId b : leaders)
        if (a < b && air.group_of(a) != air.group_of(b) && groups.at(a) == groups.at(b))
          ++encounters[{a, b}];
    for (const auto& [id, group] : groups) air.put(id, group);
  }
  void add_task(const Wanted& task) {
    const WantedTask said{Measure{task.place, task.stay}, task.sensors, task.group,
                          task.after};
    const auto numbers = desk_->hand_in("M", {&said, 1}, Time::from_seconds(now));
    wanted[numbers.front()] = task;
    informed[kStation].of_mission = true;
    informed[kStation].tasks.insert(numbers.front());
  }

  /// The operator does not want a task any more; needs the station.
  void withdraw(std::uint32_t task) {
    AgentOutput out;
    const TeamTaskCommand command{TeamTaskAction::kWithdraw, task};
    if (!desk_->obey(command, {}, out, last_).empty()) return;
    done.insert(task);
    informed[kStation].done.insert(task);
  }

  void step() {
    now += kStep;
    std::vector<Message> sent;
    if (air.has(kStation)) step_station(sent);
    for (auto& [id, one] : aircraft) step_aircraft(id, one, sent);
    for (const Message& message : sent) air.send(message, now);
  }

  std::optional<std::uint32_t> flown_by(EntityId id) const {
    const TeamTask* task = aircraft.at(id).team->task();
    return task ? std::optional(task->number) : std::nullopt;
  }
  bool is_able(EntityId id) const { return aircraft.at(id).work.free; }
  /// Nobody may be given again lately, nor soon [s], what it has refused.
  bool is_steady(double lately, double soon) const {
    return std::ranges::none_of(aircraft, [&](const auto& one) {
      return std::ranges::any_of(one.second.refused, [&](const auto& refused) {
        const double left = refused.second.first - now;
        return left > -lately && left < soon;
      });
    });
  }
  bool can_fly(EntityId id, std::uint32_t task) const {
    const Aircraft& one = aircraft.at(id);
    const auto refused = one.refused.find(task);
    return (wanted.at(task).sensors & ~one.sensors) == 0 &&
           (refused == one.refused.end() || now >= refused->second.first);
  }
  /// T_lost and the time for which an exchange stays open, the longest of all [s].
  std::pair<double, double> timers() const {
    constexpr double kUnknown = 16;
    double lost = 4, exchange = 0;
    for (const auto& [id, one] : aircraft) {
      const TeamMember& member = one.team->member();
      lost = std::max(lost, member.follower_lost_after());
      exchange =
          std::max(exchange, member.round_trip() > 0 ? member.round_trip() : kUnknown);
    }
    return {lost, lost + exchange};
  }

 private:
  void start_station() {
    desk_ = std::make_unique<TeamServer>(TeamServerOptions{kStation, config_, sharing_});
    informed[kStation] = {};
    air.put(kStation, 0);
  }

  void take_out(EntityId id, AgentOutput& out, std::vector<Message>& sent) {
    for (Message& message : out.outbox) {
      message.from = id;
      sent.push_back(std::move(message));
    }
    events.insert(events.end(), out.events.begin(), out.events.end());
  }

  void step_station(std::vector<Message>& sent) {
    const auto inbox = air.receive(kStation, now);
    // The operator approves whatever is proposed.
    if (config_.approval) desk_->decide({AllocationAction::kApprove, 0}, last_);
    last_ = Time::from_seconds(now);
    AgentInput in;
    in.now = Time::from_seconds(now);
    in.inbox = inbox;
    AgentOutput out;
    desk_->step(in, out);
    for (const AgentRecord& record : out.records)
      if (const auto* lead = std::get_if<TeamLead>(&record))
        master_of_station = lead->master, team_of_station = lead->team;
    take_out(kStation, out, sent);
  }

  void step_aircraft(EntityId id, Aircraft& one, std::vector<Message>& sent) {
    const auto inbox = air.receive(id, now);
    AgentInput in;
    in.now = Time::from_seconds(now);
    in.inbox = inbox;
    in.nav = &one.nav;
    AgentOutput out;
    if (one.work.state == TaskState::kDone) informed.at(id).done.insert(*one.work.task);
    one.team->step(in, one.work, out);
    one.sent += static_cast<std::uint32_t>(out.outbox.size());
    take_out(id, out, sent);
    if (one.work.state == TaskState::kImpossible) refuse(one);
    if (!one.work.free) return;
    if (const auto task = flown_by(id); task != one.work.task) begin(id, one, task);
    if (one.work.state == TaskState::kFlying && !quiet) fly(one);
  }

  void refuse(Aircraft& one) {
    auto& [until, times] = one.refused[*one.work.task];
    if (times > 0 && now < until) return;
    until = now + std::ldexp(kRefused, times);
    times = std::min(times + 1, 6);
  }

  void begin(EntityId id, Aircraft& one, std::optional<std::uint32_t> task) {
    one.work.task = task;
    one.work.state = task ? TaskState::kFlying : TaskState::kNone;
    one.work.share = 0;
    if (!task) return;
    for (const std::uint32_t before : wanted.at(*task).after)
      if (!done.contains(before))
        faults.push_back(std::to_string(id.value) + " begins task " +
                         std::to_string(*task) + " before " + std::to_string(before));
    if (informed.at(id).done.contains(*task))
      faults.push_back(std::to_string(id.value) + " begins task " +
                       std::to_string(*task) + " that it knows to be done");
  }

  void fly(Aircraft& one) {
    const Wanted& task = wanted.at(*one.work.task);
    const Vec2 leg = task.place - Vec2(one.nav.p_N.head<2>());
    const double left = leg.norm(), way = kSpeed * kStep;
    one.nav.p_N.head<2>() += left <= way ? leg : Vec2(leg * (way / left));
    if (left > way) return;
    one.work.share = std::min(1.0, one.work.share + kStep / task.stay);
    if (one.work.share < 1) return;
    one.work.state = TaskState::kDone;
    done.insert(*one.work.task);
  }

  TaskSharing sharing_;
  TeamConfig config_;
  Time last_;  // when the station was stepped
  std::unique_ptr<TeamServer> desk_;
};

}  // namespace skein::reasoning
