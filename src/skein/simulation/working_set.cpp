// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/working_set.h"

#include <malloc.h>

#include <algorithm>

#include "skein/simulation/simulated_vehicle.h"

namespace skein::simulation {
namespace {

constexpr std::int64_t kCacheLine = 64;  // [bytes]; only speed depends on it

// The heap block of an object, whatever its type is.
template <class Role>
std::span<const std::byte> block_of(const Role& part) {
  const void* begin = dynamic_cast<const void*>(&part);
  return {static_cast<const std::byte*>(begin),
          malloc_usable_size(const_cast<void*>(begin))};
}

}  // namespace

WorkingSet::WorkingSet(const void* vehicle, std::size_t size, const VehicleParts& parts) {
  blocks_.reserve(parts.sensors.size() + 3);
  blocks_.emplace_back(static_cast<const std::byte*>(vehicle), size);
  blocks_.push_back(block_of(*parts.autopilot));
  if (parts.turbulence) blocks_.push_back(block_of(*parts.turbulence));
  for (const auto& sensor : parts.sensors) blocks_.push_back(block_of(*sensor));
  for (const auto& block : blocks_) size_ += std::ssize(block);
}

void WorkingSet::prefetch(std::int64_t part, std::int64_t parts) const {
  constexpr int kToWrite = 1, kIntoSecondLevel = 2;
  std::int64_t from = size_ * part / parts, to = size_ * (part + 1) / parts;
  for (const auto& block : blocks_) {
    if (to <= 0) return;
    const std::int64_t end = std::min(to, std::ssize(block));
    std::int64_t at = std::max<std::int64_t>(from, 0);
    for (; at < end; at += kCacheLine)
      __builtin_prefetch(block.data() + at, kToWrite, kIntoSecondLevel);
    from -= std::ssize(block);
    to -= std::ssize(block);
  }
}

}  // namespace skein::simulation
