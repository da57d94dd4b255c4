// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/raster_file.h"

#include <fmt/format.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <cmath>

#include "skein/geo/gdal/gdal_guard.h"
#include "skein/layer/environment/raster/raster_service.h"

namespace skein::environment {
namespace {

constexpr double kLargestWindow = 100e6;  // pixels

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

// Whether the columns of a raster in degrees cover all longitudes once.
bool goes_around(const Georeference& place) {
  const double width = std::abs(place.geo[1]);
  return place.geo[2] == 0 && place.geo[4] == 0 &&
         std::abs(width * place.columns - 360) < width / 2;
}

// The unit and sense of heights.
void read_vertical(OGRSpatialReferenceH system, Georeference& place) {
  if (OSRIsCompound(system) == 0 && OSRIsVertical(system) == 0) return;
  place.vertical_unit = OSRGetTargetLinearUnits(system, "VERT_CS", nullptr);
  OGRAxisOrientation sense = OAO_Other;
  OSRGetAxis(system, "VERT_CS", 0, &sense);
  place.depths = sense == OAO_Down;
}

}  // namespace

struct RasterFile::Handles {
  explicit Handles(RasterService opened) : service(std::move(opened)) {}

  RasterService service;
  Georeference place;
};

RasterFile::RasterFile(std::string path, std::unique_ptr<Handles> handles)
    : path_(std::move(path)), handles_(std::move(handles)) {}
RasterFile::RasterFile(RasterFile&&) noexcept = default;
RasterFile& RasterFile::operator=(RasterFile&&) noexcept = default;
RasterFile::~RasterFile() = default;

Error RasterFile::error(const std::string& message, const std::string& hint) const {
  return {ErrorCode::kBadInput, path_, message, hint};
}

Result<RasterFile> RasterFile::open(const std::string& path,
                                    const std::string& variable) {
  auto service = RasterService::start(path, variable);
  if (!service) return service.error();
  RasterFile file(path, std::make_unique<Handles>(std::move(service).value()));
  if (auto good = file.georeference(); !good) return good.error();
  return file;
}

const std::vector<BandInfo>& RasterFile::bands() const {
  return handles_->service.facts().bands;
}

Result<void> RasterFile::georeference() {
  const geo::GdalGuard guard;
  const RasterFacts& facts = handles_->service.facts();
  Georeference& place = handles_->place;
  place.columns = facts.columns;
  place.rows = facts.rows;
  place.geo = facts.geo;
  if (GDALInvGeoTransform(place.geo.data(), place.inverse.data()) == 0)
    return error("has pixels of no size");
  OGRSpatialReferenceH system = OSRNewSpatialReference(facts.system.c_str());
  if (system != nullptr) {
    place.geographic = OSRIsGeographic(system) != 0;
    place.around = place.geographic && goes_around(place);
    read_vertical(system, place);
    place.to_raster = geo::transform_from_degrees(system);
    place.from_raster = geo::transform_to_degrees(system);
    OSRDestroySpatialReference(system);
  }
  if (!place.to_raster || !place.from_raster)
    return error("has a coordinate reference system that cannot be used: " +
                 guard.failure());
  return {};
}

int RasterFile::columns() const {
  return handles_->place.columns;
}
int RasterFile::rows() const {
  return handles_->place.rows;
}
bool RasterFile::geographic() const {
  return handles_->place.geographic;
}

std::optional<double> RasterFile::vertical_unit() const {
  const Georeference& place = handles_->place;
  if (place.vertical_unit == 0) return std::nullopt;
  return place.depths ? -place.vertical_unit : place.vertical_unit;
}

Result<int> RasterFile::find_band(int number, const std::string& name) const {
  const int count = static_cast<int>(bands().size());
  if (name.empty()) {
    if (number >= 1 && number <= count) return number;
    return Error{ErrorCode::kNotFound, path_, fmt::format("has no band {}", number),
                 fmt::format("1 to {} are allowed", count)};
  }
  std::vector<std::string> names;
  int found = 0, matches = 0;
  for (const BandInfo& band : bands()) {
    names.push_back(band.name);
    if (band.name != name) continue;
    found = band.number;
    ++matches;
  }
  if (matches == 1) return found;
  return Error{ErrorCode::kNotFound, path_,
               matches == 0 ? fmt::format("has no band named \"{}\"", name)
                            : fmt::format("has {} bands named \"{}\"", matches, name),
               "its bands: " + joined(names)};
}

Result<geo::Geodetic> RasterFile::geodetic(const Vec2& pixel) const {
  const geo::GdalGuard guard;
  const Vec2 there = affine(handles_->place.geo, pixel);
  double x = there.x(), y = there.y();
  int good = 0;
  OCTTransformEx(
      static_cast<OGRCoordinateTransformationH>(handles_->place.from_raster.get()), 1, &x,
      &y, nullptr, &good);
  if (good == 0 || !std::isfinite(x) || !std::isfinite(y) || std::abs(y) > 90)
    return error(fmt::format("pixel {:.1f}, {:.1f} has no latitude and longitude: {}",
                             pixel.x(), pixel.y(), guard.failure()));
  return geo::Geodetic{y, x, 0};
}

Result<double> RasterFile::pixel_size(const geo::LocalFrame& frame) const {
  const GridShape around{Vec2(-50, -50), 100, 2, 2};
  const auto map_result = map(frame, around);
  if (!map_result) return map_result.error();
  const PixelMap& m = map_result.value();
  const double per_north = (m.pixel(1, 0) - m.pixel(0, 0)).norm();
  const double per_east = (m.pixel(0, 1) - m.pixel(0, 0)).norm();
  const double max = std::max(per_north, per_east);
  if (!(max > 0)) return error("has pixels of no size at the origin");
  return 100 / max;
}

Result<PixelMap> RasterFile::map(const geo::LocalFrame& frame,
                                 const GridShape& shape) const {
  return map_pixels(handles_->place, frame, shape, path_);
}

Result<PixelWindow> RasterFile::read(int band, const PixelWindow& window) const {
  if (band < 1 || band > static_cast<int>(bands().size()))
    return error(fmt::format("has no band {}", band));
  if (window.columns <= 0 || window.rows <= 0) return window;
  const double count = static_cast<double>(window.columns) * window.rows;
  if (count > kLargestWindow)
    return error(fmt::format("the area has {:.0f} pixels; at most {:.0f} are allowed",
                             count, kLargestWindow),
                 "use a smaller area or a coarser raster");
  if (window.first_column < 0 || window.first_column + window.columns > columns())
    return read_around(band, window);
  return handles_->service.read(band, window);
}

// In parts that lie within the raster, side by side.
Result<PixelWindow> RasterFile::read_around(int band, const PixelWindow& window) const {
  PixelWindow whole = window;
  whole.values.resize(static_cast<std::size_t>(window.columns) *
                      static_cast<std::size_t>(window.rows));
  for (int done = 0; done < window.columns;) {
    PixelWindow part = window;
    part.first_column = around(window.first_column + done, columns());
    part.columns = std::min(window.columns - done, columns() - part.first_column);
    const auto pixels = handles_->service.read(band, part);
    if (!pixels) return pixels.error();
    auto from = pixels.value().values.begin();
    for (int r = 0; r < window.rows; ++r, from += part.columns)
      std::copy_n(
          from, part.columns,
          whole.values.begin() + static_cast<std::ptrdiff_t>(r) * window.columns + done);
    done += part.columns;
  }
  return whole;
}

Result<GridField> read_grid(const std::string& path, int band, const std::string& name,
                            const geo::LocalFrame& frame, const GridShape& shape,
                            Missing missing) {
  auto file = RasterFile::open(path);
  if (!file) return file.error();
  const auto number = file.value().find_band(band, name);
  if (!number) return number.error();
  const auto map = file.value().map(frame, shape);
  if (!map) return map.error();
  const auto pixels = file.value().read(number.value(), map.value().window());
  if (!pixels) return pixels.error();
  return resample(pixels.value(), map.value(), missing, path);
}

}  // namespace skein::environment
