// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/role/allocator.h"

namespace skein::reasoning {

/// Gives each mission, the most important first, the aircraft it cannot do without: those
/// that it has, then the nearest that are free, then the nearest of less important
/// missions. What is left is given in turn to the missions that have a use for more.
///
/// An aircraft stays with its mission as long as that wants it, so that nothing changes
/// without a reason.
///
/// Cost: n log n of aircraft for each mission.
class NearestAllocator final : public Allocator {
 public:
  std::vector<std::optional<std::size_t>> allocate(
      const std::vector<AllocatedAircraft>& aircraft,
      const std::vector<WantingMission>& missions) const override;
};

}  // namespace skein::reasoning
