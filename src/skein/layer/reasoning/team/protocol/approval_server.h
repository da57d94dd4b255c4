// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "skein/layer/reasoning/team/protocol/proposal_display.h"

namespace skein::reasoning {

/// How the operator who is with a member approves what leaders propose: shows their
/// proposals, takes decisions, and sends each until its proposer says what has become of
/// it.
class ApprovalServer : public ProposalDisplay {
 public:
  /// The operator decides.
  /// @param number  of the proposal; 0: the only one that waits.
  /// @returns  why that cannot be; empty: the leader is sent it until it answers.
  std::string decide(const TeamConfig& config, std::uint32_t number, bool approve);

  void show(MemberState& member, EntityId proposer,
            const TeamProposal& proposal) override;
  void end(MemberState& member, EntityId proposer, AllocationState state,
           const char* why) override;

  void on(MemberState& member, EntityId from, const TeamProposal& proposal);
  /// Ends the proposals of those that lead no more.
  /// @returns  decisions that are due, and for whom.
  std::vector<std::pair<EntityId, TeamDecision>> step(MemberState& member);

 private:
  struct Shown {
    TeamProposal proposal;
    std::optional<TeamAnswer> decision = std::nullopt;
    double next = 0;  // when that is sent again [s]
  };
  void end_of_lost(MemberState& member);

  std::map<EntityId, Shown> shown_;                // by who proposes
  std::map<EntityId, std::uint32_t> last_number_;  // of each one's proposals
  std::uint32_t highest_number_ = 0;
};

}  // namespace skein::reasoning
