// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/layer/environment/raster/grid_field.h"
#include "skein/layer/environment/recorded/cached_region.h"
#include "skein/layer/environment/recorded/perimeter.h"
#include "skein/role/phenomenon.h"

namespace skein::environment {

/// A recorded fire between its dated perimeters.
///
/// A point between perimeters k and k+1 is reached at
///
///   t = t_k + (t_{k+1} - t_k) d_k / (d_k + d_{k+1})
///
/// with its distances d to the two boundaries. The burnt region at time t is therefore
/// where (1 - a) s_k + a s_{k+1} < 0, with the signed distances s (negative inside) and
/// a = (t - t_k) / (t_{k+1} - t_k): the form computed with here, because it is smooth
/// where the two boundaries coincide and the arrival time jumps. Each signed distance is
/// kept on a grid, so the region meets every perimeter to a small part of the spacing.
///
/// Before the first perimeter's time its region burns; after the last one's, nothing
/// moves.
class PerimeterFire final : public Phenomenon {
 public:
  /// @param series  at least one, times growing from 0, each region containing the one
  ///                before (Bug otherwise); see growing_series().
  /// @param start   the recorded time at which the run starts [s].
  PerimeterFire(const std::vector<Perimeter>& series, const GridShape& shape,
                double start);

  void advance(Time time) override;
  bool inside(const Vec2& p) const override;
  const geo::Region& region() const override;

  /// The recorded time at which the fire reaches `p` [s]: 0 within the first perimeter,
  /// infinity where it never does.
  double arrival_time(const Vec2& p) const;
  const GridShape& shape() const { return distances_.front().shape(); }

 private:
  struct Moment {
    std::size_t before = 0, after = 0;  // perimeters around the time
    double part = 0;                    // of the interval from one to the other
  };

  std::vector<double> times_;
  std::vector<GridField> distances_;
  double start_;
  Time now_;
  Moment moment_;
  CachedRegion region_;
};

}  // namespace skein::environment
