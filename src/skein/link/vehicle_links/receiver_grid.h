// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "skein/geo/vec.h"

namespace skein::vehicle_links {

/// Who is near a place on the map, without a look at everybody: places are kept in square
/// cells, and who is within a cell's side of a place is in one of nine of them.
class ReceiverGrid {
 public:
  /// @param side  of a cell [m], above 0; rule: the largest distance asked for.
  explicit ReceiverGrid(double side) : side_(side) {}

  /// Puts it there, or moves it. The place is finite.
  void put(std::uint32_t who, const Vec2& p) {
    if (who >= cell_of_.size()) cell_of_.resize(who + 1, kNowhere);
    const std::int64_t cell = cell_at(index(p.x()), index(p.y()));
    if (cell_of_[who] == cell) return;
    remove(who);
    cells_[cell].push_back(who);
    cell_of_[who] = cell;
  }
  void remove(std::uint32_t who) {
    if (who >= cell_of_.size() || cell_of_[who] == kNowhere) return;
    const auto cell = cells_.find(cell_of_[who]);
    std::erase(cell->second, who);
    if (cell->second.empty()) cells_.erase(cell);
    cell_of_[who] = kNowhere;
  }

  /// Calls visit(who) for all that are within a cell's side of the place, and some
  /// others.
  template <class Visit>
  void visit_near(const Vec2& p, Visit visit) const {
    const std::int64_t row = index(p.x()), column = index(p.y());
    for (std::int64_t i = row - 1; i <= row + 1; ++i)
      for (std::int64_t k = column - 1; k <= column + 1; ++k) {
        const auto cell = cells_.find(cell_at(i, k));
        if (cell == cells_.end()) continue;
        for (const std::uint32_t who : cell->second) visit(who);
      }
  }

 private:
  static constexpr std::int64_t kHalf = std::int64_t{1} << 30;
  static constexpr std::int64_t kNowhere = -1;

  // Cells that are too far away to be numbered are one.
  std::int64_t index(double x) const {
    return static_cast<std::int64_t>(
        std::fmin(std::fmax(std::floor(x / side_), -1e9), 1e9));
  }
  static std::int64_t cell_at(std::int64_t row, std::int64_t column) {
    return ((row + kHalf) << 31) + (column + kHalf);
  }

  double side_;
  std::unordered_map<std::int64_t, std::vector<std::uint32_t>> cells_;
  std::vector<std::int64_t> cell_of_;  // of each
};

}  // namespace skein::vehicle_links
