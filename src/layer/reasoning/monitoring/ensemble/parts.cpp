#include "layer/reasoning/monitoring/ensemble/parts.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace skein::monitoring {
namespace {

constexpr double kPlace = 20;  // [m]

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
void spread(const model::Grid& grid, std::vector<std::size_t> open,
            std::vector<std::uint8_t>& marked, const Together& together) {
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

}  // namespace

std::pair<int, int> Evidence::key(const Vec2& p) {
  return {static_cast<int>(std::floor(p.x() / kPlace)),
          static_cast<int>(std::floor(p.y() / kPlace))};
}

std::vector<Vec2> Evidence::points(bool inside) const {
  std::vector<Vec2> out;
  for (const auto& [x, y] : places_[inside ? 1 : 0])
    out.push_back(kPlace * Vec2(x + 0.5, y + 0.5));
  return out;
}

void drop_unseen_parts(const model::Grid& grid, const Evidence& evidence,
                       std::vector<double>& mean) {
  if (evidence.empty(true)) return;
  std::vector<std::uint8_t> seen(mean.size(), 0);
  std::vector<std::size_t> open;
  const auto start = [&](std::size_t i) {
    if (seen[i] != 0) return;
    seen[i] = 1;
    open.push_back(i);
  };
  for (const bool inside : {false, true})
    for (const Vec2& p : evidence.points(inside)) {
      const Vec2 at = (p - grid.low) / grid.cell;
      const long row = std::lround(at.x()), column = std::lround(at.y());
      if (row < 0 || column < 0 || row >= grid.rows || column >= grid.columns) continue;
      const std::size_t i = grid.index(static_cast<int>(row), static_cast<int>(column));
      if ((mean[i] < 0) == inside) start(i);
    }
  // What reaches the edge of the grid is no hole.
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c) {
      const bool edge = r == 0 || c == 0 || r + 1 == grid.rows || c + 1 == grid.columns;
      if (edge && mean[grid.index(r, c)] >= 0) start(grid.index(r, c));
    }
  const auto alike = [&](std::size_t i, std::size_t k) {
    return (mean[i] < 0) == (mean[k] < 0);
  };
  spread(grid, std::move(open), seen, alike);
  // Never everything: a fire that nobody has touched yet stays where the prior has it.
  bool fire_left = false;
  for (std::size_t i = 0; i < mean.size(); ++i)
    fire_left = fire_left || (seen[i] != 0 && mean[i] < 0);
  if (!fire_left) return;
  for (std::size_t i = 0; i < mean.size(); ++i)
    if (seen[i] == 0) mean[i] = -mean[i];
}

void drop_remnants(std::span<const double> mean, model::Field& phi) {
  // Only nodes that differ from the mean can belong to remnants; those that touch a node
  // of their own kind where the mean agrees do not, nor what hangs on them.
  std::vector<std::size_t> differing;
  std::vector<std::uint8_t> kept(phi.values.size(), 1);
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

}  // namespace skein::monitoring
