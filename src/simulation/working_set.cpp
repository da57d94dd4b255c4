#include "simulation/working_set.h"

#include <malloc.h>

namespace skein::simulation {
namespace {

constexpr std::size_t kCacheLine = 64;  // [bytes]; only speed depends on it

// The heap block of an object, whatever its type is.
template <class Role>
std::span<const std::byte> block_of(const Role& part) {
  const void* begin = dynamic_cast<const void*>(&part);
  return {static_cast<const std::byte*>(begin),
          malloc_usable_size(const_cast<void*>(begin))};
}

}  // namespace

WorkingSet::WorkingSet(const Entity& entity, const EntityState& state) {
  const Vehicle* vehicle = entity.vehicle.get();
  if (!vehicle) return;
  blocks_.reserve(vehicle->sensors.size() + 4);
  blocks_.push_back(std::as_bytes(std::span(&state, 1)));
  blocks_.push_back(std::as_bytes(std::span(vehicle, 1)));
  blocks_.push_back(block_of(*vehicle->autopilot));
  if (vehicle->turbulence) blocks_.push_back(block_of(*vehicle->turbulence));
  for (const auto& sensor : vehicle->sensors) blocks_.push_back(block_of(*sensor));
}

void WorkingSet::prefetch() const {
  constexpr int kToWrite = 1, kIntoSecondLevel = 2;
  for (const std::span<const std::byte> block : blocks_)
    for (std::size_t at = 0; at < block.size(); at += kCacheLine)
      __builtin_prefetch(block.data() + at, kToWrite, kIntoSecondLevel);
}

}  // namespace skein::simulation
