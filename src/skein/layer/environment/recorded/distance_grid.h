// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/geo/polygon.h"
#include "skein/layer/environment/raster/grid_field.h"

namespace skein::environment {

/// Distance [m] from every node of a grid to the boundary of a region, negative inside.
///
/// Exact near the boundary; further out the nearest edge is handed on from node to node
/// (vector propagation after Danielsson), which errs by a small part of a spacing at
/// worst and never in sign. Fails: Bug when the region is empty. Cost:  linear in nodes
/// and in the boundary's length over the spacing. Reference: [Danielsson80].
GridField signed_distance(const geo::Region& region, const GridShape& shape);

}  // namespace skein::environment
