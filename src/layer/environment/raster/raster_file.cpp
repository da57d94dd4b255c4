#include "layer/environment/raster/raster_file.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "layer/environment/raster/band_info.h"
#include "layer/environment/raster/gdal_guard.h"

namespace skein::environment {
namespace {

constexpr double kKnotSpacing = 250;      // [m]
constexpr double kLargestWindow = 100e6;  // pixels

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
struct DestroyReference {
  void operator()(void* reference) const {
    OSRDestroySpatialReference(static_cast<OGRSpatialReferenceH>(reference));
  }
};
struct DestroyTransform {
  void operator()(void* transform) const {
    OCTDestroyCoordinateTransformation(
        static_cast<OGRCoordinateTransformationH>(transform));
  }
};
using Dataset = std::unique_ptr<void, CloseDataset>;
using Reference = std::unique_ptr<void, DestroyReference>;
using Transform = std::unique_ptr<void, DestroyTransform>;

Dataset open_dataset(const std::string& name) {
  return Dataset(GDALOpenEx(name.c_str(),
                            GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                            nullptr, nullptr, nullptr));
}

struct Subdataset {
  std::string name;      // for GDALOpen
  std::string variable;  // its last part
};

std::vector<Subdataset> subdatasets(GDALDatasetH dataset) {
  std::vector<Subdataset> found;
  char** list = GDALGetMetadata(dataset, "SUBDATASETS");
  for (int i = 1;; ++i) {
    const char* name =
        CSLFetchNameValue(list, fmt::format("SUBDATASET_{}_NAME", i).c_str());
    if (name == nullptr) return found;
    const std::string text = name;
    found.push_back({text, text.substr(text.find_last_of(":/") + 1)});
  }
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

}  // namespace

struct RasterFile::Handles {
  Dataset dataset;
  Transform to_raster;  // WGS 84 degrees (x = longitude) to the raster's system
  Transform from_raster;
  std::array<double, 6> geo{};  // pixel to raster's system
  std::array<double, 6> inverse{};
};

RasterFile::RasterFile(std::string path, std::unique_ptr<Handles> handles)
    : path_(std::move(path)), handles_(std::move(handles)) {}
RasterFile::RasterFile(RasterFile&&) noexcept = default;
RasterFile& RasterFile::operator=(RasterFile&&) noexcept = default;
RasterFile::~RasterFile() = default;

Error RasterFile::fault(const std::string& message, const std::string& hint) const {
  return {ErrorCode::kBadInput, path_, message, hint};
}

Result<RasterFile> RasterFile::open(const std::string& path,
                                    const std::string& variable) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    return Error{ErrorCode::kNotFound, path, "there is no such file", ""};
  if (!std::filesystem::is_regular_file(path, ignored))
    return Error{ErrorCode::kBadInput, path, "is not a file but a folder or device",
                 "give one raster file"};
  const GdalGuard guard;
  auto handles = std::make_unique<Handles>();
  handles->dataset = open_dataset(path);
  if (!handles->dataset)
    return Error{ErrorCode::kBadInput, path,
                 "cannot be read as a raster: " + guard.failure(),
                 "any raster that GDAL reads is allowed"};

  const auto parts = subdatasets(handles->dataset.get());
  if (!parts.empty() &&
      (!variable.empty() || GDALGetRasterCount(handles->dataset.get()) == 0)) {
    std::vector<std::string> names;
    const Subdataset* chosen = nullptr;
    for (const Subdataset& part : parts) {
      names.push_back(part.variable);
      if (part.variable == variable) chosen = &part;
    }
    if (chosen == nullptr)
      return Error{ErrorCode::kNotFound, path,
                   variable.empty() ? "has several variables and none was chosen"
                                    : fmt::format("has no variable \"{}\"", variable),
                   "it has: " + joined(names)};
    handles->dataset = open_dataset(chosen->name);
    if (!handles->dataset)
      return Error{
          ErrorCode::kBadInput, path,
          fmt::format("variable \"{}\" cannot be read: {}", variable, guard.failure()),
          ""};
  }

  RasterFile file(path, std::move(handles));
  Handles& h = *file.handles_;
  file.columns_ = GDALGetRasterXSize(h.dataset.get());
  file.rows_ = GDALGetRasterYSize(h.dataset.get());
  if (GDALGetRasterCount(h.dataset.get()) < 1) return file.fault("has no raster band");
  if (GDALGetGeoTransform(h.dataset.get(), h.geo.data()) != CE_None ||
      GDALInvGeoTransform(h.geo.data(), h.inverse.data()) == 0)
    return file.fault("has no georeference: nothing says where its pixels lie",
                      "an affine transform (world file, GeoTIFF tags...) is needed");
  OGRSpatialReferenceH own = GDALGetSpatialRef(h.dataset.get());
  if (own == nullptr)
    return file.fault("has no coordinate reference system",
                      "assign one, for example with gdal_translate -a_srs");
  const Reference system(OSRClone(own));
  const Reference wgs84(OSRNewSpatialReference(nullptr));
  OSRSetWellKnownGeogCS(static_cast<OGRSpatialReferenceH>(wgs84.get()), "WGS84");
  for (const Reference* r : {&system, &wgs84})
    OSRSetAxisMappingStrategy(static_cast<OGRSpatialReferenceH>(r->get()),
                              OAMS_TRADITIONAL_GIS_ORDER);
  file.geographic_ =
      OSRIsGeographic(static_cast<OGRSpatialReferenceH>(system.get())) != 0;
  h.to_raster.reset(OCTNewCoordinateTransformation(wgs84.get(), system.get()));
  h.from_raster.reset(OCTNewCoordinateTransformation(system.get(), wgs84.get()));
  if (!h.to_raster || !h.from_raster)
    return file.fault("has a coordinate reference system that cannot be used: " +
                      guard.failure());
  file.describe_bands();
  return file;
}

void RasterFile::describe_bands() {
  for (int i = 1; i <= GDALGetRasterCount(handles_->dataset.get()); ++i)
    bands_.push_back(describe_band(handles_->dataset.get(), i));
}

Result<int> RasterFile::find_band(int number, const std::string& name) const {
  const int count = static_cast<int>(bands_.size());
  if (name.empty()) {
    if (number >= 1 && number <= count) return number;
    return Error{ErrorCode::kNotFound, path_, fmt::format("has no band {}", number),
                 fmt::format("1 to {} are allowed", count)};
  }
  std::vector<std::string> names;
  int found = 0, matches = 0;
  for (const BandInfo& band : bands_) {
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
  const GdalGuard guard;
  double x = 0, y = 0;
  GDALApplyGeoTransform(handles_->geo.data(), pixel.x(), pixel.y(), &x, &y);
  int good = 0;
  OCTTransformEx(handles_->from_raster.get(), 1, &x, &y, nullptr, &good);
  if (good == 0 || !std::isfinite(x) || !std::isfinite(y) || std::abs(y) > 90)
    return fault(fmt::format("pixel {:.1f}, {:.1f} has no latitude and longitude: {}",
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
  const double most = std::max(per_north, per_east);
  if (!(most > 0)) return fault("has pixels of no size at the origin");
  return 100 / most;
}

Result<PixelMap> RasterFile::map(const geo::LocalFrame& frame,
                                 const GridShape& shape) const {
  const GdalGuard guard;
  PixelMap map;
  map.shape_ = shape;
  map.raster_columns_ = columns_;
  map.raster_rows_ = rows_;
  map.step_ = std::max(1, static_cast<int>(kKnotSpacing / shape.spacing));
  const int knot_rows = (shape.rows - 2) / map.step_ + 2;
  map.knot_columns_ = (shape.columns - 2) / map.step_ + 2;

  // Three points per knot: itself, a point towards true north, and later one towards grid
  // north from the inverse direction.
  std::vector<double> x, y;
  std::vector<Vec2> places;
  for (int r = 0; r < knot_rows; ++r)
    for (int c = 0; c < map.knot_columns_; ++c) {
      const Vec2 p = shape.node(r * map.step_, c * map.step_);
      const geo::Geodetic g = frame.from_plane(p);
      places.push_back(p);
      x.push_back(g.longitude_deg);
      y.push_back(g.latitude_deg);
      // Towards the equator near a pole, so as not to step over it.
      const double sign = g.latitude_deg < 89 ? 1 : -1;
      const Vec2 along = frame.to_plane(g.latitude_deg + sign * 1e-3, g.longitude_deg) -
                         frame.to_plane(g.latitude_deg, g.longitude_deg);
      map.knots_.push_back({Vec2::Zero(), Vec2::UnitX(), sign * along.normalized()});
    }
  std::vector<int> good(x.size(), 0);
  OCTTransformEx(handles_->to_raster.get(), static_cast<int>(x.size()), x.data(),
                 y.data(), nullptr, good.data());
  for (std::size_t i = 0; i < x.size(); ++i)
    if (good[i] == 0 || !std::isfinite(x[i]) || !std::isfinite(y[i]))
      return fault(
          fmt::format("its coordinate system does not reach the area (north {:.0f} "
                      "m, east {:.0f} m): {}",
                      places[i].x(), places[i].y(), guard.failure()));
  if (geographic_) {
    // Longitudes of some rasters run from 0 to 360: whole turns are added to fit.
    const double middle = handles_->geo[0] + handles_->geo[1] * columns_ / 2;
    const double reference = x[x.size() / 2];
    const double turns = std::round((middle - reference) / 360) * 360;
    for (double& longitude : x)
      longitude += std::round((reference - longitude) / 360) * 360 + turns;
  }
  for (std::size_t i = 0; i < x.size(); ++i)
    GDALApplyGeoTransform(handles_->inverse.data(), x[i], y[i], &map.knots_[i].pixel.x(),
                          &map.knots_[i].pixel.y());

  // Grid north is where the raster's second coordinate grows: from the change of raster
  // coordinates with the place (rows of J), solve J * d = (0, 1).
  const auto knot = [&](int r, int c) {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(map.knot_columns_) +
           static_cast<std::size_t>(c);
  };
  for (int r = 0; r < knot_rows; ++r)
    for (int c = 0; c < map.knot_columns_; ++c) {
      const int r0 = std::min(r, knot_rows - 2), c0 = std::min(c, map.knot_columns_ - 2);
      const std::size_t k = knot(r0, c0), kn = knot(r0 + 1, c0), ke = knot(r0, c0 + 1);
      const Vec2 by_north(x[kn] - x[k], y[kn] - y[k]);
      const Vec2 by_east(x[ke] - x[k], y[ke] - y[k]);
      const double det = by_north.x() * by_east.y() - by_north.y() * by_east.x();
      const Vec2 direction(-by_east.x() / det, by_north.x() / det);
      if (direction.allFinite() && direction.norm() > 0)
        map.knots_[knot(r, c)].grid_north = direction.normalized();
    }

  Vec2 low = map.pixel(0, 0), high = low;
  const auto widen = [&](int r, int c) {
    low = low.cwiseMin(map.pixel(r, c));
    high = high.cwiseMax(map.pixel(r, c));
  };
  for (int r = 0; r < shape.rows; ++r)
    for (const int c : {0, shape.columns - 1}) widen(r, c);
  for (int c = 0; c < shape.columns; ++c)
    for (const int r : {0, shape.rows - 1}) widen(r, c);
  const auto limit = [](double value, int size) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(size)));
  };
  map.window_.first_column = limit(std::floor(low.x()) - 1, columns_);
  map.window_.first_row = limit(std::floor(low.y()) - 1, rows_);
  map.window_.columns =
      limit(std::ceil(high.x()) + 1, columns_) - map.window_.first_column;
  map.window_.rows = limit(std::ceil(high.y()) + 1, rows_) - map.window_.first_row;
  return map;
}

Result<PixelWindow> RasterFile::read(int band, const PixelWindow& window) const {
  const GdalGuard guard;
  if (band < 1 || band > static_cast<int>(bands_.size()))
    return fault(fmt::format("has no band {}", band));
  PixelWindow pixels = window;
  if (window.columns <= 0 || window.rows <= 0) return pixels;
  const double count = static_cast<double>(window.columns) * window.rows;
  if (count > kLargestWindow)
    return fault(fmt::format("the area has {:.0f} pixels; at most {:.0f} are allowed",
                             count, kLargestWindow),
                 "use a smaller area or a coarser raster");
  pixels.values.resize(static_cast<std::size_t>(count));
  std::vector<unsigned char> valid(pixels.values.size());
  GDALRasterBandH handle = GDALGetRasterBand(handles_->dataset.get(), band);
  const auto fill = [&](GDALRasterBandH from, void* to, GDALDataType type) {
    return GDALRasterIO(from, GF_Read, window.first_column, window.first_row,
                        window.columns, window.rows, to, window.columns, window.rows,
                        type, 0, 0) == CE_None &&
           !guard.failed();
  };
  if (!fill(handle, pixels.values.data(), GDT_Float64) ||
      !fill(GDALGetMaskBand(handle), valid.data(), GDT_Byte))
    return fault(
        fmt::format("band {} cannot be read; the file is truncated or corrupt: {}", band,
                    guard.failure()));
  int has_nodata = 0;
  const double nodata = GDALGetRasterNoDataValue(handle, &has_nodata);
  const bool nan_declared = has_nodata != 0 && std::isnan(nodata);
  int given = 0;
  double scale = GDALGetRasterScale(handle, &given);
  if (given == 0) scale = 1;
  double offset = GDALGetRasterOffset(handle, &given);
  if (given == 0) offset = 0;
  for (std::size_t i = 0; i < pixels.values.size(); ++i) {
    double& value = pixels.values[i];
    if (valid[i] == 0 || (nan_declared && std::isnan(value))) {
      value = std::nan("");
      continue;
    }
    value = scale * value + offset;
    if (std::isfinite(value)) continue;
    const auto across = static_cast<std::size_t>(window.columns);
    return fault(
        fmt::format("band {}, column {}, row {} (from 0): {} is not a finite number",
                    band, window.first_column + static_cast<int>(i % across),
                    window.first_row + static_cast<int>(i / across), value),
        "declare it as the band's \"no data\" value, or repair the file");
  }
  return pixels;
}

}  // namespace skein::environment
