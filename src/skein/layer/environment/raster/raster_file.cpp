#include "skein/layer/environment/raster/raster_file.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "skein/geo/gdal/gdal_guard.h"
#include "skein/layer/environment/raster/band_info.h"
#include "skein/layer/environment/raster/whole_file.h"

namespace skein::environment {
namespace {

constexpr double kLargestWindow = 100e6;  // pixels

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

std::string driver_of(GDALDatasetH dataset) {
  return GDALGetDriverShortName(GDALGetDatasetDriver(dataset));
}

std::uint64_t pixel_bytes(GDALDatasetH dataset) {
  std::uint64_t bytes = 0;
  if (const char* header = GDALGetMetadataItem(dataset, "header_offset", "ENVI"))
    bytes = std::strtoull(header, nullptr, 10);
  const auto pixels = static_cast<std::uint64_t>(GDALGetRasterXSize(dataset)) *
                      static_cast<std::uint64_t>(GDALGetRasterYSize(dataset));
  for (int band = 1; band <= GDALGetRasterCount(dataset); ++band) {
    const GDALDataType type = GDALGetRasterDataType(GDALGetRasterBand(dataset, band));
    bytes += pixels * static_cast<std::uint64_t>(GDALGetDataTypeSizeBytes(type));
  }
  return bytes;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

}  // namespace

struct RasterFile::Handles {
  geo::GdalDataset dataset;
  Georeference place;
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
  const geo::GdalGuard guard;
  auto handles = std::make_unique<Handles>();
  handles->dataset = geo::open_dataset(path, geo::DataKind::kRaster);
  if (!handles->dataset)
    return Error{ErrorCode::kBadInput, path,
                 "cannot be read as a raster: " + guard.failure(),
                 "any raster that GDAL reads is allowed"};
  if (const auto whole = check_whole(path, driver_of(handles->dataset.get()),
                                     pixel_bytes(handles->dataset.get()));
      !whole)
    return whole.error();

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
    handles->dataset = geo::open_dataset(chosen->name, geo::DataKind::kRaster);
    if (!handles->dataset)
      return Error{
          ErrorCode::kBadInput, path,
          fmt::format("variable \"{}\" cannot be read: {}", variable, guard.failure()),
          ""};
  }

  RasterFile file(path, std::move(handles));
  if (auto good = file.georeference(); !good) return good.error();
  file.describe_bands();
  return file;
}

Result<void> RasterFile::georeference() {
  const geo::GdalGuard guard;
  GDALDatasetH dataset = handles_->dataset.get();
  Georeference& place = handles_->place;
  place.columns = GDALGetRasterXSize(dataset);
  place.rows = GDALGetRasterYSize(dataset);
  if (GDALGetRasterCount(dataset) < 1) return fault("has no raster band");
  if (GDALGetGeoTransform(dataset, place.geo.data()) != CE_None ||
      GDALInvGeoTransform(place.geo.data(), place.inverse.data()) == 0)
    return fault("has no georeference: nothing says where its pixels lie",
                 "an affine transform (world file, GeoTIFF tags...) is needed");
  OGRSpatialReferenceH system = GDALGetSpatialRef(dataset);
  if (system == nullptr)
    return fault("has no coordinate reference system",
                 "assign one, for example with gdal_translate -a_srs");
  place.geographic = OSRIsGeographic(system) != 0;
  place.to_raster = geo::transform_from_degrees(system);
  place.from_raster = geo::transform_to_degrees(system);
  if (!place.to_raster || !place.from_raster)
    return fault("has a coordinate reference system that cannot be used: " +
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
  const geo::GdalGuard guard;
  const Vec2 there = affine(handles_->place.geo, pixel);
  double x = there.x(), y = there.y();
  int good = 0;
  OCTTransformEx(
      static_cast<OGRCoordinateTransformationH>(handles_->place.from_raster.get()), 1, &x,
      &y, nullptr, &good);
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
  return map_pixels(handles_->place, frame, shape, path_);
}

Result<PixelWindow> RasterFile::read(int band, const PixelWindow& window) const {
  const geo::GdalGuard guard;
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
