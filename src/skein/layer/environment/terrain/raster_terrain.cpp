// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/terrain/raster_terrain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/geo/unit_words.h"
#include "skein/layer/environment/raster/raster_file.h"

namespace skein::environment {
namespace {

constexpr double kMaxNodes = 25e6;                   // 200 MB
constexpr double kLowest = -11500, kHighest = 9000;  // of the Earth [m]
constexpr double kLowestLand = -500;                 // [m]
// What programs write for "no data", and that may pass for an elevation.
constexpr double kNoElevation[] = {-9999, -32768, -32767, -99999, 32767};

// Metres in one unit of the elevations.
Result<double> unit_of(const RasterTerrainOptions& options, const RasterFile& file,
                       int band) {
  const auto error = [&](const std::string& message) {
    return Error{ErrorCode::kBadInput, options.file, message,
                 "give unit: m, ft or us-ft"};
  };
  if (!options.unit.empty()) {
    if (const auto unit = geo::length_unit(options.unit)) return *unit;
    return Error{ErrorCode::kBadInput, options.file,
                 fmt::format("unit \"{}\" is no unit of length", options.unit),
                 "for example m, ft or us-ft"};
  }
  const std::string& written = file.bands()[static_cast<std::size_t>(band) - 1].unit;
  const auto of_system = file.vertical_unit();
  if (of_system && *of_system < 0)
    return error("holds depths, which count downwards; elevations are allowed");
  if (written.empty()) return of_system.value_or(1);
  const auto of_band = geo::length_unit(written);
  if (!of_band) return error(fmt::format("has elevations in \"{}\"", written));
  constexpr double kSame = 1e-9;
  if (of_system && std::abs(*of_system - *of_band) > kSame)
    return error(
        fmt::format("has elevations in \"{}\", and a vertical reference system "
                    "whose unit is {:.7g} m",
                    written, *of_system));
  return *of_band;
}

// Refuses values that stand for "no data" and are not declared.
Result<void> check_declared(const RasterTerrainOptions& options,
                            const PixelWindow& pixels) {
  for (const double value : pixels.values)
    for (const double none : kNoElevation)
      if (value == none)
        return Error{ErrorCode::kBadInput, options.file,
                     fmt::format("holds the value {}, which is no elevation", none),
                     "is its \"no data\" value declared?"};
  return {};
}

// Elevations in metres, with the sea's surface for its floor.
Result<GridField> in_metres(const RasterTerrainOptions& options, const GridField& field,
                            double unit, std::vector<std::string>& warnings) {
  std::vector<double> values(field.values().begin(), field.values().end());
  for (double& value : values) value *= unit;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*low < kLowest || *high > kHighest)
    return Error{
        ErrorCode::kBadInput, options.file,
        fmt::format("holds values from {:.6g} to {:.6g} m; elevations from {} to {} m "
                    "are allowed",
                    *low, *high, kLowest, kHighest),
        "is its \"no data\" value declared?"};
  if (*low < kLowestLand) {
    warnings.push_back(
        fmt::format("{}: reaches down to {:.0f} m, a sea floor: what lies below 0 m "
                    "counts as the sea's surface",
                    options.file, *low));
    for (double& value : values) value = std::max(value, 0.0);
  }
  return GridField(field.shape(), std::move(values));
}

}  // namespace

RasterTerrain::RasterTerrain(GridField field) : field_(std::move(field)) {
  const auto values = field_.values();
  highest_ = *std::max_element(values.begin(), values.end());
}

Result<std::unique_ptr<Terrain>> make_raster_terrain(const RasterTerrainOptions& options,
                                                     const geo::LocalFrame& frame,
                                                     std::vector<std::string>& warnings) {
  const auto error = [&](const std::string& message, const std::string& hint = "") {
    return Error{ErrorCode::kBadInput, options.file, message, hint};
  };
  if (!(options.area > 0 && options.area <= 200e3))
    return error(
        fmt::format("area {} m: above 0 and up to 200 km is allowed", options.area));
  if (!(options.spacing >= 0))
    return error(fmt::format("spacing {} m must not be below 0", options.spacing));
  auto file = RasterFile::open(options.file);
  if (!file) return file.error();
  double spacing = options.spacing;
  if (spacing == 0) {
    const auto pixel = file.value().pixel_size(frame);
    if (!pixel) return pixel.error();
    spacing = std::clamp(pixel.value(), 1.0, options.area);
  }
  spacing = std::min(spacing, 2 * options.area);
  const double side = 2 * options.area / spacing + 1;
  if (side * side > kMaxNodes)
    return error(
        fmt::format("an area of {} m at a spacing of {:.3g} m has {:.0f} points; at "
                    "most {:.0f} are allowed",
                    options.area, spacing, side * side, kMaxNodes),
        "use a smaller area or a larger spacing");
  const auto band = file.value().find_band(options.band, options.band_name);
  if (!band) return band.error();
  const auto unit = unit_of(options, file.value(), band.value());
  if (!unit) return unit.error();
  const Vec2 corner(options.area, options.area);
  const auto map = file.value().map(frame, grid_covering(-corner, corner, spacing));
  if (!map) return map.error();
  const auto pixels = file.value().read(band.value(), map.value().window());
  if (!pixels) return pixels.error();
  if (auto good = check_declared(options, pixels.value()); !good) return good.error();
  const auto field =
      resample(pixels.value(), map.value(),
               options.outside == Outside::kError ? Missing::kError : Missing::kNearest,
               options.file);
  if (!field) return field.error();
  auto elevations = in_metres(options, field.value(), unit.value(), warnings);
  if (!elevations) return elevations.error();
  return std::unique_ptr<Terrain>(
      std::make_unique<RasterTerrain>(std::move(elevations).value()));
}

}  // namespace skein::environment
