// SPDX-License-Identifier: Apache-2.0
#include "skein/geo/contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "skein/base/check.h"

namespace skein::geo {
namespace {

struct Node {
  int row, column;
};

// Unit steps north, east, south, west: heading + 1 is a quarter turn to the right.
constexpr std::array<Node, 4> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

Node moved(const Node& n, int heading) {
  const Node& step = kSteps[static_cast<std::size_t>(heading & 3)];
  return {n.row + step.row, n.column + step.column};
}

// The walker stands on the edge between `left` (outside) and its right neighbour (inside)
// and heads across it, so the inside always stays on its right.
struct Walker {
  Node left;
  int heading;
  Node right() const { return moved(left, heading + 1); }
};

class Tracer {
 public:
  Tracer(std::span<const double> values, int rows, int columns, const Vec2& low,
         double spacing, double level)
      : values_(values),
        rows_(rows),
        columns_(columns),
        low_(low),
        spacing_(spacing),
        level_(level),
        visited_(values.size(), 0) {}

  Region trace() {
    Region region;
    // Every ring, hole or not, has an edge with its outside node to the west of its
    // inside node: to start at all of those finds all rings.
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < columns_; ++column)
        if (inside({row, column}) && !inside({row, column - 1}) &&
            visited_[index({row, column})] == 0) {
          Ring ring = walk({{row, column - 1}, 0});
          if (ring.size() >= 3 &&
              std::abs(signed_area(ring)) > 1e-9 * spacing_ * spacing_)
            region.push_back(std::move(ring));
        }
    return region;
  }

 private:
  bool in_grid(const Node& n) const {
    return n.row >= 0 && n.column >= 0 && n.row < rows_ && n.column < columns_;
  }
  std::size_t index(const Node& n) const {
    return static_cast<std::size_t>(n.row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(n.column);
  }
  bool inside(const Node& n) const { return in_grid(n) && values_[index(n)] < level_; }

  Vec2 position(const Node& n) const { return low_ + spacing_ * Vec2(n.row, n.column); }

  Vec2 crossing(const Walker& w) const {
    Vec2 from = position(w.right());
    if (!in_grid(w.left)) return from;
    const double a = values_[index(w.right())], b = values_[index(w.left)];
    double part = 0.5;
    // Off the nodes by a millionth, so that rings through one node stay apart.
    if (std::isfinite(a) && std::isfinite(b))
      part = std::clamp((level_ - a) / (b - a), 1e-6, 1 - 1e-6);
    return from + part * (position(w.left) - from);
  }

  // In a cell whose inside corners are a and b on one diagonal: whether they join.
  bool joined(const Node& a, const Node& b, const Node& c, const Node& d) const {
    if (!in_grid(a) || !in_grid(b) || !in_grid(c) || !in_grid(d)) return false;
    // Relative to the level: a and b below 0, c and d not.
    const double va = values_[index(a)] - level_, vb = values_[index(b)] - level_;
    const double vc = values_[index(c)] - level_, vd = values_[index(d)] - level_;
    return std::isfinite(vc) && std::isfinite(vd) && va * vb > vc * vd;
  }

  Walker next(const Walker& w) const {
    const Node ahead_left = moved(w.left, w.heading);
    const Node ahead_right = moved(w.right(), w.heading);
    const bool left_in = inside(ahead_left), right_in = inside(ahead_right);
    const bool to_left =
        left_in && (right_in || joined(w.right(), ahead_left, w.left, ahead_right));
    if (to_left) return {w.left, w.heading + 3};
    if (right_in) return {ahead_left, w.heading};
    return {ahead_right, w.heading + 1};
  }

  Ring walk(const Walker& start) {
    Ring ring;
    Walker w = start;
    do {
      w.heading &= 3;
      if (w.heading == 0) visited_[index(w.right())] = 1;
      const Vec2 p = crossing(w);
      if (ring.empty() || ring.back() != p) ring.push_back(p);
      w = next(w);
    } while ((w.heading & 3) != start.heading || w.left.row != start.left.row ||
             w.left.column != start.left.column);
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    return ring;
  }

  std::span<const double> values_;
  int rows_, columns_;
  Vec2 low_;
  double spacing_, level_;
  std::vector<std::uint8_t> visited_;  // per node: the edge to its west, walked north
};

}  // namespace

Region contour(std::span<const double> values, int rows, int columns, const Vec2& low,
               double spacing, double level) {
  SKEIN_CHECK(rows >= 0 && columns >= 0 && spacing > 0, rows, columns, spacing);
  SKEIN_CHECK(
      values.size() == static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns),
      values.size(), rows, columns);
  return Tracer(values, rows, columns, low, spacing, level).trace();
}

}  // namespace skein::geo
