// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>

namespace skein {

/// A number that names one thing of one kind; ids of different kinds do not mix.
template <class Tag>
struct Id {
  std::uint32_t value = 0;
  friend constexpr auto operator<=>(Id, Id) = default;
};

struct EntityTag;
/// An aircraft or ground station. Entities are numbered in the order of the scenario.
using EntityId = Id<EntityTag>;

}  // namespace skein
