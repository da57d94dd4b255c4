// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/layer/reasoning/team/protocol/member_state.h"

namespace skein::reasoning {

/// Where the operator who is with a member sees proposed allocations: a leader that is
/// such a member itself shows its own there, without a message.
class ProposalDisplay {
 public:
  virtual ~ProposalDisplay() = default;

  virtual void show(MemberState& member, EntityId proposer,
                    const TeamProposal& proposal) = 0;
  /// It is decided or withdrawn; nothing happens when none of the proposer's is shown.
  /// @param why  for the report; empty: no reason is given.
  virtual void end(MemberState& member, EntityId proposer, AllocationState state,
                   const char* why) = 0;
};

/// The name of a member, for texts.
std::string member_name(const TeamConfig& config, EntityId id);
/// A proposal, for an operator to read.
std::string text_of(const TeamConfig& config, EntityId proposer,
                    const TeamProposal& proposal);

}  // namespace skein::reasoning
