// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/routing/learned_routes.h"

#include <algorithm>

#include "skein/data/radio/message.h"

namespace skein::communication {

LearnedRoutes::LearnedRoutes(const LearnedRoutesOptions& options, std::size_t entities,
                             std::uint64_t seed)
    : Flooding(options.flooding, entities, seed), options_(options), routes_(entities) {}

LearnedRoutes::Route* LearnedRoutes::find(EntityId node, EntityId to) {
  auto& routes = routes_[node.value];
  const auto place = std::lower_bound(
      routes.begin(), routes.end(), to,
      [](const Route& route, EntityId other) { return route.to < other; });
  return place != routes.end() && place->to == to ? &*place : nullptr;
}

// A route that was heard of now, unless a shorter one is known.
void LearnedRoutes::keep(EntityId node, const Route& heard) {
  if (heard.to == node) return;
  if (Route* known = find(node, heard.to)) {
    const bool old = heard.known - known->known > options_.lifetime;
    if (old || known->by == heard.by || heard.hops <= known->hops) *known = heard;
    return;
  }
  auto& routes = routes_[node.value];
  routes.insert(
      std::upper_bound(routes.begin(), routes.end(), heard,
                       [](const Route& a, const Route& b) { return a.to < b.to; }),
      heard);
}

void LearnedRoutes::learn(EntityId node, EntityId sender, const RoutedMessage& message,
                          Time now) {
  // Whom a radio hears itself needs no route.
  if (message.hops > 0) keep(node, {message.origin, sender, message.hops, now});
}

void LearnedRoutes::overhear(EntityId node, EntityId sender, EntityId receiver,
                             const RoutedMessage& message, Time now) {
  learn(node, sender, message, now);
  if (receiver == message.to) keep(node, {receiver, sender, 1, now});
}

std::optional<EntityId> LearnedRoutes::next(EntityId node, const RoutedMessage& message,
                                            const HeardLately& hears, Time now) {
  const auto flooded = Flooding::next(node, message, hears, now);
  if (flooded != kEveryone || message.to == kEveryone) return flooded;
  const Route* route = find(node, message.to);
  const bool fresh = route && now - route->known <= options_.lifetime;
  return fresh && hears(node, route->by) ? route->by : flooded;
}

bool LearnedRoutes::failed(EntityId node, EntityId next) {
  std::erase_if(routes_[node.value],
                [next](const Route& route) { return route.by == next; });
  return true;
}

}  // namespace skein::communication
