// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "skein/base/random.h"
#include "skein/data/radio/message.h"

namespace skein::reasoning {

/// A radio that loses, duplicates, delays and reorders messages, and that parts members
/// into groups between which nothing passes.
class ModelAir {
 public:
  struct Quality {
    double loss = 0;       ///< share that does not arrive, each receiver by itself
    double duplicate = 0;  ///< share that arrives twice
    double delay = 0;      ///< [s]
    double jitter = 0;     ///< up to so much more, so that messages overtake [s]
  };

  explicit ModelAir(std::uint64_t seed) : random_(seed, 0, Purpose::kTest, 1) {}

  Quality quality;

  void put(EntityId id, std::size_t group) { group_of_[id] = group; }
  std::size_t group_of(EntityId id) const { return group_of_.at(id); }
  /// Nothing reaches it, and what is under way is lost.
  void remove(EntityId id) {
    group_of_.erase(id);
    under_way_.erase(id);
  }
  bool has(EntityId id) const { return group_of_.contains(id); }

  void send(const Message& message, double now) {
    if (!has(message.from)) return;
    for (const auto& [to, group] : group_of_)
      if (to != message.from && (message.to == kEveryone || message.to == to) &&
          group == group_of(message.from))
        carry(to, message, now);
  }

  /// What has arrived, in the order in which it did.
  std::vector<Message> receive(EntityId id, double now) {
    auto& all = under_way_[id];
    std::vector<Message> arrived;
    while (!all.empty() && all.begin()->first <= now) {
      arrived.push_back(std::move(all.begin()->second));
      all.erase(all.begin());
    }
    return arrived;
  }

  /// What has become of messages: each that arrived, was lost, or came twice.
  std::uint64_t events() const { return events_; }

 private:
  void carry(EntityId to, const Message& message, double now) {
    ++events_;
    if (random_.uniform() < quality.loss) return;
    const int copies = random_.uniform() < quality.duplicate ? 2 : 1;
    events_ += static_cast<std::uint64_t>(copies - 1);
    for (int copy = 0; copy < copies; ++copy)
      under_way_[to].emplace(now + quality.delay + quality.jitter * random_.uniform(),
                             message);
  }

  RandomStream random_;
  std::map<EntityId, std::size_t> group_of_;
  std::map<EntityId, std::multimap<double, Message>> under_way_;
  std::uint64_t events_ = 0;
};

}  // namespace skein::reasoning
