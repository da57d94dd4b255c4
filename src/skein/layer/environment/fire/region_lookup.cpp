// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/fire/region_lookup.h"

namespace skein::environment {

bool RegionLookup::inside(const geo::Region& region, const Vec2& p) const {
  if (!ready_.load(std::memory_order_acquire)) {
    const std::lock_guard lock(building_);
    if (!ready_.load(std::memory_order_relaxed)) {
      index_ = std::make_unique<geo::BoundaryIndex>(region);
      ready_.store(true, std::memory_order_release);
    }
  }
  return index_->contains(p);
}

}  // namespace skein::environment
