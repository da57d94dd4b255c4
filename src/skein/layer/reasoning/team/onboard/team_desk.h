#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "skein/data/command.h"
#include "skein/layer/reasoning/team/onboard/team_link.h"

namespace skein::reasoning {

/// A task that an operator wants the team to do.
struct WantedTask {
  TaskKind what = Hold{};
  std::uint32_t sensors = 0;  ///< TeamSensors that it takes besides those of its kind
  bool group = false;         ///< several may fly it at once
};

/// The part of a ground station that hands tasks to a team which leads itself, and sees
/// who leads it and what is done. It flies nothing. Whatever missions a station hands to
/// its team, it has one desk, and their tasks are those of one mission of the team.
class TeamDesk {
 public:
  /// @param in_wind  as a master that never hands over it shares tasks by what they need
  ///                 in the wind that its aircraft report.
  TeamDesk(EntityId self, TeamConfig config, bool in_wind, const Vec3& place);
  TeamDesk(const TeamDesk&) = delete;
  TeamDesk& operator=(const TeamDesk&) = delete;

  /// Adds tasks of a mission.
  /// @returns  their numbers among all of the team's.
  std::vector<std::uint32_t> hand_in(const std::string& mission,
                                     std::span<const WantedTask> tasks, Time now);

  /// Once for each time, whoever asks for it.
  void step(const AgentInput& in, AgentOutput& out);

  /// The operator approves an allocation that the team proposes, or not.
  /// @returns  why that cannot be; empty: the leader is told.
  std::string decide(const AllocationCommand& command, Time now);

  /// As far as the station has heard.
  bool is_done(std::uint32_t task) const;

 private:
  void learn_wind(const AgentInput& in);

  Vec2 wind_ = Vec2::Zero();  // as last reported [m/s]
  TeamLink link_;
  std::string mission_;  // of the team: the first that was handed in
  std::uint32_t last_ = 0;
  Time stepped_ = Time::from_ns(-1);
};

}  // namespace skein::reasoning
