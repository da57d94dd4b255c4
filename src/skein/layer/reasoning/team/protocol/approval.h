// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "skein/layer/reasoning/team/protocol/proposal_display.h"

namespace skein::reasoning {

/// An allocation without those that are given nothing.
TeamAllocation without_idle(TeamAllocation all);

/// Something becomes of an allocation: that is recorded.
/// @param number  of its proposal; 0: it was none.
void record_allocation(MemberState& member, AllocationState state, std::uint32_t number,
                       const TeamAllocated& allocated);

/// How a leader has its allocations approved by the operators: proposes them, repeats
/// that until it is shown, and takes decisions. However often a decision comes, it counts
/// once, and is answered each time. A proposal is withdrawn when tasks or members came or
/// went; one that is rejected does not come into force, and is not proposed again while
/// nothing has changed.
class TeamApproval {
 public:
  /// Its lead begins: of what was proposed before nothing is left.
  void clear() { proposal_.reset(); }

  /// Proposes an allocation, unless it is in force or proposed already.
  /// @param found    what shall be in force.
  /// @param present  what is in force now.
  void propose(MemberState& member, ProposalDisplay& display,
               std::span<const TeamTask> tasks, std::span<const TeamWorker> workers,
               TeamAllocated found, TeamAllocation present);
  /// Repeats what is proposed, to stations that are received.
  void send(MemberState& member);
  void withdraw(MemberState& member, ProposalDisplay& display);

  /// A decision of who may decide.
  /// @returns  what comes into force by it: of what was approved, without tasks and
  ///           members that are gone meanwhile; none: nothing does.
  std::optional<TeamAllocation> settle(MemberState& member, ProposalDisplay& display,
                                       EntityId from, const TeamDecision& decision,
                                       std::span<const TeamTask> tasks,
                                       std::span<const TeamWorker> workers);

 private:
  struct Proposal {
    std::uint32_t number = 0;
    TeamAllocated allocated;  // without who gets nothing
    TeamAllocation present;   // what was in force then
    std::set<std::uint32_t> tasks;
    std::set<EntityId> members;  // able ones
    bool seen = false, rejected = false;
    int quick = 0;    // messages that are left to be repeated soon
    double next = 0;  // when it is sent again [s]
  };
  static TeamProposal message_of(const MemberState& member, const Proposal& proposal,
                                 AllocationState state);
  TeamAllocation approve(MemberState& member, std::span<const TeamTask> tasks,
                         std::span<const TeamWorker> workers);

  std::optional<Proposal> proposal_;
  std::uint32_t last_number_ = 0;
  std::pair<std::uint32_t, AllocationState> last_settled_{};  // and its number
};

}  // namespace skein::reasoning
