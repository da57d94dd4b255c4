// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/role/routing.h"

namespace skein::communication {

struct NoRoutingOptions {};

/// Nobody passes anything on: a message goes from its sender to its receiver, or to all
/// who hear it.
class NoRouting final : public Routing {
 public:
  std::uint32_t head_bytes() const override { return 0; }
  void learn(EntityId, EntityId, const RoutedMessage&, Time) override {}
  std::optional<EntityId> next(EntityId, const RoutedMessage& message, const HeardLately&,
                               Time) override {
    if (message.hops > 0) return std::nullopt;
    return message.to;
  }
  bool failed(EntityId, EntityId) override { return false; }
  double delay(EntityId) override { return 0; }
};

}  // namespace skein::communication
