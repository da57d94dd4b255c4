// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <vector>

#include "skein/base/random.h"
#include "skein/model/levelset/field.h"
#include "skein/model/levelset/spline_field.h"

namespace skein::perimeter {

/// One front of an ensemble: where it is and how it moves.
struct Member {
  model::Field phi;         ///< signed distance [m], negative inside
  model::SplineField rate;  ///< local part of the rate [m/s]
  Eigen::Vector3d common = Eigen::Vector3d::Zero();  ///< rate, drift everywhere [m/s]
  RandomStream stream;

  double rate_at(const model::SplineStencil& place) const {
    return common[0] + rate.sample(place);
  }
  Vec2 drift() const { return common.tail<2>(); }
};

/// The coarse nodes of a spline over `grid`, `spacing_cells` of its cells apart.
model::Grid spline_nodes(const model::Grid& grid, int spacing_cells);

/// A smooth random field of mean 0 and standard deviation `sd`.
model::SplineField noise_field(RandomStream& stream, const model::Grid& nodes, double sd);

/// Rows and columns to add on each side; multiples of the spacing of the rate's nodes.
struct Growth {
  int south = 0, west = 0, north = 0, east = 0;
  bool any() const { return south + west + north + east > 0; }
};

/// Gives the member a larger grid; the local rate in the new part is drawn with
/// `rate_sd`.
void extend_member(Member& member, const Growth& growth, int rate_spacing_cells,
                   double rate_sd);

/// Doubles the spacing of the member's grid and of its rate's nodes, after adding what
/// that needs in the north and east.
void coarsen_member(Member& member, int rate_spacing_cells);

/// Gives the local rate further than `beyond` [m] ahead of the front the values that it
/// has at the front: a head that runs carries its rate with it, away from the places that
/// it was learned at.
void carry_rate_ahead(Member& member, double beyond);

/// Draws distances in to three standard deviations from the mean: a few members that have
/// run away weigh little in any regression, and nothing makes their far fronts come back.
/// The standard deviation is that of a Gaussian with the same mean absolute deviation.
void draw_in(std::vector<Member>& members);

}  // namespace skein::perimeter
