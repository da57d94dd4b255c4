// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "skein/base/time.h"
#include "skein/layer/communication/medium/frame.h"

namespace skein::communication {

/// Who hears whom: of each node, when it has heard the others last.
class Neighbours {
 public:
  /// A node has become, or is no more, the neighbour of another.
  struct Change {
    NodeIndex node = 0, other = 0;
    bool found = false;
  };

  /// @param patience  after so long without a word a neighbour is lost.
  Neighbours(std::size_t nodes, Time patience) : patience_(patience), heard_(nodes) {}

  /// `node` has heard `other`. Found at once; lost ones are found by step().
  void hear(NodeIndex node, NodeIndex other, Time now, std::vector<Change>& changes);

  /// Appends the neighbours that were lost by now.
  void step(Time now, std::vector<Change>& changes);

  /// Whether `node` has heard `other` lately.
  bool has(NodeIndex node, NodeIndex other, Time now) const;

 private:
  struct Entry {
    NodeIndex other;
    Time last;
  };

  Time patience_;
  std::vector<std::vector<Entry>> heard_;  // by node, in the order of the others
};

}  // namespace skein::communication
