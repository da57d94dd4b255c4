// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/random.h"
#include "skein/role/routing.h"

namespace skein::communication {

struct FloodingOptions {
  std::uint32_t hops = 3;  ///< radios that may pass a message on
  double delay = 0.05;     ///< each waits up to this before, uniform [s]
};

/// Who hears the receiver sends it there; else the message goes to all, and whoever gets
/// it passes it on.
class Flooding : public Routing {
 public:
  Flooding(const FloodingOptions& options, std::size_t entities, std::uint64_t seed);

  /// Origin, number and hops of a message.
  std::uint32_t head_bytes() const override { return 8; }
  void learn(EntityId, EntityId, const RoutedMessage&, Time) override {}
  std::optional<EntityId> next(EntityId node, const RoutedMessage& message,
                               const HeardLately& hears, Time now) override;
  bool failed(EntityId, EntityId) override { return true; }
  double delay(EntityId node) override;

 private:
  FloodingOptions options_;
  std::vector<RandomStream> delays_;  // by node
};

}  // namespace skein::communication
