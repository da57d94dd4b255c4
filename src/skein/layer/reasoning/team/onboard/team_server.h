// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/data/airspace/zone_set.h"
#include "skein/data/command/command.h"
#include "skein/layer/reasoning/team/onboard/task_sharing.h"
#include "skein/layer/reasoning/team/onboard/team_link.h"

namespace skein::reasoning {

/// A task that an operator wants the team to do.
struct WantedTask {
  TaskKind what = Hold{};
  std::uint32_t sensors = 0;  ///< TeamSensors that it takes besides those of its kind
  bool group = false;         ///< several may fly it at once
  std::vector<std::uint32_t> after = {};  ///< numbers of tasks that are over before
};

struct TeamServerOptions {
  EntityId self;
  TeamConfig config;
  /// As a master that never hands over: by the wind that its aircraft report.
  TaskSharing sharing = TaskSharing::kCoalitions;
  Vec3 place = Vec3::Zero();     ///< of the station, N [m]
  std::vector<Zone> zones = {};  ///< in force from the start
};

/// The part of a ground station that hands tasks to a team which leads itself, and sees
/// who leads it and what is done. It flies nothing. Whatever missions a station hands to
/// its team, it has one desk, and their tasks are those of one mission of the team. It
/// records how far each is, when that has changed.
///
/// Events: "team-task-added" and "team-task-withdrawn" with the number and kind of a task
/// that the operator adds or does not want any more.
class TeamServer {
 public:
  explicit TeamServer(TeamServerOptions options);
  TeamServer(const TeamServer&) = delete;
  TeamServer& operator=(const TeamServer&) = delete;

  /// A mission has begun: the first one names that of the team.
  void open(const std::string& mission);

  /// Adds tasks of a mission.
  /// @returns  their numbers among all of the team's.
  std::vector<std::uint32_t> hand_in(const std::string& mission,
                                     std::span<const WantedTask> tasks, Time now);

  /// Once for each time, whoever asks for it.
  void step(const AgentInput& in, AgentOutput& out);

  /// The operator approves an allocation that the team proposes, or not.
  /// @returns  why that cannot be; empty: the leader is told.
  std::string decide(const AllocationCommand& command, Time now);

  /// The operator adds a task, withdraws one, or wants another one in its place. What
  /// waits for a task that is replaced waits for the other one.
  /// @param what  of the command, with numbers in place of names.
  /// @returns  why that cannot be; empty: the leader is told.
  std::string obey(const TeamTaskCommand& command, const TaskKind& what, AgentOutput& out,
                   Time now);

  /// As far as the station has heard; of one that was replaced the other one.
  bool is_done(std::uint32_t task) const;
  /// The same of all that the operator has added by command.
  bool is_all_added_done() const;

 private:
  void learn(const AgentInput& in);
  void record_tasks(AgentOutput& out);
  std::uint32_t add(TeamTask task, AgentOutput& out, Time now);
  void withdraw(std::uint32_t task, AgentOutput& out, Time now);
  void replace(const TeamTask& task, const TaskKind& what, AgentOutput& out, Time now);
  void note_replaced(std::uint32_t task, std::uint32_t by);
  std::uint32_t present(std::uint32_t task) const;  // what is in its place
  std::vector<std::uint32_t> present(std::vector<std::uint32_t> tasks) const;

  EntityId self_;
  FlightConditions conditions_;  // as last reported
  ZoneSet zones_;
  double altitude_msl_ = 0;  // of the aircraft that reported last [m]
  TeamLink link_;
  std::string mission_;  // of the team: the first that was handed in
  std::uint32_t last_ = 0;
  std::map<std::uint32_t, std::uint32_t> replaced_;  // by which
  std::map<std::uint32_t, std::uint32_t> asked_;     // sensors, besides those of its kind
  std::vector<std::uint32_t> added_;                 // by command
  std::map<std::uint32_t, TeamTaskReport> recorded_;
  std::optional<Time> looked_;  // when
  Time stepped_ = Time::from_ns(-1);
};

}  // namespace skein::reasoning
