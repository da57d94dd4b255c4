// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/exchange/plan/map_view.h"
#include "skein/exchange/table/document.h"

namespace skein::exchange {

/// The parts of a picture of plans, as SVG elements in pixels.

/// All that lies on the map. Elements of class "fixed" are meant to keep their size when
/// the map is enlarged; their transform is a translation only.
std::string map_layer(const Document& document, const MapView& view);

/// Lines of round coordinates with their metres at the rim.
std::string grid_layer(const MapView& view);

/// A bar of a round length, 14 px high, its left end at the origin.
std::string scale_bar(const MapView& view);

/// An arrow to where the wind blows, with its speed, in 110 x 44 px; empty without plans.
std::string wind_arrow(const Document& document);

/// What the signs mean, in rows of `width` px from the origin on.
/// @returns the elements, and their height [px].
std::pair<std::string, double> legend(const Document& document, double width);

/// The colour of plan number `index`.
const char* colour_of(std::size_t index);

/// The style sheet of all of them.
std::string picture_style();

}  // namespace skein::exchange
