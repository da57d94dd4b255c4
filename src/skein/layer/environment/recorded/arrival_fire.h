// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/environment/raster/grid_field.h"
#include "skein/layer/environment/recorded/cached_region.h"
#include "skein/role/phenomenon.h"

namespace skein::environment {

/// A recorded or computed fire given by the time at which it reaches each node of a grid.
class ArrivalFire final : public Phenomenon {
 public:
  /// @param arrival  [s]; infinity or NaN where the fire never comes.
  /// @param start    the recorded time at which the run starts [s].
  ArrivalFire(GridField arrival, double start);

  void advance(Time time) override;
  /// Bilinear; in a square with a node that never burns, as the node nearest to `p`.
  bool inside(const Vec2& p) const override;
  const geo::Region& region() const override;

  const GridField& arrival() const { return arrival_; }

 private:
  GridField arrival_;
  double start_, last_;
  Time now_;
  double level_;  // what arrived before this time burns
  CachedRegion region_;
};

}  // namespace skein::environment
