// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/station/reading_router.h"

#include <algorithm>

namespace skein::reasoning {
namespace {

constexpr double kOwn = 0.5;  // of the distance

}  // namespace

bool ReadingRouter::belongs(const FireReading& reading, std::optional<std::size_t> owner,
                            std::size_t mission) const {
  if (!divides()) return true;
  const auto distance = [&](const Watch& watch) {
    return (reading.point - watch.place).norm() * (owner == watch.mission ? kOwn : 1);
  };
  const auto nearest = std::min_element(
      watches_.begin(), watches_.end(),
      [&](const Watch& a, const Watch& b) { return distance(a) < distance(b); });
  return std::any_of(watches_.begin(), watches_.end(), [&](const Watch& watch) {
    return watch.mission == mission && watch.phenomenon == nearest->phenomenon;
  });
}

}  // namespace skein::reasoning
