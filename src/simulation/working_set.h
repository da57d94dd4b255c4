#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "simulation/entity_step.h"

namespace skein::simulation {

/// The memory in which a flying entity keeps what its steps read and write, to be loaded
/// while another one flies.
///
/// A fleet is larger than the processor's caches, and an aircraft is some ten blocks from
/// the heap: without this a step of the run begins with waiting for each of them. Only
/// speed depends on it.
class WorkingSet {
 public:
  WorkingSet() = default;
  /// Both must stay where they are.
  WorkingSet(const Entity& entity, const EntityState& state);

  /// Has the processor load it all, without waiting.
  void prefetch() const;

 private:
  std::vector<std::span<const std::byte>> blocks_;
};

}  // namespace skein::simulation
