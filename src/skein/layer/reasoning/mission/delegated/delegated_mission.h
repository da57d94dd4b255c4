// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/layer/reasoning/team/onboard/team_server.h"
#include "skein/role/mission.h"

namespace skein::reasoning {

/// A task of a mission that the team flies by itself.
struct DelegatedTask {
  WantedTask task;
  Time at;  ///< after the begin of the mission: when the operator adds it
  std::vector<std::size_t> after = {};  ///< those of the list that are over before it
};

/// A mission that the station hands to a team which leads itself. It asks for no
/// aircraft, and orders none: the team shares the tasks, with or without the station.
class DelegatedMission final : public Mission {
 public:
  /// @param name   of the mission.
  /// @param tasks  in the order in which they are added.
  /// @param desk   the station's, shared by its missions of this kind.
  DelegatedMission(std::string name, std::vector<DelegatedTask> tasks,
                   std::shared_ptr<TeamServer> desk);

  void step(const AgentInput& in, AgentOutput& out) override;
  MissionDemand demand() const override;
  /// Everything has been handed in, and the station has heard that all of it is done, and
  /// what the operator has added besides.
  bool done() const override;

 private:
  void hand_in(Time now);

  std::string name_;
  std::vector<DelegatedTask> tasks_;
  std::size_t handed_in_ = 0;
  std::shared_ptr<TeamServer> desk_;
  std::optional<Time> begun_;
  std::vector<std::uint32_t> numbers_;  // of those handed in
};

}  // namespace skein::reasoning
