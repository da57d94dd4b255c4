// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/team_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "skein/layer/reasoning/team/onboard/packed_task.h"
#include "skein/layer/reasoning/team/onboard/task_needs.h"

namespace skein::reasoning {
namespace {

constexpr double kLookAgain = 1;  // at what has become of tasks, after [s]

TeamTaskState state_of(const TeamTask& task, const std::map<std::uint32_t, TeamTask>& all,
                       bool is_flown) {
  if (task.withdrawn) return TeamTaskState::kWithdrawn;
  if (task.done) return TeamTaskState::kDone;
  if (is_flown) return TeamTaskState::kFlown;
  const bool waits = std::ranges::any_of(task.after, [&](std::uint32_t before) {
    const auto known = all.find(before);
    return known == all.end() || !known->second.done;
  });
  return waits ? TeamTaskState::kWaits : TeamTaskState::kOpen;
}

std::string words_of(const TeamTask& task) {
  std::string text = fmt::format("{}: {}", task.number, name_of_kind(task));
  for (const std::uint32_t number : task.after)
    text += fmt::format("{} {}", number == task.after.front() ? " after" : ",", number);
  return text;
}

}  // namespace

TeamServer::TeamServer(TeamServerOptions options)
    : self_(options.self),
      zones_(options.zones),
      link_(options.self,
            with_sharing(std::move(options.config), options.sharing, conditions_)) {
  TeamResources resources;
  resources.place = options.place;
  resources.able = false;
  link_.member().set_resources(resources);
}

std::vector<std::uint32_t> TeamServer::hand_in(const std::string& mission,
                                               std::span<const WantedTask> tasks,
                                               Time now) {
  open(mission);
  std::vector<std::uint32_t> numbers;
  std::vector<TeamTask> all;
  for (const WantedTask& wanted : tasks) {
    numbers.push_back(++last_);
    asked_[last_] = wanted.sensors;
    all.push_back(team_task(last_, wanted.what, wanted.sensors, wanted.group,
                            present(wanted.after)));
  }
  link_.member().hand_in(mission_, all, now);
  return numbers;
}

void TeamServer::open(const std::string& mission) {
  if (mission_.empty()) mission_ = mission;
}

void TeamServer::step(const AgentInput& in, AgentOutput& out) {
  if (in.now == stepped_) return;
  stepped_ = in.now;
  learn(in);
  link_.step(in, out);
  if (looked_ && in.now - *looked_ < Time::from_seconds(kLookAgain)) return;
  looked_ = in.now;
  record_tasks(out);
}

void TeamServer::record_tasks(AgentOutput& out) {
  const auto tasks = link_.member().all_tasks();
  const auto executors = link_.member().executors();
  for (const auto& [number, task] : tasks) {
    const auto executor = executors.find(number);
    const bool is_flown = executor != executors.end() && !task.done;
    const TeamTaskState state = state_of(task, tasks, is_flown);
    const auto flown_by = is_flown ? std::optional(executor->second) : std::nullopt;
    const auto [known, is_new] = recorded_.try_emplace(number);
    TeamTaskReport& report = known->second;
    if (!is_new && report.state == state && report.executor == flown_by) continue;
    if (is_new)
      report = {mission_,   number,     name_of_kind(task),
                task.place, task.after, !task.single};
    report.state = state;
    report.executor = flown_by;
    out.records.emplace_back(report);
  }
}

void TeamServer::learn(const AgentInput& in) {
  bool is_new = false;
  for (const Message& message : in.inbox) {
    if (const auto* report = std::get_if<AircraftReport>(&message.content)) {
      conditions_.set_wind(report->nav.wind_N);
      altitude_msl_ = -report->nav.p_N.z();
      is_new = true;
    } else if (const auto* change = std::get_if<ZoneChange>(&message.content)) {
      is_new |= zones_.take(*change);
    }
  }
  if (is_new) conditions_.set_zones(zones_.zones(), altitude_msl_, in.now.seconds());
}

std::string TeamServer::decide(const AllocationCommand& command, Time now) {
  if (stepped_ != now) return "no mission of the team is going on.";
  return link_.member().decide(command.number,
                               command.action == AllocationAction::kApprove);
}

std::string TeamServer::obey(const TeamTaskCommand& command, const TaskKind& what,
                             AgentOutput& out, Time now) {
  if (stepped_ != now) return "no mission of the team is going on.";
  const auto known = link_.member().all_tasks();
  for (const std::uint32_t number : command.after)
    if (!known.contains(number)) return fmt::format("there is no task {}.", number);
  if (command.action == TeamTaskAction::kAdd) {
    add(team_task(0, what, 0, command.group, present(command.after)), out, now);
    return "";
  }
  const auto found = known.find(command.number);
  if (found == known.end()) return fmt::format("there is no task {}.", command.number);
  if (found->second.done) return fmt::format("task {} is over.", command.number);
  if (command.action == TeamTaskAction::kWithdraw)
    withdraw(command.number, out, now);
  else
    replace(found->second, what, out, now);
  return "";
}

std::uint32_t TeamServer::add(TeamTask task, AgentOutput& out, Time now) {
  task.number = ++last_;
  added_.push_back(last_);
  out.events.push_back({now,
                        self_,
                        EventKind::kTeamTaskAdded,
                        words_of(task),
                        {.team_task = task.number}});
  link_.member().hand_in(mission_, {&task, 1}, now);
  return last_;
}

void TeamServer::withdraw(std::uint32_t task, AgentOutput& out, Time now) {
  const TeamTask known = link_.member().all_tasks().at(task);
  if (link_.member().withdraw_task(task))
    out.events.push_back({now,
                          self_,
                          EventKind::kTeamTaskWithdrawn,
                          words_of(known),
                          {.team_task = known.number}});
}

// What waits for it, and what waits for that, is replaced too: what a task comes after
// does not change. Tasks come after such with lower numbers.
void TeamServer::replace(const TeamTask& task, const TaskKind& what, AgentOutput& out,
                         Time now) {
  std::vector<std::uint32_t> old = {task.number};
  TeamTask by = team_task(0, what, asked_[task.number], !task.single, task.after);
  by.branch = task.branch;
  note_replaced(task.number, add(std::move(by), out, now));
  for (auto& [number, known] : link_.member().all_tasks()) {
    const bool waits = std::ranges::any_of(known.after, [&](std::uint32_t before) {
      return std::ranges::find(old, before) != old.end();
    });
    if (known.done || !waits) continue;
    TeamTask again = known;
    again.after = present(known.after);
    again.released = false;
    note_replaced(number, add(std::move(again), out, now));
    old.push_back(number);
  }
  for (const std::uint32_t number : old) withdraw(number, out, now);
}

void TeamServer::note_replaced(std::uint32_t task, std::uint32_t by) {
  replaced_[task] = by;
  asked_[by] = asked_[task];
}

std::uint32_t TeamServer::present(std::uint32_t task) const {
  for (auto by = replaced_.find(task); by != replaced_.end(); by = replaced_.find(task))
    task = by->second;
  return task;
}

std::vector<std::uint32_t> TeamServer::present(std::vector<std::uint32_t> tasks) const {
  for (std::uint32_t& task : tasks) task = present(task);
  return tasks;
}

bool TeamServer::is_all_added_done() const {
  return std::ranges::all_of(added_, [this](auto task) { return is_done(task); });
}

bool TeamServer::is_done(std::uint32_t task) const {
  const auto& known = link_.member().knowledge().tasks;
  const auto found = known.find(present(task));
  return found != known.end() && found->second.done;
}

}  // namespace skein::reasoning
