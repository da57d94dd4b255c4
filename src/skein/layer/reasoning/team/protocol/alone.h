// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/team/protocol/auction.h"
#include "skein/layer/reasoning/team/protocol/member_state.h"

namespace skein::reasoning {

/// What a member does in structures in which nobody leads: it allocates tasks to itself
/// alone, or bids for them in an auction of all.
class TeamAlone {
 public:
  void step(MemberState& member);
  /// What goes out with each `inform`: bids, and what it knows to those that know less or
  /// more.
  void send(MemberState& member);

  void on(MemberState& member, const TeamBids& bids);
  /// Of those without a leader all of one mission may add tasks.
  static void on(MemberState& member, EntityId from, const TeamState& state);

 private:
  Auction auction_;
};

}  // namespace skein::reasoning
