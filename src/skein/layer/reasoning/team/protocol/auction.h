// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "skein/data/team/team_message.h"
#include "skein/layer/reasoning/team/protocol/team_config.h"

namespace skein::reasoning {

/// Tasks are shared without a leader, by a consensus-based bundle algorithm.
///
/// Each member builds a bundle: again and again the task of the largest marginal utility
/// among those for which it offers more than the highest bid that it knows (of equal bids
/// the lower id wins). It sends the highest bids that it knows to all. Who is outbid
/// gives up that task and those that it added later, and builds anew. With utilities that
/// do not grow with the bundle all agree after as many exchanges as there are members and
/// hops, without conflict.
///
/// What each member bids is known by its own count of changes, so that old news does not
/// replace newer; bids of members that are lost are dropped.
///
/// Reference: [Choi09] section IV.
class Auction {
 public:
  /// Builds the own bundle anew where others have bid more or tasks have changed.
  /// @returns  whether it is another one than before.
  bool bid(EntityId self, const TeamResources& resources,
           const std::vector<TeamTask>& tasks, const MarginalUtility& utility,
           std::size_t max_bundle);

  /// Takes in what another one knows.
  void take(EntityId self, const TeamBids& bids);
  /// Drops what a member has bid.
  void drop(EntityId member) { bids_.erase(member); }

  /// The tasks that it has won, in the order in which it took them.
  std::vector<std::uint32_t> won() const;
  /// All that it knows, for the others.
  std::vector<TeamBid> known(EntityId self) const;
  std::set<EntityId> bidders() const;

 private:
  struct Bundle {
    std::uint32_t round = 0;
    std::vector<TeamBid> bids;
  };
  bool is_outbid(EntityId self, std::uint32_t task, double value) const;

  void outdate(const TeamBid& said);

  std::vector<TeamBid> own_;
  std::uint32_t round_ = 0;
  std::map<EntityId, Bundle> bids_;  // of the others
};

}  // namespace skein::reasoning
