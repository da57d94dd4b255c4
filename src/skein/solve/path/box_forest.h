// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace skein::solve {

/// A box in space and time: north, east, altitude [m] and time [s].
struct Box {
  std::array<double, 4> low{}, high{};

  bool meets(const Box& other) const {
    bool apart = false;
    for (std::size_t i = 0; i < 4; ++i)
      apart |= high[i] < other.low[i] || other.high[i] < low[i];
    return !apart;
  }
  void include(const Box& other);
};

/// Numbered boxes that may be added to at any time: a few trees of bounding boxes, each
/// at least twice as large as the next.
///
/// Cost: adding N boxes one by one is N log^2 N in all, a search about logarithmic.
class BoxForest {
 public:
  struct Entry {
    Box box;
    std::int32_t id;
  };

  void add(std::vector<Entry> entries);

  /// Calls `visit(id)` for each box that `accepts(box)` takes, of those whose surrounding
  /// boxes are taken as well. The order is fixed.
  template <class Accepts, class Visit>
  void walk(const Accepts& accepts, const Visit& visit) const {
    for (const Tree& tree : trees_) {
      std::size_t i = 0;
      while (i < tree.nodes.size()) {
        const Node& node = tree.nodes[i];
        if (!accepts(node.box)) {
          i = node.skip;
          continue;
        }
        for (std::size_t k = node.begin; k < node.end; ++k)
          if (accepts(tree.entries[k].box)) visit(tree.entries[k].id);
        ++i;
      }
    }
  }

 private:
  // Nodes in the order of a walk; `skip` is the next one that is not below this one.
  // Inner nodes have no entries of their own.
  struct Node {
    Box box;
    std::size_t skip = 0, begin = 0, end = 0;
  };
  struct Tree {
    std::vector<Node> nodes;
    std::vector<Entry> entries;
  };

  static void build(Tree& tree, std::size_t begin, std::size_t end);

  std::vector<Tree> trees_;
};

}  // namespace skein::solve
