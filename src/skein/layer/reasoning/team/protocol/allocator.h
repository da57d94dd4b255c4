// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "skein/layer/reasoning/team/protocol/approval.h"

namespace skein::reasoning {

/// Who flies what, as a leader works it out by TeamConfig::allocate.
///
/// Where allocations need approval, in force is only what was approved, or what members
/// executed before this one led. What a lost member had is taken over by who is idle,
/// without asking: that a task is flown is approved, not by whom.
class TeamAllocator {
 public:
  /// Its lead begins.
  void begin();
  /// Its lead ends.
  void end(MemberState& member, ProposalDisplay& display) {
    approval_.withdraw(member, display);
  }

  /// Notes in MemberState::allocation_due whether the time has come, or the own ability
  /// has changed.
  void look(MemberState& member);
  void allocate(MemberState& member, ProposalDisplay& display,
                std::span<const TeamTask> tasks, std::vector<TeamWorker> workers);
  void send_proposal(MemberState& member) { approval_.send(member); }
  /// A decision of who may decide.
  /// @returns  whether another allocation is in force.
  bool settle(MemberState& member, ProposalDisplay& display, EntityId from,
              const TeamDecision& decision, std::span<const TeamTask> tasks,
              std::span<const TeamWorker> workers);

  /// What members shall do, in order.
  const TeamAllocation& in_force() const { return in_force_; }

 private:
  void keep_in_force(std::span<const TeamTask> tasks, std::vector<TeamWorker>& workers);
  void take_over(MemberState& member, std::span<const TeamTask> tasks,
                 std::vector<TeamWorker>& workers);

  TeamAllocation in_force_;  // of all that are able
  TeamApproval approval_;
  double allocated_ = 0;                // when it was worked out [s]
  bool able_ = true;                    // whether it was itself then
  std::vector<std::uint32_t> refused_;  // by itself then
};

}  // namespace skein::reasoning
