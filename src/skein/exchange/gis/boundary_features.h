// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>

#include "skein/base/time.h"
#include "skein/data/perimeter/fire.h"
#include "skein/exchange/gis/gis_writing.h"

namespace skein::exchange {

/// A place in the area burns with this probability or more: the believed boundary, moved
/// outward by so many standard deviations.
struct BoundaryLevel {
  double probability = 0.5;
  double deviations = 0;
};
/// The boundary itself; with its bands; with what a forecast is given.
std::span<const BoundaryLevel> boundary_level();
std::span<const BoundaryLevel> band_levels();
std::span<const BoundaryLevel> prediction_levels();

/// A believed boundary, now or at a time ahead.
struct BelievedBoundary {
  std::string mission;  ///< whose belief it is
  BoundaryEstimate boundary;
  std::optional<Time> made = std::nullopt;  ///< of a forecast
};

/// The area within a level of a boundary: fields mission, time_utc, time_s, made_utc,
/// ahead_min, prob, area_ha, sigma_m.
/// @param utc  a time of the run as text.
GisFeature boundary_feature(const BelievedBoundary& belief, const BoundaryLevel& level,
                            const std::function<std::string(Time)>& utc);

}  // namespace skein::exchange
