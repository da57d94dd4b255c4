// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/base/time.h"
#include "skein/data/perimeter/fire.h"
#include "skein/layer/reasoning/perimeter/ensemble/front_ensemble.h"

namespace skein::perimeter {

/// The zero contour of the members' mean distance, with what the members' spread says
/// about it. Parts and holes below `min_area` are left out, never the largest part.
BoundaryEstimate mean_boundary(const FrontEnsemble& ensemble, Time time,
                               const EnsembleOptions& options);

}  // namespace skein::perimeter
