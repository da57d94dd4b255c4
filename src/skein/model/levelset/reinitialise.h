// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/model/levelset/field.h"

namespace skein::model {

/// Makes `phi` (negative inside) a signed distance [m] to its own zero contour.
///
/// Nodes of squares that the contour cuts get their distance to the straight pieces that
/// linear interpolation gives, which holds the contour where it was to second order in
/// the cell; all others follow from |grad phi| = 1 by fast sweeping. A field without a
/// zero contour keeps its sign and is left as it is.
///
/// Cost: linear in the nodes: four sweeps.
/// Reference: [Zhao05] (2.2)-(2.4) for the sweeping; [Russo00] for why the cut squares
///            must be treated apart.
void reinitialise(Field& phi);

}  // namespace skein::model
