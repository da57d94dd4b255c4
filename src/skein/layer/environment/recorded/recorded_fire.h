// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/layer/environment/recorded/perimeter_file.h"
#include "skein/layer/environment/recorded/perimeter_repair.h"
#include "skein/role/phenomenon.h"

namespace skein::environment {

enum class RecordedKind {
  kAuto,        ///< a raster is an arrival time, anything else perimeters
  kPerimeters,  ///< dated perimeters
  kArrival,     ///< raster of arrival times
};

struct RecordedFireOptions {
  std::string path;  ///< see read_perimeters(), or an arrival-time raster
  RecordedKind kind = RecordedKind::kAuto;
  PerimeterFileOptions file;  ///< what it does not say of itself
  double start = 0;           ///< the run starts this long after the first perimeter (or
                              ///< after the raster's time 0) [s]
  double spacing = 0;         ///< of the grid in memory [m]; 0: about 200,000 nodes, no
                              ///< finer than 5 m
  RepairOptions repair;       ///< what to do with invalid perimeters
  int arrival_band = 1;       ///< band of the arrival-time raster
  /// Of the raster's times [s]: 1, 60 or 3600; none: as the file says, 1 with a warning
  /// where it says none.
  std::optional<double> arrival_unit = {};
};

/// A recorded fire as truth, from dated perimeters or an arrival-time raster.
/// @param warnings  gets one line for each repair.
/// Fails: kNotFound, kBadInput: as read_perimeters(), growing_series() and read_grid();
///        also for options out of range, such as a start after the last perimeter.
Result<std::unique_ptr<Phenomenon>> make_recorded_fire(
    const RecordedFireOptions& options, const geo::LocalFrame& frame,
    std::vector<std::string>& warnings);

/// What is known of a recorded fire before a scenario has an origin.
struct RecordedFireSummary {
  geo::Geodetic origin;  ///< centroid of the first perimeter (earliest pixel), height 0
  double duration = 0;   ///< from options.start to the last perimeter [s]
  std::optional<double> start_utc;       ///< of the run's start, [s] since 1970, if known
  int perimeters = 0;                    ///< used; 0 for an arrival-time raster
  double first_area = 0, last_area = 0;  ///< burnt at the first and last time [m^2]
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();  ///< corners of the last region about the
                                                 ///< origin [m]
  std::vector<Perimeter>
      series;  ///< the perimeters used, about the origin; none of a raster
};

/// Proposes the local frame's origin, the run's duration and the extent.
/// @param warnings  as of make_recorded_fire().
/// Fails: as make_recorded_fire().
Result<RecordedFireSummary> summarise_recorded_fire(const RecordedFireOptions& options,
                                                    std::vector<std::string>& warnings);

}  // namespace skein::environment
