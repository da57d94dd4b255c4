// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/geo/polygon.h"

namespace skein::model {

/// Edges of a front are kept between these multiples of its spacing.
inline constexpr double kShortestEdge = 0.5;
inline constexpr double kLongestEdge = 1.4;

/// Adds and removes markers so that neighbours stand about `spacing` [m] apart: edges end
/// up below 1.4 times the spacing and, as a rule, above 0.5 times.
///
/// A new marker in the middle of an edge is set out from the chord by the height of the
/// arc that the neighbouring turns suggest, or not at all where these turn opposite ways,
/// so that smooth arcs keep their area. Of two markers that stand too close, the one that
/// matters less to the shape goes.
///
/// @param ring     at least 3 points.
/// @param scratch  overwritten; takes the old ring's storage.
void respace(geo::Ring& ring, double spacing, geo::Ring& scratch);

}  // namespace skein::model
