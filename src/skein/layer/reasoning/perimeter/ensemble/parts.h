// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "skein/model/levelset/field.h"

namespace skein::perimeter {

/// Where fire and where none has been seen, to 20 m.
///
/// Grows with the ground that was seen: eight bytes for each place. Copies share all but
/// the last few hundred places, so that a belief may keep many.
class Evidence {
 public:
  void add(const Vec2& p, bool inside);
  bool empty(bool inside) const { return size(inside) == 0; }
  std::size_t size(bool inside) const;
  /// The middles of the places, in a defined order.
  std::vector<Vec2> points(bool inside) const;

 private:
  using Place = std::pair<int, int>;
  struct Side {
    std::shared_ptr<const std::vector<Place>> settled;  // in order; null: none
    std::set<Place> fresh;                              // that are not among them
  };
  static Place key(const Vec2& p);
  static std::vector<Place> all(const Side& side);
  Side sides_[2];
};

/// Nodes of parts of `mean` (negative inside) that nobody has ever seen, once fire has
/// been seen at all: holes without a place without fire, and parts without a place of
/// fire. A part counts for itself when only a neck of less than about 50 m joins it to
/// others. The prior knows one fire; what an edge that was seen has cut off from it, on
/// either side, is not there. A part larger than all that has been seen stays: a first
/// glimpse of an edge says little about the body behind it.
std::vector<std::size_t> unseen_nodes(const model::Grid& grid, const Evidence& evidence,
                                      std::span<const double> mean);

/// Changes the sign of parts and holes of one member's distance that have nothing in
/// common with the mean: remnants of updates that moved its boundary past them. Nobody
/// would ever correct them.
void drop_remnants(std::span<const double> mean, model::Field& phi);

}  // namespace skein::perimeter
