// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace skein::simulation {

struct VehicleParts;

/// The memory in which a simulated vehicle keeps what its steps read and write, to be
/// loaded while another one flies.
///
/// A fleet is larger than the processor's caches, and an aircraft is some ten blocks from
/// the heap: without this a step of the run begins with waiting for each of them. Only
/// speed depends on it.
class WorkingSet {
 public:
  /// @param vehicle  its own memory, of `size` bytes.
  /// @param parts    must stay where they are.
  WorkingSet(const void* vehicle, std::size_t size, const VehicleParts& parts);

  /// Has the processor load one of `parts` equal parts of it, without waiting: it can
  /// only wait for so many cache lines at a time.
  /// @param part  from 0 to parts - 1.
  void prefetch(std::int64_t part, std::int64_t parts) const;

 private:
  std::vector<std::span<const std::byte>> blocks_;
  std::int64_t size_ = 0;  // of all together [bytes]
};

}  // namespace skein::simulation
