// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "skein/base/result.h"
#include "skein/data/vehicle/flight_plan.h"
#include "skein/geo/local_frame.h"

namespace skein::exchange {

/// The flight of a file as `skein plan ... --out` writes it, element by element: GeoJSON
/// (.geojson, .json) or CSV (.csv). Of several flights in one file the first.
///
/// Places are taken by latitude and longitude; a CSV without them by metres of the local
/// frame.
/// Fails: kNotFound, kUnavailable for a file that is not there or cannot be read;
///        kBadInput for another ending, and for what is no such plan.
Result<FlightPlan> read_plan(const std::filesystem::path& file,
                             const geo::LocalFrame& frame);

/// The same from text.
/// @param place  of the text, for messages.
Result<FlightPlan> plan_from_geojson(std::string_view text, const std::string& place,
                                     const geo::LocalFrame& frame);
Result<FlightPlan> plan_from_csv(std::string_view text, const std::string& place,
                                 const geo::LocalFrame& frame);

}  // namespace skein::exchange
