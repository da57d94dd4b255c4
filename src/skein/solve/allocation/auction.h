// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "skein/base/id.h"
#include "skein/data/describe/describe.h"

namespace skein::solve {

/// What a bidder holds true of one task.
struct TaskClaim {
  std::uint32_t task = 0;
  std::uint32_t version = 0;  ///< of the task: grows when it changes
  bool taken = false;         ///< somebody has it
  EntityId winner;            ///< who, if it is taken
  double bid = 0;             ///< what it is worth to them
};

constexpr auto describe(const TaskClaim*) {
  using T = TaskClaim;
  return described<T>({"task_claim", "task_claims"}, "Who has a task, as a bidder knows.",
                      field("task", &T::task, "its number"),
                      field("version", &T::version, "grows when the task changes"),
                      field("taken", &T::taken, "somebody has it"),
                      field("winner", &T::winner, "who, if it is taken"),
                      field("bid", &T::bid, "what it is worth to them"));
}

/// Up to which of its messages somebody was heard, directly or by way of others.
struct HeardBidder {
  EntityId bidder;
  std::uint32_t number = 0;
};

constexpr auto describe(const HeardBidder*) {
  using T = HeardBidder;
  return described<T>({"heard_bidder", "heard_bidders"},
                      "How new what a bidder knows of another is.",
                      field("bidder", &T::bidder, "the other"),
                      field("number", &T::number, "its newest message that counts"));
}

/// Everything that a bidder knows. Each message replaces those before it: any may be
/// lost, late or come twice.
struct AuctionMessage {
  EntityId sender;
  std::uint32_t number = 0;  ///< grows with each message of the sender; from 1
  std::vector<TaskClaim> claims;
  std::vector<HeardBidder> heard;
};

constexpr auto describe(const AuctionMessage*) {
  using T = AuctionMessage;
  return described<T>({"auction_message", "auction_messages"},
                      "What a bidder knows of all tasks.",
                      field("sender", &T::sender, "the bidder"),
                      field("number", &T::number, "grows with each of its messages"),
                      field("claims", &T::claims, "who has which task"),
                      field("heard", &T::heard, "how new what it knows of others is"));
}

/// One aircraft in an auction without auctioneer: the consensus-based bundle algorithm.
/// Each takes tasks one by one where they add most to its path, bids that worth, sends
/// what it knows, and gives up a task, and those that it took after it, when somebody
/// bids more. When nothing is lost for long enough all agree, and no task has two
/// winners.
///
/// What a task adds must not grow with the tasks taken before; where it does, the bid is
/// that of the task before, so that all still come to agree.
///
/// Example: each second `build()`, send `message()`, `receive()` what comes.
/// Reference: [Choi09] algorithms 3 and 4, table I; [Johnson12] for bids that do not
/// grow.
class Bidder {
 public:
  /// What a path is worth to this aircraft, tasks in the order in which it does them; an
  /// empty one 0. Not a number or negative differences: such a task is not taken.
  using PathValue = std::function<double(std::span<const std::uint32_t> path)>;

  /// @param capacity  tasks that it takes at most; 1: a coalition of one.
  Bidder(EntityId self, std::size_t capacity, PathValue value);

  /// A task is there, or has changed: what was bid for an older version is void.
  void set_task(std::uint32_t task, std::uint32_t version);
  /// A task has vanished.
  void remove_task(std::uint32_t task);
  /// What its paths are worth has changed (it has moved): all its bids are made anew.
  void revalue();
  /// Somebody is gone: what it had is free.
  void forget(EntityId bidder);

  /// Takes tasks while there is room and one is worth more than what others bid.
  /// @returns  whether anything was taken.
  bool build();
  /// What is to be sent now; its number is new.
  AuctionMessage message();
  /// Takes over what another one knows, by the rules of [Choi09] table I.
  ///
  /// @returns  whether the message counted: not when it is older than one that was heard,
  ///           its own, or malformed (numbers that are not finite, a task twice).
  bool receive(const AuctionMessage& message);

  /// Its tasks in the order in which it does them.
  const std::vector<std::uint32_t>& path() const { return path_; }
  /// What it knows of a task; none: it does not know the task.
  std::optional<TaskClaim> claim_of(std::uint32_t task) const;
  EntityId self() const { return self_; }

 private:
  struct Offer {
    std::uint32_t task;
    std::size_t place;
    double bid;
  };
  std::optional<Offer> best_offer() const;
  std::optional<Offer> offer_for(std::uint32_t task, double value) const;
  bool beats(double bid, EntityId by, const TaskClaim& claim) const;
  void consider(TaskClaim& own, const TaskClaim& theirs, EntityId sender,
                const std::map<EntityId, std::uint32_t>& their_heard);
  bool is_newer(EntityId about,
                const std::map<EntityId, std::uint32_t>& their_heard) const;
  void release_lost();
  void release_from(std::size_t place_in_bundle);

  EntityId self_;
  std::size_t capacity_;
  PathValue value_;
  std::uint32_t number_ = 0;
  std::map<std::uint32_t, TaskClaim> claims_;
  std::map<EntityId, std::uint32_t> heard_;   // s of the paper, by message numbers
  std::map<EntityId, std::uint32_t> direct_;  // the newest message of each
  std::vector<std::uint32_t> bundle_, path_;  // in the order taken, in that done
  std::vector<double> bids_;                  // of the bundle
};

}  // namespace skein::solve
