// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "skein/layer/reasoning/team/onboard/task_sharing.h"
#include "skein/layer/reasoning/team/onboard/team_link.h"

namespace skein::reasoning {

struct OnboardTeamOptions {
  TeamConfig config;
  TaskSharing sharing = TaskSharing::kCoalitions;
  double cruise = 15;         ///< airspeed of the aircraft [m/s]
  std::uint32_t sensors = 0;  ///< TeamSensors on board
};

/// What an aircraft makes of what its team gives it.
struct TeamWork {
  bool free = true;     ///< neither a pilot nor a failsafe flies, nor an operator's order
  bool leaves = false;  ///< it flies no more: a failsafe brings it home
  std::span<const Zone> zones = {};        ///< in force
  std::optional<std::uint32_t> task = {};  ///< of the team, that it has
  TaskState state = TaskState::kNone;      ///< of that task
  double share = 0;                        ///< of it that is done
};

/// The part of an agent on board that is a member of a team which leads itself: says what
/// the aircraft is able to do and how far it is, and which of the team's tasks it flies:
/// of several one after the other. As a master it shares the tasks out.
///
/// Who finds that it cannot fly what it was given says so, and is not given it for a
/// minute, and each time for twice as long, so that another one gets it; who has it
/// cancelled by the operator is not able for a minute. Events: those of TeamLink, and
/// kTeamTask with the number and kind of what is flown from now on, kTeamTaskOver.
class OnboardTeam {
 public:
  OnboardTeam(EntityId self, OnboardTeamOptions options);
  OnboardTeam(const OnboardTeam&) = delete;
  OnboardTeam& operator=(const OnboardTeam&) = delete;

  /// At each step, with or without a navigation estimate.
  void step(const AgentInput& in, const TeamWork& work, AgentOutput& out);

  /// What is to be flown; null: nothing of the team's.
  const TeamTask* task() const { return task_ ? &*task_ : nullptr; }
  const TeamMember& member() const { return link_.member(); }

 private:
  void say_resources(const AgentInput& in, const TeamWork& work);
  void learn(const AgentInput& in, const TeamWork& work);
  void note(const TeamWork& work, Time now);
  void refuse(std::uint32_t task, Time now);
  bool may_begin(std::uint32_t task) const;
  void take_task(Time now, AgentOutput& out);

  EntityId self_;
  OnboardTeamOptions options_;
  FlightConditions conditions_;  // as last believed
  std::optional<Time> learned_;  // when
  TeamLink link_;
  TeamResources resources_;
  std::optional<TeamTask> task_;
  std::set<std::uint32_t> flown_;  // of the team's, that it has done
  struct Refusal {
    Time until;
    int times = 0;
  };
  std::map<std::uint32_t, Refusal> refusals_;
  Time unable_until_;
};

}  // namespace skein::reasoning
