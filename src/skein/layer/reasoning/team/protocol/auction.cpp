// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/auction.h"

#include <algorithm>

namespace skein::reasoning {

bool Auction::is_outbid(EntityId self, std::uint32_t task, double value) const {
  for (const auto& [member, bundle] : bids_)
    for (const TeamBid& bid : bundle.bids)
      if (bid.task == task &&
          (bid.value > value || (bid.value == value && member < self)))
        return true;
  return false;
}

bool Auction::bid(EntityId self, const TeamResources& resources,
                  const std::vector<TeamTask>& tasks, const MarginalUtility& utility,
                  std::size_t max_bundle) {
  const auto before = won();
  std::vector<TeamTask> bundle;
  std::vector<TeamBid> kept;
  // A task that is gone or lost takes those with it that were added later.
  for (const TeamBid& bid : own_) {
    const auto task = std::ranges::find(tasks, bid.task, &TeamTask::number);
    if (!resources.able || task == tasks.end() || is_outbid(self, bid.task, bid.value))
      break;
    kept.push_back(bid);
    bundle.push_back(*task);
  }
  while (resources.able && kept.size() < max_bundle) {
    const TeamTask* best = nullptr;
    double most = 0;
    for (const TeamTask& task : tasks) {
      if (std::ranges::find(bundle, task.number, &TeamTask::number) != bundle.end())
        continue;
      double value = utility(task, resources, bundle);
      // Bids do not grow within a bundle: what makes it converge.
      if (!kept.empty()) value = std::min(value, kept.back().value);
      if (value <= most || is_outbid(self, task.number, value)) continue;
      best = &task;
      most = value;
    }
    if (!best) break;
    kept.push_back({best->number, self, most, 0});
    bundle.push_back(*best);
  }
  own_ = std::move(kept);
  if (won() == before) return false;
  ++round_;
  return true;
}

void Auction::take(EntityId self, const TeamBids& bids) {
  std::map<EntityId, Bundle> news;
  for (const TeamBid& bid : bids.bids) {
    if (!bid.winner) continue;
    if (*bid.winner == self) {
      outdate(bid);
      continue;
    }
    Bundle& bundle = news[*bid.winner];
    bundle.round = bid.round;
    if (bid.task > 0) bundle.bids.push_back(bid);
  }
  for (auto& [member, bundle] : news) {
    const auto known = bids_.find(member);
    if (known == bids_.end() || known->second.round <= bundle.round)
      bids_[member] = std::move(bundle);
  }
}

// What it bid before it was switched off and on: its own count goes on from there.
void Auction::outdate(const TeamBid& said) {
  constexpr std::uint32_t kMaxRound = 1U << 30;  // that anybody can have reached
  if (said.round < round_ || said.round > kMaxRound) return;
  const bool holds =
      said.task > 0 ? std::ranges::find(own_, said.task, &TeamBid::task) != own_.end()
                    : own_.empty();
  if (said.round > round_ || !holds) round_ = said.round + 1;
}

std::vector<std::uint32_t> Auction::won() const {
  std::vector<std::uint32_t> tasks;
  for (const TeamBid& bid : own_) tasks.push_back(bid.task);
  return tasks;
}

std::vector<TeamBid> Auction::known(EntityId self) const {
  std::vector<TeamBid> all;
  const auto add = [&](EntityId member, std::uint32_t round,
                       const std::vector<TeamBid>& bids) {
    // Task 0 is none: a member without any bid says so too.
    if (bids.empty()) all.push_back({0, member, 0, round});
    for (const TeamBid& bid : bids) all.push_back({bid.task, member, bid.value, round});
  };
  add(self, round_, own_);
  for (const auto& [member, bundle] : bids_) add(member, bundle.round, bundle.bids);
  return all;
}

std::set<EntityId> Auction::bidders() const {
  std::set<EntityId> ids;
  for (const auto& [member, bundle] : bids_) ids.insert(member);
  return ids;
}

}  // namespace skein::reasoning
