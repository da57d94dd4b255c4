// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/routing/flooding.h"

#include "skein/data/radio/message.h"

namespace skein::communication {
namespace {

constexpr std::uint32_t kRelayDelays = 6;  // of a node's random streams for its radio

}  // namespace

Flooding::Flooding(const FloodingOptions& options, std::size_t entities,
                   std::uint64_t seed)
    : options_(options) {
  delays_.reserve(entities);
  for (std::uint32_t node = 0; node < entities; ++node)
    delays_.emplace_back(seed, node, Purpose::kRadio, kRelayDelays);
}

std::optional<EntityId> Flooding::next(EntityId node, const RoutedMessage& message,
                                       const HeardLately& hears, Time) {
  if (message.hops > options_.hops) return std::nullopt;
  if (message.to != kEveryone && hears(node, message.to)) return message.to;
  return kEveryone;
}

double Flooding::delay(EntityId node) {
  return options_.delay * delays_[node.value].uniform();
}

}  // namespace skein::communication
