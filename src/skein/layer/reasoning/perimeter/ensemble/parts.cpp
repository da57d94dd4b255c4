// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/ensemble/parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace skein::perimeter {
namespace {

constexpr double kPlace = 20;         // [m]
constexpr double kHalfNeck = 25;      // of a neck that joins two parts [m]
constexpr double kMinHalfNeck = 1.5;  // the same in cells
constexpr double kSight = 60;  // fire this near to a place of fire has been seen [m]

using Mask = std::vector<std::uint8_t>;

template <class Visit>
void for_neighbours(const model::Grid& grid, std::size_t i, const Visit& visit) {
  const auto columns = static_cast<std::size_t>(grid.columns);
  const std::size_t column = i % columns;
  if (column > 0) visit(i - 1);
  if (column + 1 < columns) visit(i + 1);
  if (i >= columns) visit(i - columns);
  if (i + columns < grid.size()) visit(i + columns);
}

// Marks all that hangs together with the `open` nodes, which are marked already.
template <class Together>
void spread(const model::Grid& grid, std::vector<std::size_t> open, Mask& marked,
            const Together& together) {
  while (!open.empty()) {
    const std::size_t i = open.back();
    open.pop_back();
    for_neighbours(grid, i, [&](std::size_t k) {
      if (marked[k] != 0 || !together(i, k)) return;
      marked[k] = 1;
      open.push_back(k);
    });
  }
}

// One step of growth of the nodes of `front` into nodes that may be entered.
template <class Enter>
std::vector<std::size_t> grow(const model::Grid& grid,
                              const std::vector<std::size_t>& front, const Enter& enter) {
  std::vector<std::size_t> next;
  for (const std::size_t i : front)
    for_neighbours(grid, i, [&](std::size_t k) {
      if (enter(k)) next.push_back(k);
    });
  return next;
}

// Nodes on the right side of the mean where somebody has been.
std::vector<std::size_t> visited(const model::Grid& grid, const Evidence& evidence,
                                 std::span<const double> mean, bool inside) {
  std::vector<std::size_t> out;
  for (const Vec2& p : evidence.points(inside)) {
    const Vec2 at = (p - grid.low) / grid.cell;
    const long row = std::lround(at.x()), column = std::lround(at.y());
    if (row < 0 || column < 0 || row >= grid.rows || column >= grid.columns) continue;
    const std::size_t i = grid.index(static_cast<int>(row), static_cast<int>(column));
    if ((mean[i] < 0) == inside) out.push_back(i);
  }
  return out;
}

// 1 for nodes without fire that hang together with a visited one or the grid's edge.
Mask seen_outside(const model::Grid& grid, const Evidence& evidence,
                  std::span<const double> mean) {
  Mask seen(mean.size(), 0);
  std::vector<std::size_t> open = visited(grid, evidence, mean, false);
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) {
      const bool edge = r == 0 || c == 0 || r + 1 == grid.rows || c + 1 == grid.columns;
      if (edge && mean[grid.index(r, c)] >= 0) open.push_back(grid.index(r, c));
    }
  for (const std::size_t i : open) seen[i] = 1;
  spread(grid, std::move(open), seen,
         [&](std::size_t, std::size_t k) { return mean[k] >= 0; });
  return seen;
}

// Parts of the fire, numbered from 1; 0 where there is none. A part is what hangs
// together at least half a neck deep, its core, with the rim that is nearer to it than to
// other cores; what has no core at all is a part where it hangs together.
struct Parts {
  std::vector<int> of;  // node
  int count = 0;
};

Parts parts_of(const model::Grid& grid, std::span<const double> mean, double core) {
  Parts parts{std::vector<int>(mean.size(), 0), 0};
  std::vector<std::size_t> all;
  const auto flood = [&](std::size_t start, double level) {
    ++parts.count;
    parts.of[start] = parts.count;
    std::vector<std::size_t> open{start};
    while (!open.empty()) {
      const std::size_t i = open.back();
      open.pop_back();
      all.push_back(i);
      for_neighbours(grid, i, [&](std::size_t k) {
        if (parts.of[k] != 0 || mean[k] >= level) return;
        parts.of[k] = parts.count;
        open.push_back(k);
      });
    }
  };
  for (std::size_t i = 0; i < mean.size(); ++i)
    if (parts.of[i] == 0 && mean[i] < core) flood(i, core);
  for (std::vector<std::size_t> front = all; !front.empty();) {
    std::vector<std::size_t> next;
    for (const std::size_t i : front)
      for_neighbours(grid, i, [&](std::size_t k) {
        if (parts.of[k] != 0 || mean[k] >= 0) return;
        parts.of[k] = parts.of[i];
        next.push_back(k);
      });
    front = std::move(next);
  }
  for (std::size_t i = 0; i < mean.size(); ++i)
    if (parts.of[i] == 0 && mean[i] < 0) flood(i, 0);
  return parts;
}

// 1 for nodes of fire that belong to a seen part (somebody was in it, or saw its core
// from a place nearby), and of unseen parts larger than all that was seen.
Mask kept_inside(const model::Grid& grid, const Evidence& evidence,
                 std::span<const double> mean) {
  const double core = -std::max(kHalfNeck, kMinHalfNeck * grid.cell);
  const Parts parts = parts_of(grid, mean, core);
  Mask seen_part(static_cast<std::size_t>(parts.count) + 1, 0);
  const auto see = [&](std::size_t i) {
    seen_part[static_cast<std::size_t>(parts.of[i])] = 1;
  };
  std::vector<std::size_t> front = visited(grid, evidence, mean, true);
  Mask near(mean.size(), 0);
  for (const std::size_t i : front) {
    see(i);
    near[i] = 1;
  }
  for (double far = 0; far < kSight; far += grid.cell) {
    front = grow(grid, front, [&](std::size_t k) {
      if (near[k] != 0 || mean[k] >= 0) return false;
      near[k] = 1;
      return true;
    });
    for (const std::size_t i : front)
      if (mean[i] < core) see(i);
  }
  std::vector<std::size_t> size(seen_part.size(), 0);
  for (const int part : parts.of) ++size[static_cast<std::size_t>(part)];
  std::size_t seen = 0;
  for (std::size_t part = 1; part < size.size(); ++part)
    if (seen_part[part] != 0) seen += size[part];
  Mask kept(mean.size(), 0);
  if (seen == 0) return kept;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const auto part = static_cast<std::size_t>(parts.of[i]);
    kept[i] = part != 0 && (seen_part[part] != 0 || size[part] > seen);
  }
  return kept;
}

}  // namespace

void Evidence::add(const Vec2& p, bool inside) {
  constexpr std::size_t kFresh = 256;
  Side& side = sides_[inside ? 1 : 0];
  const Place place = key(p);
  if (side.settled && std::ranges::binary_search(*side.settled, place)) return;
  side.fresh.insert(place);
  if (side.fresh.size() < kFresh) return;
  side.settled = std::make_shared<const std::vector<Place>>(all(side));
  side.fresh.clear();
}

std::size_t Evidence::size(bool inside) const {
  const Side& side = sides_[inside ? 1 : 0];
  return (side.settled ? side.settled->size() : 0) + side.fresh.size();
}

std::vector<Evidence::Place> Evidence::all(const Side& side) {
  std::span<const Place> settled;
  if (side.settled) settled = *side.settled;
  std::vector<Place> all;
  all.reserve(settled.size() + side.fresh.size());
  std::ranges::merge(settled, side.fresh, std::back_inserter(all));
  return all;
}

std::pair<int, int> Evidence::key(const Vec2& p) {
  return {static_cast<int>(std::floor(p.x() / kPlace)),
          static_cast<int>(std::floor(p.y() / kPlace))};
}

std::vector<Vec2> Evidence::points(bool inside) const {
  std::vector<Vec2> out;
  for (const auto& [x, y] : all(sides_[inside ? 1 : 0]))
    out.push_back(kPlace * Vec2(x + 0.5, y + 0.5));
  return out;
}

std::vector<std::size_t> unseen_nodes(const model::Grid& grid, const Evidence& evidence,
                                      std::span<const double> mean) {
  std::vector<std::size_t> out;
  const Mask inside = kept_inside(grid, evidence, mean);
  // A fire that nobody has touched yet stays where the prior has it.
  if (std::find(inside.begin(), inside.end(), 1) == inside.end()) return out;
  const Mask outside = seen_outside(grid, evidence, mean);
  for (std::size_t i = 0; i < mean.size(); ++i)
    if (mean[i] < 0 ? inside[i] == 0 : outside[i] == 0) out.push_back(i);
  return out;
}

void drop_remnants(std::span<const double> mean, model::Field& phi) {
  // Only nodes that differ from the mean can belong to remnants; those that touch a node
  // of their own kind where the mean agrees do not, nor what hangs on them.
  std::vector<std::size_t> differing;
  Mask kept(phi.values.size(), 1);
  const auto inside = [&](std::size_t i) { return std::signbit(phi.values[i]); };
  for (std::size_t i = 0; i < phi.values.size(); ++i)
    if (inside(i) != (mean[i] < 0)) {
      kept[i] = 0;
      differing.push_back(i);
    }
  std::vector<std::size_t> open;
  for (const std::size_t i : differing) {
    bool anchored = false;
    for_neighbours(phi.grid, i, [&](std::size_t k) {
      anchored = anchored || (kept[k] != 0 && inside(k) == inside(i));
    });
    if (anchored) open.push_back(i);
  }
  for (const std::size_t i : open) kept[i] = 1;
  spread(phi.grid, std::move(open), kept,
         [&](std::size_t i, std::size_t k) { return inside(i) == inside(k); });
  for (const std::size_t i : differing)
    if (kept[i] == 0) phi.values[i] = -phi.values[i];
}

}  // namespace skein::perimeter
