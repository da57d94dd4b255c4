// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "skein/geo/boundary_index.h"

namespace skein::environment {

/// Answers "is this point inside" for a region that changes now and then, from any
/// thread. The index over the region is built when first asked for after a change.
class RegionLookup {
 public:
  /// The region has changed. Not while others ask.
  void reset() { ready_.store(false, std::memory_order_release); }

  /// Whether `p` lies in `region`, which must be the same between two resets.
  /// Cost: linear in the region's points the first time, then some tens of nanoseconds.
  bool inside(const geo::Region& region, const Vec2& p) const;

 private:
  mutable std::atomic<bool> ready_ = false;
  mutable std::mutex building_;
  mutable std::unique_ptr<const geo::BoundaryIndex> index_;
};

}  // namespace skein::environment
