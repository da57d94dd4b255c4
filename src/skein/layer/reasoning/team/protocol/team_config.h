// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "skein/data/team/team_message.h"
#include "skein/layer/reasoning/team/protocol/allocation.h"
#include "skein/layer/reasoning/team/protocol/timers.h"

namespace skein::reasoning {

/// Who leads.
enum class TeamStructure : std::uint8_t {
  kMaster,       ///< one of them, selected by a rule; another one when it is lost
  kFixedMaster,  ///< always the same, such as a ground station
  kNone,         ///< each alone
  kAuction,      ///< nobody: tasks go to the highest bids
};
constexpr auto names_of(const TeamStructure*) {
  return std::array<std::string_view, 4>{"master", "fixed-master", "none", "auction"};
}

/// Who leads of those that hear each other; must be the same in every member, and not
/// depend on the order. `ids` are ascending, at least one.
using SelectLeader = std::function<EntityId(std::span<const EntityId> ids)>;
/// The default rule.
EntityId lowest_id(std::span<const EntityId> ids);

/// Whether a leader would take a newcomer.
using AdmitNewcomer =
    std::function<bool(const TeamResources& newcomer, std::span<const TeamTask> tasks,
                       std::span<const TeamWorker> workers)>;

/// What a task is worth to a member that already has some, in that order: for auctions;
/// 0 or less: nothing.
using MarginalUtility = std::function<double(
    const TeamTask& task, const TeamResources& self, std::span<const TeamTask> bundle)>;
/// 1 / (1 + d / 1000 m), d from the last task of the bundle or the own place.
double nearness(const TeamTask& task, const TeamResources& self,
                std::span<const TeamTask> bundle);

/// How a member of a team plays its part.
struct TeamConfig {
  TeamTimes times;
  TeamStructure structure = TeamStructure::kMaster;
  std::optional<EntityId> fixed_leader = std::nullopt;  ///< for kFixedMaster
  std::set<EntityId> known;  ///< who may be in the team; empty: anybody
  /// Ground stations, where operators hand in tasks. They lead only until they can hand
  /// over to somebody else, and are never selected.
  std::set<EntityId> operators;
  /// A leader allocates anew after so long, whatever has happened [s]; 0: only when a
  /// task or a member came or went.
  double allocation_period = 0;
  /// An allocation comes into force when the operator has approved it: at a station of
  /// `operators`, or of the fixed leader. Only for structures in which somebody leads.
  bool approval = false;
  std::map<EntityId, std::string> names;  ///< for texts; who has none: the number
  SelectLeader select = lowest_id;
  AllocateTasks allocate = allocate_nearest;
  DivideTasks divide = divide_by_size;
  AdmitNewcomer admit = {};  ///< none: everybody
  MarginalUtility utility = nearness;
  std::size_t bundle = 1;  ///< tasks that a member may win in an auction
  std::uint64_t seed = 1;  ///< of the jitter
};

}  // namespace skein::reasoning
