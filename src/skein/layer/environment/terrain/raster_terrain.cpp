#include "skein/layer/environment/terrain/raster_terrain.h"

#include <fmt/format.h>

#include <algorithm>

#include "skein/layer/environment/raster/raster_file.h"

namespace skein::environment {
namespace {

constexpr double kMaxNodes = 25e6;  // 200 MB
constexpr double kLowest = -500, kHighest = 9000;

}  // namespace

RasterTerrain::RasterTerrain(GridField field) : field_(std::move(field)) {
  const auto values = field_.values();
  highest_ = *std::max_element(values.begin(), values.end());
}

Result<std::unique_ptr<Terrain>> make_raster_terrain(const RasterTerrainOptions& options,
                                                     const geo::LocalFrame& frame) {
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
  const Vec2 corner(options.area, options.area);
  auto field =
      read_grid(options.file, options.band, options.band_name, frame,
                grid_covering(-corner, corner, spacing),
                options.outside == Outside::kError ? Missing::kError : Missing::kNearest);
  if (!field) return field.error();
  const auto values = field.value().values();
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (*low < kLowest || *high > kHighest)
    return error(
        fmt::format("holds values from {:.6g} to {:.6g}; elevations from {} to {} m "
                    "are allowed",
                    *low, *high, kLowest, kHighest),
        "is its \"no data\" value declared?");
  return std::unique_ptr<Terrain>(
      std::make_unique<RasterTerrain>(std::move(field).value()));
}

}  // namespace skein::environment
