// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/layer/communication/routing/flooding.h"

namespace skein::communication {

struct LearnedRoutesOptions {
  FloodingOptions flooding;                ///< of what has no route
  Time lifetime = Time::from_seconds(10);  ///< of a route that nothing confirms
};

/// Flooding that learns by the way: who gets a message of another by a third one knows
/// that the other is reached by that one; who hears a third one send to its receiver
/// knows that this is. What has a route is sent along it, from radio to radio; what has
/// none floods, and so do messages to all. A route that does not acknowledge is
/// forgotten.
/// Reference: reverse paths as in [PerkinsRoyer99], overheard ones as in
/// [JohnsonMaltz96].
class LearnedRoutes final : public Flooding {
 public:
  LearnedRoutes(const LearnedRoutesOptions& options, std::size_t entities,
                std::uint64_t seed);

  void learn(EntityId node, EntityId sender, const RoutedMessage& message,
             Time now) override;
  void overhear(EntityId node, EntityId sender, EntityId receiver,
                const RoutedMessage& message, Time now) override;
  std::optional<EntityId> next(EntityId node, const RoutedMessage& message,
                               const HeardLately& hears, Time now) override;
  bool failed(EntityId node, EntityId next) override;

 private:
  struct Route {
    EntityId to, by;
    std::uint32_t hops = 0;
    Time known;
  };
  Route* find(EntityId node, EntityId to);
  void keep(EntityId node, const Route& heard);

  LearnedRoutesOptions options_;
  std::vector<std::vector<Route>> routes_;  // by node, in the order of `to`
};

}  // namespace skein::communication
