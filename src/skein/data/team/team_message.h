// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "skein/base/id.h"
#include "skein/data/describe/describe.h"
#include "skein/geo/vec.h"

/// What members of a team that leads itself say to each other.
namespace skein {

/// A mission of a team. Once it was split between two masters that met again, each part
/// is a branch, named after the master that had it first: M/7.
struct TeamMission {
  std::string name;  ///< the operator's
  std::optional<EntityId> branch = std::nullopt;
  friend bool operator==(const TeamMission&, const TeamMission&) = default;
};

constexpr auto describe(const TeamMission*) {
  using T = TeamMission;
  return described<T>({"team_mission"}, "A mission of a team, or a branch of it.",
                      field("name", &T::name, "the operator's name; also its lineage"),
                      field("branch", &T::branch, "of a part: its first master"));
}

/// "M", or "M/7" for a branch.
std::string name_of(const TeamMission& mission);

/// A task of a team's mission.
struct TeamTask {
  std::uint32_t number = 0;   ///< among the mission's, from 1
  Vec2 place = Vec2::Zero();  ///< its centre, N [m]
  bool single = true;         ///< one aircraft does it, not a group
  bool done = false;
  /// Of a mission that was split: whose part it is.
  std::optional<EntityId> branch = std::nullopt;
  std::uint32_t sensors = 0;  ///< TeamResources::sensors that it takes, all of them
  /// What is to be done: a TaskKind as wire::encode() makes it. Empty: nothing is flown.
  std::vector<std::uint8_t> what = {};
  /// The operator has approved that it is flown: whoever does so.
  bool released = false;
  /// Numbers of tasks that are over, done or withdrawn, before it is flown.
  std::vector<std::uint32_t> after = {};
  /// The operator does not want it any more; it is done too: nothing is left of it.
  bool withdrawn = false;
  friend bool operator==(const TeamTask&, const TeamTask&) = default;
};

constexpr auto describe(const TeamTask*) {
  using T = TeamTask;
  return described<T>({"team_task"}, "A task of a team's mission.",
                      field("number", &T::number, "among the mission's, from 1"),
                      field("place", &T::place, axes::kPlace, "its centre"),
                      field("single", &T::single, "one aircraft does it, not a group"),
                      field("done", &T::done, "nothing is left of it"),
                      field("branch", &T::branch, "of a mission that was split"),
                      field("sensors", &T::sensors, "a bit for each kind that it takes"),
                      field("what", &T::what, Storage::kBytes, "the task, coded"),
                      field("released", &T::released, "the operator has approved it"),
                      field("after", &T::after, "tasks that are over before it is flown"),
                      field("withdrawn", &T::withdrawn, "the operator wants it no more"));
}

/// What a member can do.
struct TeamResources {
  Vec3 place = Vec3::Zero();  ///< N [m]
  float speed = 0;            ///< cruise [m/s]
  float endurance = 0;        ///< left [s]
  std::uint32_t sensors = 0;  ///< a bit for each kind
  bool able = true;           ///< it flies tasks; false: a ground station, a pilot flies
  std::int32_t home_north = 0, home_east = 0;  ///< where it flies in the end, N [m]
  /// Numbers of tasks that it has found it cannot fly, and is not to be given for a
  /// while.
  std::vector<std::uint32_t> refused = {};
};

constexpr auto describe(const TeamResources*) {
  using T = TeamResources;
  return described<T>(
      {"team_resources"}, "What a member of a team can do.",
      field("place", &T::place, axes::kPlace, "where it is"),
      field("speed", &T::speed, unit::kMetrePerSecond, "cruise"),
      field("endurance", &T::endurance, unit::kSecond, "what is left"),
      field("sensors", &T::sensors, "a bit for each kind"),
      field("able", &T::able, "it flies tasks"),
      field("home_north", &T::home_north, unit::kMetre, "where it flies in the end"),
      field("home_east", &T::home_east, unit::kMetre, "likewise"),
      field("refused", &T::refused, "tasks that it cannot fly now"));
}

/// How far a member is with a task that it executes.
struct TeamProgress {
  std::uint32_t task = 0;
  double share = 0;  ///< done, from 0 to 1
};

constexpr auto describe(const TeamProgress*) {
  using T = TeamProgress;
  return described<T>({"team_progress"}, "How far a member is with a task.",
                      field("task", &T::task, "its number"),
                      field("share", &T::share, "that is done, from 0 to 1"));
}

/// A master asks its followers, to all; without a mission: a newcomer looks for masters.
struct TeamQuery {
  std::optional<TeamMission> mission = std::nullopt;
  std::uint32_t members = 0;       ///< how many, the master included
  std::uint32_t members_hash = 0;  ///< of their ids
  std::uint32_t state_number = 0;  ///< TeamState::number of what it has now
  float led = 0;                   ///< for how long it has led [s]
  float round_trip = 0;            ///< the longest that it has measured [s]
  /// Who takes over from the sender.
  std::optional<EntityId> successor = std::nullopt;
  /// From whom the sender took over.
  std::optional<EntityId> predecessor = std::nullopt;
};

constexpr auto describe(const TeamQuery*) {
  using T = TeamQuery;
  return described<T>(
      {"team_query"}, "A master asks its followers, or a newcomer looks for masters.",
      field("mission", &T::mission, "null: the sender is a newcomer"),
      field("members", &T::members, "how many, the master included"),
      field("members_hash", &T::members_hash, "of their ids"),
      field("state_number", &T::state_number, "of the state as it is now"),
      field("led", &T::led, unit::kSecond, "for how long it has led"),
      field("round_trip", &T::round_trip, unit::kSecond, "the longest measured"),
      field("successor", &T::successor, "takes over from the sender"),
      field("predecessor", &T::predecessor, "from whom it took over"));
}

/// What a member says of itself, to all and in answer to queries.
struct TeamInform {
  std::optional<TeamMission> mission = std::nullopt;  ///< none: a newcomer
  std::optional<EntityId> master = std::nullopt;      ///< whom it follows, or itself
  std::uint32_t query = 0;         ///< number of the last one heard from its master
  float held = 0;                  ///< since that was heard [s]
  std::uint32_t members_hash = 0;  ///< of the members that it knows
  std::uint32_t state_number = 0;  ///< of the newest state that it has in full
  bool leaving = false;            ///< it leads no more
  TeamResources resources;
  std::vector<TeamProgress> tasks;  ///< that it executes
};

constexpr auto describe(const TeamInform*) {
  using T = TeamInform;
  return described<T>({"team_inform"}, "What a member of a team says of itself.",
                      field("mission", &T::mission, "null: a newcomer"),
                      field("master_id", &T::master, "whom it follows, or itself"),
                      field("query", &T::query, "number of its master's last one"),
                      field("held", &T::held, unit::kSecond, "since that was received"),
                      field("members_hash", &T::members_hash, "of whom it knows"),
                      field("state_number", &T::state_number, "of what it has in full"),
                      field("leaving", &T::leaving, "it leads no more"),
                      field("resources", &T::resources, "what it can do"),
                      field("tasks", &T::tasks, "that it executes"));
}

/// A newcomer offers itself to a master.
struct TeamPropose {
  std::uint32_t exchange = 0;  ///< counts the sender's tries
  TeamResources resources;
};

constexpr auto describe(const TeamPropose*) {
  using T = TeamPropose;
  return described<T>({"team_propose"}, "A newcomer offers itself to a master.",
                      field("exchange", &T::exchange, "counts the sender's tries"),
                      field("resources", &T::resources, "what it can do"));
}

/// A master would take a newcomer.
struct TeamAccept {
  std::uint32_t exchange = 0;
  TeamMission mission;
  double distance = 0;        ///< from the newcomer to the nearest task's centre [m]
  std::uint32_t members = 0;  ///< of the master's team
};

constexpr auto describe(const TeamAccept*) {
  using T = TeamAccept;
  return described<T>(
      {"team_accept"}, "A master would take a newcomer.",
      field("exchange", &T::exchange, "of the proposal"),
      field("mission", &T::mission, "of its team"),
      field("distance", &T::distance, unit::kMetre, "to the nearest task's centre"),
      field("members", &T::members, "of its team"));
}

/// A master would not.
struct TeamReject {
  std::uint32_t exchange = 0;
};
constexpr auto describe(const TeamReject*) {
  return described<TeamReject>(
      {"team_reject"}, "A master has no use for a newcomer.",
      field("exchange", &TeamReject::exchange, "of the proposal"));
}

/// A newcomer joins the receiver.
struct TeamConfirm {
  std::uint32_t exchange = 0;
};
constexpr auto describe(const TeamConfirm*) {
  return described<TeamConfirm>(
      {"team_confirm"}, "A newcomer joins the receiver.",
      field("exchange", &TeamConfirm::exchange, "of the proposal"));
}

/// A newcomer joins somebody else.
struct TeamDecline {
  std::uint32_t exchange = 0;
};
constexpr auto describe(const TeamDecline*) {
  return described<TeamDecline>(
      {"team_decline"}, "A newcomer joins somebody else.",
      field("exchange", &TeamDecline::exchange, "of the proposal"));
}

/// A master's order: these tasks and no others.
struct TeamAssign {
  TeamMission mission;
  std::uint32_t number = 0;  ///< counts the master's orders to the receiver
  std::vector<TeamTask> tasks;
};

constexpr auto describe(const TeamAssign*) {
  using T = TeamAssign;
  return described<T>({"team_assign"}, "A master's order: these tasks and no others.",
                      field("mission", &T::mission, "whose tasks they are"),
                      field("number", &T::number, "counts the master's orders"),
                      field("tasks", &T::tasks, "in the order in which they are flown"));
}

/// The order is obeyed.
struct TeamAssignAck {
  std::uint32_t number = 0;
};
constexpr auto describe(const TeamAssignAck*) {
  return described<TeamAssignAck>(
      {"team_assign_ack"}, "An order is obeyed.",
      field("number", &TeamAssignAck::number, "of the order"));
}

/// Two masters of one lineage that have met, and how often.
struct TeamEncounter {
  EntityId lower, higher;
  std::uint32_t times = 0;
  friend bool operator==(const TeamEncounter&, const TeamEncounter&) = default;
};

constexpr auto describe(const TeamEncounter*) {
  using T = TeamEncounter;
  return described<T>({"team_meeting"}, "Two masters of one lineage that have met.",
                      field("lower_id", &T::lower, "one of them"),
                      field("higher_id", &T::higher, "the other"),
                      field("times", &T::times, "how often"));
}

/// What a team knows, from its master to all, so that any member can take over. In parts:
/// each has all members and meetings and some of the tasks.
struct TeamState {
  std::uint32_t number = 0;  ///< a fingerprint of all tasks
  std::uint32_t part = 0;
  std::uint32_t parts = 1;
  std::vector<EntityId> members;  ///< ascending, the master included
  std::vector<TeamEncounter> met;
  std::vector<TeamTask> tasks;
};

constexpr auto describe(const TeamState*) {
  using T = TeamState;
  return described<T>({"team_state"}, "What a team knows, for whoever takes over.",
                      field("number", &T::number, "a fingerprint of all tasks"),
                      field("part", &T::part, "from 0"),
                      field("parts", &T::parts, "how many there are"),
                      field("members", &T::members, "the master included"),
                      field("met", &T::met, "masters that met"),
                      field("tasks", &T::tasks, "of this part"));
}

/// A master gives way to the receiver, with all its followers; or asks, as they meet for
/// the second time, that the mission is split between them.
struct TeamMerge {
  TeamMission mission;            ///< of the sender
  TeamEncounter meeting;          ///< this one included
  bool split = false;             ///< both stay
  std::vector<EntityId> members;  ///< of the sender, itself included
};

constexpr auto describe(const TeamMerge*) {
  using T = TeamMerge;
  return described<T>({"team_merge"}, "A master gives way to another, or both stay.",
                      field("mission", &T::mission, "of the sender"),
                      field("meeting", &T::meeting, "this one included"),
                      field("split", &T::split, "both stay, the mission is split"),
                      field("members", &T::members, "of the sender"));
}

/// How a mission was split: all its tasks with the branch of each.
struct TeamSplit {
  TeamMission mission;  ///< of the receiver from now on
  TeamEncounter meeting;
  std::uint32_t part = 0;
  std::uint32_t parts = 1;
  std::vector<TeamTask> tasks;
};

constexpr auto describe(const TeamSplit*) {
  using T = TeamSplit;
  return described<T>({"team_split"}, "How a mission was split between two masters.",
                      field("mission", &T::mission, "of the receiver from now on"),
                      field("meeting", &T::meeting, "the second one"),
                      field("part", &T::part, "from 0"),
                      field("parts", &T::parts, "how many there are"),
                      field("tasks", &T::tasks, "of this part"));
}

/// What a member without a master offers for a task.
struct TeamBid {
  std::uint32_t task = 0;
  std::optional<EntityId> winner = std::nullopt;
  double value = 0;
  std::uint32_t round = 0;  ///< of the winner's bid: counts its changes
};

constexpr auto describe(const TeamBid*) {
  using T = TeamBid;
  return described<T>({"team_bid"}, "Who is believed to win a task.",
                      field("task", &T::task, "its number"),
                      field("winner_id", &T::winner, "null: nobody"),
                      field("value", &T::value, "of the highest bid"),
                      field("round", &T::round, "counts the winner's changes"));
}

/// The highest bids that a member knows, to all.
struct TeamBids {
  TeamMission mission;
  std::vector<TeamBid> bids;
};

constexpr auto describe(const TeamBids*) {
  using T = TeamBids;
  return described<T>({"team_bids"}, "The highest bids that a member knows.",
                      field("mission", &T::mission, "whose tasks they are for"),
                      field("bids", &T::bids, "one for each task"));
}

/// A task that a member of a team is given by an allocation.
struct TeamShare {
  EntityId member;
  std::uint32_t task = 0;  ///< its number
  friend bool operator==(const TeamShare&, const TeamShare&) = default;
};

constexpr auto describe(const TeamShare*) {
  using T = TeamShare;
  return described<T>({"team_share"}, "A task that a member is given.",
                      field("entity_id", &T::member, "which member"),
                      field("task", &T::task, "its number"));
}

/// What becomes of an allocation that a leader has worked out.
enum class AllocationState : std::uint8_t {
  kWaits,      ///< for the operator's approval
  kApproved,   ///< the operator has approved it: it is in force
  kRejected,   ///< the operator has rejected it: what was in force stays
  kWithdrawn,  ///< tasks or members came or went before the operator decided, or the lead
  kTakenOver,  ///< in force at once: approved tasks of a member that was lost
  kUnasked,    ///< in force at once: no approval is needed
};
constexpr auto names_of(const AllocationState*) {
  return std::array<std::string_view, 6>{"waits",     "approved",   "rejected",
                                         "withdrawn", "taken-over", "unasked"};
}

/// An allocation that a leader proposes to an operator's station, and what became of it.
struct TeamProposal {
  TeamMission mission;
  std::uint32_t number = 0;  ///< from 1; grows
  AllocationState state = AllocationState::kWaits;
  std::optional<float> value = std::nullopt;  ///< utility; none: it is not measured
  std::optional<float> bound = std::nullopt;  ///< no allocation is better
  std::vector<TeamShare> shares = {};         ///< in the order in which they are flown
};

constexpr auto describe(const TeamProposal*) {
  using T = TeamProposal;
  return described<T>({"team_proposal"}, "An allocation that a leader proposes.",
                      field("mission", &T::mission, "whose tasks they are"),
                      field("number", &T::number, "from 1; grows"),
                      field("state", &T::state, "what becomes of it"),
                      field("value", &T::value, "its utility; null: not measured"),
                      field("bound", &T::bound, "no allocation is better"),
                      field("shares", &T::shares, "who gets which tasks"));
}

/// What a station says about a proposal.
enum class TeamAnswer : std::uint8_t {
  kSeen,     ///< the operator is shown it
  kApprove,  ///< it shall come into force
  kReject,   ///< it shall not
  kTaken,    ///< another leader's had that number: it needs a higher one
};
constexpr auto names_of(const TeamAnswer*) {
  return std::array<std::string_view, 4>{"seen", "approve", "reject", "taken"};
}

/// The answer of an operator's station to a proposal.
struct TeamDecision {
  std::uint32_t number = 0;  ///< of the proposal; kTaken: the highest one known
  TeamAnswer answer = TeamAnswer::kSeen;
};

constexpr auto describe(const TeamDecision*) {
  using T = TeamDecision;
  return described<T>({"team_decision"}, "A station's answer to a proposal.",
                      field("number", &T::number, "of the proposal"),
                      field("answer", &T::answer, "what the operator says"));
}

/// A follower is there, and nothing of its last `inform` has changed but where it is and
/// how far: to all, in answer to queries.
struct TeamHere {
  std::optional<EntityId> master = std::nullopt;  ///< whom it follows
  std::uint32_t query = 0;         ///< number of the last one heard from its master
  float held = 0;                  ///< since that was heard [s]
  std::uint32_t members_hash = 0;  ///< of the members that it knows
  std::uint32_t state_number = 0;  ///< of the newest state that it has in full
};

constexpr auto describe(const TeamHere*) {
  using T = TeamHere;
  return described<T>({"team_here"}, "A follower is there; its inform still holds.",
                      field("master_id", &T::master, "whom it follows"),
                      field("query", &T::query, "number of its master's last one"),
                      field("held", &T::held, unit::kSecond, "since that was received"),
                      field("members_hash", &T::members_hash, "of whom it knows"),
                      field("state_number", &T::state_number, "of what it has in full"));
}

/// What members of a team say. New kinds go to the end.
using TeamContent =
    std::variant<TeamQuery, TeamInform, TeamPropose, TeamAccept, TeamReject, TeamConfirm,
                 TeamDecline, TeamAssign, TeamAssignAck, TeamState, TeamMerge, TeamSplit,
                 TeamBids, TeamProposal, TeamDecision, TeamHere>;

/// A message of the team protocol.
struct TeamMessage {
  static constexpr std::uint32_t kVersion = 2;

  std::uint32_t version = kVersion;  ///< of the protocol
  /// Counts what the sender says to all, and by itself what it says to the receiver.
  std::uint32_t number = 0;
  TeamContent content;
};

constexpr auto describe(const TeamMessage*) {
  using T = TeamMessage;
  return described<T>({"team"}, "A message of a team that leads itself.",
                      field("version", &T::version, "of the protocol"),
                      field("team_number", &T::number, "counts the sender's messages"),
                      field("said", &T::content, Storage::kKindOnly, "what it says"));
}

/// The word for what a message says.
std::string_view kind_of(const TeamContent& content);

/// Bytes on the air in fixed point with a header of 9 bytes, where names of missions are
/// numbers of 2 bytes: query 25, inform and proposal 70 and 2 for each task refused,
/// accept 25, confirm 17, reject and decline 13, assign 21 + 48 for each task, its answer
/// 17; state 21 + 2 for each member + 8 for each meeting + 24 for each task; 2 for each
/// that a task comes after; merge 25 + 2 for each member; split 25 + 24 for each task;
/// bids 17 + 10 for each; proposal 24 + 4 for each share; decision 14; here 25.
std::size_t air_bytes(const TeamContent& content);

/// Why somebody leads.
enum class TeamReason : std::uint8_t {
  kNewcomer,   ///< nobody yet
  kSelected,   ///< by the rule, as nobody led
  kFollowing,  ///< it was heard to lead
  kJoined,     ///< a newcomer chose its team
  kMerged,     ///< two masters met
  kSplit,      ///< they met again
  kHandover,   ///< the one before gave it up
  kLost,       ///< nobody: the master was lost
  kFixed,      ///< the structure says so
  kAlone,      ///< nobody else leads in this structure
  kMembers,    ///< as before; the members changed
};
constexpr auto names_of(const TeamReason*) {
  return std::array<std::string_view, 11>{"newcomer", "selected", "following", "joined",
                                          "merged",   "split",    "handover",  "lost",
                                          "fixed",    "alone",    "members"};
}

/// Who leads a member of a team, from a moment on.
struct TeamStatus {
  std::optional<TeamMission> mission = std::nullopt;
  std::optional<EntityId> master = std::nullopt;
  std::vector<EntityId> members;  ///< ascending, itself included
  TeamReason reason = TeamReason::kNewcomer;
  friend bool operator==(const TeamStatus&, const TeamStatus&) = default;
};

constexpr auto describe(const TeamStatus*) {
  using T = TeamStatus;
  return described<T>({"team_status"}, "Who leads a member of a team, and why.",
                      field("mission", &T::mission, "null: it has none"),
                      field("master_id", &T::master, "null: nobody"),
                      field("members", &T::members, "itself included"),
                      field("reason", &T::reason, "why"));
}

/// Who leads a member of a team, as records say it.
struct TeamLead {
  std::string team;                               ///< its mission, "M/7" for a branch
  std::optional<EntityId> master = std::nullopt;  ///< none: nobody
  std::vector<EntityId> members;                  ///< itself included
  TeamReason reason = TeamReason::kNewcomer;
};

constexpr auto describe(const TeamLead*) {
  using T = TeamLead;
  return described<T>({"team_lead"}, "Who leads a member of a team, and why.",
                      field("team", &T::team, "its mission; M/7: a branch; empty: none"),
                      field("master_id", &T::master, "null: nobody"),
                      field("members", &T::members, Storage::kJson, "itself included"),
                      field("reason", &T::reason, "why"));
}

/// An allocation of a team's tasks, as records keep it whenever something becomes of it.
struct TeamAllocationReport {
  std::string team;          ///< its mission, "M/7" for a branch
  EntityId proposer;         ///< who leads, and has worked it out
  std::uint32_t number = 0;  ///< of a proposal; 0: it was none
  AllocationState state = AllocationState::kWaits;
  std::optional<double> value = std::nullopt;  ///< utility; none: it is not measured
  std::optional<double> bound = std::nullopt;  ///< no allocation is better
  std::optional<double> gap = std::nullopt;    ///< (bound - value) / the larger of both
  std::vector<TeamShare> shares;               ///< in the order in which they are flown
};

constexpr auto describe(const TeamAllocationReport*) {
  using T = TeamAllocationReport;
  return described<T>(
      {"team_allocation_report"}, "An allocation of a team's tasks.",
      field("team", &T::team, "its mission; M/7: a branch"),
      field("proposer_id", &T::proposer, "who leads, and has worked it out"),
      field("number", &T::number, "of the proposal; 0: it was none"),
      field("state", &T::state, "what becomes of it"),
      field("value", &T::value, "its utility; null: not measured"),
      field("bound", &T::bound, "no allocation is better; null: not known"),
      field("gap", &T::gap, "bound minus value over the larger of both"),
      field("shares", &T::shares, Storage::kJson, "who gets which tasks"));
}

}  // namespace skein
