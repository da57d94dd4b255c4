// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include "skein/base/random.h"
#include "skein/base/time.h"
#include "skein/data/team/team_message.h"
#include "skein/layer/reasoning/team/protocol/contacts.h"
#include "skein/layer/reasoning/team/protocol/knowledge.h"
#include "skein/layer/reasoning/team/protocol/outbox.h"
#include "skein/layer/reasoning/team/protocol/own_tasks.h"
#include "skein/layer/reasoning/team/protocol/team_config.h"

namespace skein::reasoning {

/// Query periods without a message of the leader after which it is silent: others may
/// still receive it.
inline constexpr double kSilentPeriods = 2;

/// What a member is in its team at present.
enum class TeamRole : std::uint8_t {
  kNewcomer,   ///< it knows no mission
  kSelecting,  ///< it has a mission and nobody to lead it
  kFollowing,
  kLeading,
  kAlone,  ///< of a structure in which nobody leads
};

/// It follows another one from now on.
struct FollowOther {
  EntityId leader;
  TeamReason reason = TeamReason::kFollowing;
};
/// It leads from now on.
struct LeadTeam {
  TeamReason reason = TeamReason::kSelected;
  std::optional<EntityId> predecessor = std::nullopt;
};
/// The change of role that a part of a member asks for; mostly none.
using TeamTransition = std::variant<std::monostate, FollowOther, LeadTeam>;

/// Whom a member follows, or has followed last, and what shows that it is there.
struct TeamLeader {
  std::optional<EntityId> id = std::nullopt;
  double evidence = 0;      ///< when it was last known to lead, by whomever [s]
  double received = 0;      ///< when a query of its own arrived last [s]
  std::uint32_t query = 0;  ///< the number of the last query known to have been received
};

/// What the parts of a member have in common: who it is, the time, its role, what it has
/// received and knows, what it executes, and what it sends. A value: parts get it as an
/// argument and keep no reference.
struct MemberState {
  MemberState(EntityId id, TeamConfig how);

  EntityId self;
  TeamConfig config;
  bool leaving = false;  ///< it shall not lead any more

  double now = 0;                          ///< [s]
  double lost = 0;                         ///< T_lost [s], by the loss measured
  double round_trip = 0;                   ///< the longest measured [s]; 0: not known
  double next_query = 0, next_inform = 0;  ///< when they are due [s]

  TeamRole role = TeamRole::kNewcomer;
  std::optional<TeamMission> mission;
  TeamLeader leader;
  /// Of its team: as its leader says; of who leads, itself and its followers, ascending.
  std::vector<EntityId> members;
  TeamStatus status;            ///< what others are shown of all that
  bool allocation_due = false;  ///< tasks or members have changed since the last

  TeamContacts contacts;
  TeamKnowledge knowledge;
  OwnTasks own;
  TeamOutbox outbox;
  RandomStream jitter;

  /// A step begins.
  void begin(Time time);
  /// T_lost by what has arrived until now.
  void measure_loss();
  /// When a periodic message is due again: evenly after the last, but for a jitter.
  double after(double last);

  const TeamTimes& times() const { return config.times; }
  /// How long to wait for an answer before something is sent again [s].
  double repeat_after() const;
  /// For how long an exchange stays open: until the other is lost, and there and back
  /// [s].
  double exchange_time() const;
  /// After how long of silence a follower is lost [s]: T_lost, and longer where many say
  /// rarely that they are there (follower_period()).
  double follower_lost_after() const;
  /// Whether so many messages are lost that followers leave none out.
  bool loses_many() const;

  bool leads() const { return role == TeamRole::kLeading; }
  bool follows() const { return role == TeamRole::kFollowing; }
  bool takes_part_in_auction() const {
    return role == TeamRole::kAlone && config.structure == TeamStructure::kAuction;
  }
  bool is_operator(EntityId id) const { return config.operators.contains(id); }
  /// Whether an operator is with it who approves allocations.
  bool approves(EntityId id) const {
    return is_operator(id) || config.fixed_leader == id;
  }
  bool leaves() const { return leaving || is_operator(self); }

  /// Whether a mission is the own one, or a whole or a part of it that has no other
  /// branch.
  bool is_of_lineage(const std::optional<TeamMission>& other) const;
  /// Whether it is another branch of the own mission.
  bool is_sibling(const std::optional<TeamMission>& other) const;
  /// A station belongs to no branch: it follows whichever it receives.
  bool may_follow(const std::optional<TeamMission>& other) const {
    return is_of_lineage(other) || (is_operator(self) && is_sibling(other));
  }

  /// Executes these tasks and no others, and says so soon.
  void execute(std::vector<std::uint32_t> tasks);
  /// A task is done, as somebody says.
  void finish(std::uint32_t task) { allocation_due |= knowledge.finish(task); }
  void finish_own();
  /// Tasks that others say to be done are.
  void take_progress(const TeamInform& inform);
  /// Itself, as one that can be given tasks.
  TeamWorker own_worker() const;
  /// What it says of itself.
  TeamInform inform() const;
  /// Renews `status` from role, mission, leader and members.
  /// @param reason  kMembers: the one of before holds.
  void set_status(TeamReason reason);
};

}  // namespace skein::reasoning
