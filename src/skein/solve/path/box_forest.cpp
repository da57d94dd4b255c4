// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/box_forest.h"

#include <algorithm>
#include <utility>

namespace skein::solve {
namespace {

constexpr std::size_t kLeaf = 4;
// Unbounded sides count as this far away where boxes are sorted.
constexpr double kFar = 1e7;
// Seconds are compared with metres at about an aircraft's speed.
constexpr std::array kScale = {1.0, 1.0, 1.0, 20.0};

double middle(const Box& box, std::size_t axis) {
  return kScale[axis] * (std::clamp(box.low[axis], -kFar, kFar) +
                         std::clamp(box.high[axis], -kFar, kFar));
}

std::size_t widest(const std::vector<BoxForest::Entry>& entries, std::size_t begin,
                   std::size_t end) {
  std::size_t best = 0;
  double max = -1;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    double low = middle(entries[begin].box, axis), high = low;
    for (std::size_t i = begin; i < end; ++i) {
      low = std::min(low, middle(entries[i].box, axis));
      high = std::max(high, middle(entries[i].box, axis));
    }
    if (high - low > max) {
      max = high - low;
      best = axis;
    }
  }
  return best;
}

}  // namespace

void Box::include(const Box& other) {
  for (std::size_t i = 0; i < 4; ++i) {
    low[i] = std::min(low[i], other.low[i]);
    high[i] = std::max(high[i], other.high[i]);
  }
}

void BoxForest::add(std::vector<Entry> entries) {
  if (entries.empty()) return;
  while (!trees_.empty() && trees_.back().entries.size() < 2 * entries.size()) {
    const std::vector<Entry>& old = trees_.back().entries;
    entries.insert(entries.end(), old.begin(), old.end());
    trees_.pop_back();
  }
  Tree tree;
  tree.entries = std::move(entries);
  build(tree, 0, tree.entries.size());
  trees_.push_back(std::move(tree));
}

void BoxForest::build(Tree& tree, std::size_t begin, std::size_t end) {
  Node node{tree.entries[begin].box, 0, begin, begin};
  for (std::size_t i = begin; i < end; ++i) node.box.include(tree.entries[i].box);
  const std::size_t self = tree.nodes.size();
  tree.nodes.push_back(node);
  if (end - begin <= kLeaf) {
    tree.nodes[self].end = end;
  } else {
    const std::size_t axis = widest(tree.entries, begin, end);
    const std::size_t half = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) {
      return tree.entries.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(begin), at(half), at(end), [&](const Entry& a, const Entry& b) {
      const double ma = middle(a.box, axis), mb = middle(b.box, axis);
      return ma != mb ? ma < mb : a.id < b.id;
    });
    build(tree, begin, half);
    build(tree, half, end);
  }
  tree.nodes[self].skip = tree.nodes.size();
}

}  // namespace skein::solve
