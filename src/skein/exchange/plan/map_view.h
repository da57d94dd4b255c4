// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/exchange/table/document.h"
#include "skein/geo/vec.h"

namespace skein::exchange {

/// How a part of the plane lies on a picture, north up.
struct MapView {
  Vec2 north_west = Vec2::Zero();  ///< of the picture [m]
  double metres_per_px = 1;
  double width = 0, height = 0;  ///< [px]

  /// Pixels from the left and from the top.
  Vec2 px(const Vec2& p) const {
    return {(p.y() - north_west.y()) / metres_per_px,
            (north_west.x() - p.x()) / metres_per_px};
  }
};

/// The view that shows all of a document's flights, marks and shapes and the zones near
/// them.
/// @param width   [px]
/// @param tallest height [px]; the picture is narrower in what it shows, never squeezed.
MapView view_of(const Document& document, double width, double tallest);

}  // namespace skein::exchange
