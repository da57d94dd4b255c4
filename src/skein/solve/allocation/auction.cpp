// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/allocation/auction.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "skein/base/check.h"

namespace skein::solve {
namespace {

constexpr double kMinBid = 1e-9;  // what adds less is not taken

void take_over(TaskClaim& own, const TaskClaim& theirs) {
  own.taken = theirs.taken;
  own.winner = theirs.winner;
  own.bid = theirs.bid;
}
void reset(TaskClaim& own) {
  own.taken = false;
  own.winner = {};
  own.bid = 0;
}

bool is_well_formed(const AuctionMessage& message) {
  std::set<std::uint32_t> tasks;
  for (const TaskClaim& claim : message.claims)
    if (!tasks.insert(claim.task).second ||
        (claim.taken && !(std::isfinite(claim.bid) && claim.bid > 0)))
      return false;
  std::set<EntityId> bidders;
  for (const HeardBidder& heard : message.heard)
    if (!bidders.insert(heard.bidder).second) return false;
  return message.number > 0;
}

}  // namespace

Bidder::Bidder(EntityId self, std::size_t capacity, PathValue value)
    : self_(self), capacity_(capacity), value_(std::move(value)) {
  SKEIN_CHECK(value_, "a bidder needs to know what paths are worth");
}

void Bidder::set_task(std::uint32_t task, std::uint32_t version) {
  const auto found = claims_.find(task);
  if (found != claims_.end() && found->second.version >= version) return;
  remove_task(task);
  TaskClaim& claim = claims_[task];
  claim.task = task;
  claim.version = version;
}

void Bidder::remove_task(std::uint32_t task) {
  const auto place = std::find(bundle_.begin(), bundle_.end(), task);
  if (place != bundle_.end())
    release_from(static_cast<std::size_t>(place - bundle_.begin()));
  claims_.erase(task);
}

void Bidder::revalue() {
  release_from(0);
}

void Bidder::forget(EntityId bidder) {
  for (auto& [task, claim] : claims_)
    if (claim.taken && claim.winner == bidder && bidder != self_) reset(claim);
}

std::optional<TaskClaim> Bidder::claim_of(std::uint32_t task) const {
  const auto found = claims_.find(task);
  if (found == claims_.end()) return std::nullopt;
  return found->second;
}

bool Bidder::beats(double bid, EntityId by, const TaskClaim& claim) const {
  if (!claim.taken) return true;
  return bid > claim.bid || (bid == claim.bid && by < claim.winner);
}

std::optional<Bidder::Offer> Bidder::offer_for(std::uint32_t task, double value) const {
  std::optional<Offer> best;
  std::vector<std::uint32_t> path;
  for (std::size_t place = 0; place <= path_.size(); ++place) {
    path = path_;
    path.insert(path.begin() + static_cast<std::ptrdiff_t>(place), task);
    const double added = value_(path) - value;
    if (std::isfinite(added) && (!best || added > best->bid)) best = {task, place, added};
  }
  if (best && !bids_.empty()) best->bid = std::min(best->bid, bids_.back());
  return best;
}

std::optional<Bidder::Offer> Bidder::best_offer() const {
  const double value = path_.empty() ? 0 : value_(path_);
  std::optional<Offer> best;
  for (const auto& [task, claim] : claims_) {
    if (std::find(bundle_.begin(), bundle_.end(), task) != bundle_.end()) continue;
    const auto offer = offer_for(task, value);
    if (!offer || offer->bid < kMinBid || !beats(offer->bid, self_, claim)) continue;
    if (!best || offer->bid > best->bid) best = offer;
  }
  return best;
}

bool Bidder::build() {
  bool taken = false;
  while (bundle_.size() < capacity_) {
    const auto offer = best_offer();
    if (!offer) break;
    bundle_.push_back(offer->task);
    bids_.push_back(offer->bid);
    path_.insert(path_.begin() + static_cast<std::ptrdiff_t>(offer->place), offer->task);
    TaskClaim& claim = claims_[offer->task];
    claim.taken = true;
    claim.winner = self_;
    claim.bid = offer->bid;
    taken = true;
  }
  return taken;
}

AuctionMessage Bidder::message() {
  AuctionMessage message;
  message.sender = self_;
  message.number = ++number_;
  for (const auto& [task, claim] : claims_) message.claims.push_back(claim);
  for (const auto& [bidder, number] : heard_) message.heard.push_back({bidder, number});
  return message;
}

bool Bidder::is_newer(EntityId about,
                      const std::map<EntityId, std::uint32_t>& their_heard) const {
  const auto theirs = their_heard.find(about);
  if (theirs == their_heard.end()) return false;
  const auto own = heard_.find(about);
  return own == heard_.end() || theirs->second > own->second;
}

// Table I: rows by whom the sender thinks the winner to be, then by whom we do.
void Bidder::consider(TaskClaim& own, const TaskClaim& theirs, EntityId sender,
                      const std::map<EntityId, std::uint32_t>& their_heard) {
  const bool own_self = own.taken && own.winner == self_;
  const bool own_sender = own.taken && own.winner == sender;
  const bool more = theirs.taken && beats(theirs.bid, theirs.winner, own);
  if (!theirs.taken) {
    const bool newer = own.taken && is_newer(own.winner, their_heard);
    if (own_sender || (!own_self && newer)) take_over(own, theirs);
    return;
  }
  const EntityId m = theirs.winner;
  if (m == sender) {
    if (own_sender || more ||
        (own.taken && !own_self && is_newer(own.winner, their_heard)))
      take_over(own, theirs);
    return;
  }
  if (m == self_) {
    if (own_sender || (own.taken && !own_self && is_newer(own.winner, their_heard)))
      reset(own);
    return;
  }
  const bool newer = is_newer(m, their_heard);
  if (!own.taken || (own.winner == m && !own_self)) {
    if (newer) take_over(own, theirs);
  } else if (own_self) {
    if (newer && more) take_over(own, theirs);
  } else if (own_sender) {
    newer ? take_over(own, theirs) : reset(own);
  } else {
    const bool newer_of_ours = is_newer(own.winner, their_heard);
    if (newer && (newer_of_ours || more))
      take_over(own, theirs);
    else if (newer_of_ours && !newer)
      reset(own);
  }
}

bool Bidder::receive(const AuctionMessage& message) {
  if (message.sender == self_ || !is_well_formed(message)) return false;
  std::uint32_t& newest = direct_[message.sender];
  if (message.number <= newest) return false;
  newest = message.number;
  std::map<EntityId, std::uint32_t> their_heard;
  for (const HeardBidder& heard : message.heard) their_heard[heard.bidder] = heard.number;
  their_heard[message.sender] = message.number;
  for (const TaskClaim& theirs : message.claims) {
    const auto own = claims_.find(theirs.task);
    if (own != claims_.end() && own->second.version == theirs.version)
      consider(own->second, theirs, message.sender, their_heard);
  }
  for (const auto& [bidder, number] : their_heard) {
    if (bidder == self_) continue;
    std::uint32_t& known = heard_[bidder];
    known = std::max(known, number);
  }
  release_lost();
  return true;
}

// Gives up the first task that was lost, and all that were taken after it.
void Bidder::release_lost() {
  for (std::size_t k = 0; k < bundle_.size(); ++k) {
    const TaskClaim& claim = claims_[bundle_[k]];
    if (claim.taken && claim.winner == self_) continue;
    release_from(k);
    return;
  }
}

void Bidder::release_from(std::size_t place_in_bundle) {
  for (std::size_t k = place_in_bundle; k < bundle_.size(); ++k) {
    TaskClaim& claim = claims_[bundle_[k]];
    if (claim.taken && claim.winner == self_) reset(claim);
    path_.erase(std::find(path_.begin(), path_.end(), bundle_[k]));
  }
  bundle_.resize(place_in_bundle);
  bids_.resize(place_in_bundle);
}

}  // namespace skein::solve
