// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/layer/environment/raster/grid_field.h"
#include "skein/role/wind_field.h"

namespace skein::environment {

/// What the two rasters of a gridded wind hold.
enum class WindKind {
  kSpeedAndFrom,  ///< speed, and the direction it comes from [deg, clockwise]
  kComponents,    ///< velocity to east and to north
};

/// What the direction or the components of a gridded wind refer to.
enum class WindNorth {
  kAuto,  ///< as the file says; see docs/environment.md
  kTrue,  ///< the meridian
  kGrid,  ///< the raster's own second axis
};

struct GriddedWindOptions {
  std::string file;         ///< a raster: see RasterFile
  std::string second_file;  ///< of the second quantity; empty: the same file
  WindKind kind = WindKind::kSpeedAndFrom;
  std::string first;   ///< variable or band name: speed, or component to east
  std::string second;  ///< variable or band name: direction from, or component to north
  WindNorth north = WindNorth::kAuto;
  std::string
      start_utc;  ///< UTC of the run's start, ISO 8601; empty: the file's first time
  std::vector<double> times;  ///< of the bands since the run's start [s], for files that
                              ///< do not say it
  std::optional<double> height;  ///< use only the level nearest to this height [m]
  std::string unit;  ///< of speeds and components, whatever the file says; empty: as it
                     ///< says, and refused where it says none
  double ground_msl =
      0;  ///< above mean sea level, from where the levels' heights count [m]
  double area = 10000;  ///< half the side of the square about the origin [m]
  double spacing = 0;   ///< of the nodes kept in memory [m]; 0: a quarter of a pixel
  bool extend = false;  ///< beyond the data the nearest values go on; else: error
};

/// Wind on a grid in space, height and time.
///
/// Components are interpolated, never angles: bilinear in the plane (beyond the area its
/// edge holds), linear in height and time, held before the first and after the last.
class GriddedWind final : public WindField {
 public:
  /// Air velocity in N [m/s] at one time and level.
  struct Slice {
    GridField north, east;
  };
  /// @param times    grow strictly; at least one.
  /// @param heights  above mean sea level, grow strictly; at least one [m].
  /// @param slices   times.size() * heights.size(), index time * heights.size() + height.
  GriddedWind(std::vector<Time> times, std::vector<double> heights,
              std::vector<Slice> slices);

  Vec3 wind(const Vec3& p_N, Time time) const override;
  const std::vector<Time>& times() const { return times_; }
  const std::vector<double>& heights() const { return heights_; }

 private:
  std::vector<Time> times_;
  std::vector<double> heights_;
  std::vector<Slice> slices_;
};

/// Loads a gridded wind.
/// @param warnings  gets a line where all the file's times lie before or after the run's
///                  start.
/// Fails: kNotFound, kBadInput: what RasterFile and resample() refuse; a speed without a
///        unit or with one that is none, a direction other than in degrees; negative
///        speed, a speed above 150 m/s; two quantities that differ in grid, times or
///        levels; times missing; components on a projected grid of which nobody says
///        which north they refer to.
Result<std::unique_ptr<WindField>> make_gridded_wind(const GriddedWindOptions& options,
                                                     const geo::LocalFrame& frame,
                                                     std::vector<std::string>& warnings);

}  // namespace skein::environment
