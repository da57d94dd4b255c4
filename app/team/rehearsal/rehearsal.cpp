// SPDX-License-Identifier: Apache-2.0
#include "app/team/rehearsal/rehearsal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/team/rehearsal/expected_teams.h"
#include "skein/layer/reasoning/team/protocol/fingerprint.h"

namespace skein::rehearsal {
namespace {

using What = TeamScriptEvent::What;

std::string text_of(const std::vector<TeamGroup>& groups) {
  std::string text;
  for (const TeamGroup& group : groups) {
    text += fmt::format("{}{} led by {}:", text.empty() ? "" : "; ", group.mission,
                        group.master.value);
    for (const EntityId id : group.members) text += fmt::format(" {}", id.value);
  }
  return text;
}

class Rehearsal {
 public:
  Rehearsal(const TeamScript& script, const TeamRehearsalOptions& options)
      : script_(script),
        options_(options),
        network_(options.medium, options.seed, reasoning::short_fingerprint(script.id)),
        invariants_(2 * (options.medium.delay + options.medium.jitter)),
        expected_(expected_teams(script)),
        settled_at_(expected_.size(), 0) {}

  TeamRehearsalResult run(const std::function<void(const TeamRow&)>& row) {
    const auto steps = std::llround(script_.end / options_.step);
    std::vector<TeamTask> tasks(script_.tasks);
    for (std::size_t k = 0; k < tasks.size(); ++k)
      tasks[k].number = static_cast<std::uint32_t>(k + 1);
    for (const EntityId id : script_.aircraft) add(id).submit("M", tasks, Time());
    const std::int64_t every = std::llround(1 / options_.step);
    for (std::int64_t k = 0; k <= steps; ++k) {
      now_ = static_cast<double>(k) * options_.step;
      begin_events();
      step_members();
      invariants_.look(members_, network_, now_);
      look_at_teams();
      if (row && k % every == 0)
        for (const auto& [id, member] : members_) row({now_, id, member.status()});
    }
    return finish();
  }

 private:
  reasoning::TeamMember& add(EntityId id) {
    reasoning::TeamConfig config;
    config.seed = options_.seed;
    network_.join(id);
    return members_.try_emplace(id, id, config).first->second;
  }

  void begin_events() {
    while (next_event_ < script_.events.size() &&
           script_.events[next_event_].time <= now_ + 1e-9) {
      const TeamScriptEvent& event = script_.events[next_event_++];
      if (event.what == What::kCrash) {
        members_.erase(event.aircraft);
        network_.leave(event.aircraft);
      } else if (event.what == What::kJoin) {
        add(event.aircraft);
      } else if (event.what == What::kPartition) {
        network_.partition(event.parts);
      } else {
        network_.heal();
      }
      if (event.what != What::kCrash) invariants_.contacts_changed();
    }
  }

  void step_members() {
    const Time time = Time::from_seconds(now_);
    std::vector<std::pair<EntityId, std::vector<reasoning::TeamOutgoing>>> sent;
    for (auto& [id, member] : members_) {
      const auto received = network_.receive(id, now_);
      result_.events += received.size();
      reasoning::TeamStep step = member.step(time, received);
      for (const Event& event : step.events)
        ++result_.reports[std::string(event.kind.name())];
      if (!step.send.empty()) sent.emplace_back(id, std::move(step.send));
    }
    for (const auto& [id, messages] : sent) network_.send(id, messages, now_);
  }

  // The teams as their members see them; not all of one mind: there are more groups than
  // members that lead.
  std::vector<TeamGroup> teams() const {
    std::set<TeamGroup> groups;
    for (const auto& [id, member] : members_) {
      const TeamStatus& status = member.status();
      TeamGroup group{status.master.value_or(EntityId{UINT32_MAX}), status.members,
                      status.mission ? name_of(*status.mission) : ""};
      groups.insert(std::move(group));
    }
    return {groups.begin(), groups.end()};
  }

  // Whether each group's members all follow, and each has a task where there are enough.
  bool have_tasks(const std::vector<TeamGroup>& groups) const {
    for (const TeamGroup& group : groups) {
      const auto master = members_.find(group.master);
      if (master == members_.end()) return false;
      std::size_t busy = 0, tasks = 0;
      for (const EntityId id : group.members)
        busy += members_.at(id).tasks().empty() ? 0 : 1;
      for (const auto& [number, task] : master->second.knowledge().tasks) {
        const auto& branch = master->second.status().mission->branch;
        tasks += !branch || !task.branch || branch == task.branch ? 1 : 0;
      }
      if (busy < std::min(tasks, group.members.size())) return false;
      if (!master->second.orders_acknowledged()) return false;
    }
    return true;
  }

  void look_at_teams() {
    const std::size_t current = next_event_;
    const auto groups = teams();
    const bool good = groups == expected_[current].groups;
    if (!good) settled_at_[current] = now_ + options_.step;
    for (; next_expectation_ < script_.expect.size() &&
           script_.expect[next_expectation_].time <= now_ + 1e-9;
         ++next_expectation_)
      check(script_.expect[next_expectation_].groups, groups, false);
    const double since = now_ - expected_[current].time;
    if (since + 1e-9 >= options_.settled && checked_ <= current) {
      checked_ = current + 1;
      check(expected_[current].groups, groups, true);
    }
  }

  void check(const std::vector<TeamGroup>& expected, const std::vector<TeamGroup>& groups,
             bool with_tasks) {
    ++result_.expectations;
    const bool good = groups == expected;
    if (good && (!with_tasks || have_tasks(groups))) {
      ++result_.met;
    } else if (result_.first_missed.empty()) {
      result_.first_missed = fmt::format(
          "{} at {:.0f} s: expected {}, found {}{}", script_.id, now_, text_of(expected),
          text_of(groups), good ? ", but some have no task or order" : "");
    }
  }

  TeamRehearsalResult finish() {
    for (std::size_t k = 0; k < expected_.size(); ++k)
      if (expected_[k].time < script_.end)
        result_.settling.push_back(std::max(0.0, settled_at_[k] - expected_[k].time));
    result_.violations = invariants_.violations();
    if (result_.violations > 0)
      result_.first_violation = script_.id + " at " + invariants_.first_violation();
    result_.longest_double = invariants_.longest_double();
    result_.longest_unattended = invariants_.longest_unattended();
    result_.messages = network_.messages();
    result_.bytes = network_.bytes();
    return result_;
  }

  const TeamScript& script_;
  TeamRehearsalOptions options_;
  TeamNetwork network_;
  TeamInvariants invariants_;
  std::vector<TeamExpectation> expected_;
  std::vector<double> settled_at_;  // for each of expected_
  std::map<EntityId, reasoning::TeamMember> members_;
  double now_ = 0;
  std::size_t next_event_ = 0, next_expectation_ = 0, checked_ = 0;
  TeamRehearsalResult result_;
};

}  // namespace

TeamRehearsalResult rehearse(const TeamScript& script,
                             const TeamRehearsalOptions& options,
                             const std::function<void(const TeamRow&)>& row) {
  return Rehearsal(script, options).run(row);
}

std::string team_rows_header() {
  return "id,t_s,aircraft,master,mission,members\n";
}

std::string team_row_csv(const std::string& script, const TeamRow& row) {
  std::string members;
  for (const EntityId id : row.status.members)
    members += fmt::format("{}{}", members.empty() ? "" : " ", id.value);
  return fmt::format("{},{:g},{},{},{},{}\n", script, row.time, row.aircraft.value,
                     row.status.master ? fmt::format("{}", row.status.master->value) : "",
                     row.status.mission ? name_of(*row.status.mission) : "", members);
}

}  // namespace skein::rehearsal
