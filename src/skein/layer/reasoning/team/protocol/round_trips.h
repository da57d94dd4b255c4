// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "skein/base/id.h"

namespace skein::reasoning {

/// How long it takes from a leader to its followers and back, from the queries that they
/// answer.
class RoundTrips {
 public:
  /// A query goes out.
  void sent(std::uint32_t query, double now);
  /// A follower answers a query, that it received `held` [s] before it did.
  /// @returns  the longest of all followers, smoothed [s]; none: it shows nothing.
  std::optional<double> answered(EntityId from, std::uint32_t query, double held,
                                 double now);
  void forget(EntityId follower) { measured_.erase(follower); }

 private:
  std::map<std::uint32_t, double> sent_;  // when each query went out [s]
  std::map<EntityId, double> measured_;   // [s]
};

}  // namespace skein::reasoning
