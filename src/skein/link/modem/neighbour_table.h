// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/link/modem/datagram.h"

namespace skein::modem {

/// An entity has become, or is no more, a neighbour.
struct NeighbourChange {
  EntityId who;
  std::uint32_t hw = 0;  ///< through which modem
  bool found = false;
};

/// Who is heard, and through which modem.
class NeighbourTable {
 public:
  /// @param entities  that there are; others are nobody
  /// @param patience  after so long without a word a neighbour is lost
  NeighbourTable(std::size_t entities, Time patience);

  /// Whether an identity may be reached so: it is one, and not heard through another
  /// modem.
  bool takes(Address who) const;

  /// An identity is advertised. While it is heard through one modem another one does not
  /// count.
  void advertised(Address who, Time now, std::vector<NeighbourChange>& changes);

  /// Something else of a neighbour was heard.
  /// @returns  whether it is one
  bool heard(Address who, Time now);

  /// Appends the neighbours that were lost by now.
  void step(Time now, std::vector<NeighbourChange>& changes);

  /// Where an identity is reached; none: it is no neighbour.
  std::optional<Address> find(EntityId who) const;

  /// Whether anybody is reached through a modem.
  bool reaches_through(std::uint32_t hw) const;

  bool empty() const { return count_ == 0; }

 private:
  struct Entry {
    std::optional<std::uint32_t> hw;  // none: no neighbour
    Time heard;
  };

  Time patience_;
  std::vector<Entry> entries_;  // by identity
  std::size_t count_ = 0;
};

}  // namespace skein::modem
