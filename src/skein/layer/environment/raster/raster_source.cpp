// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/raster_source.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <utility>

#include "skein/geo/gdal/gdal_guard.h"
#include "skein/layer/environment/raster/band_info.h"
#include "skein/layer/environment/raster/whole_file.h"

namespace skein::environment {
namespace {

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

// A system in words that the owner of this process reads; empty for none.
std::string words_of_system(OGRSpatialReferenceH system) {
  if (system == nullptr) return {};
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
  OSRExportToWktEx(system, &text, options);
  std::string words = text == nullptr ? "" : text;
  CPLFree(text);
  return words;
}

// Longitude and latitude on WGS 84.
std::string words_of_degrees() {
  OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
  OSRSetWellKnownGeogCS(system, "WGS84");
  std::string words = words_of_system(system);
  OSRDestroySpatialReference(system);
  return words;
}

// Whether a NetCDF file's axes are longitude and latitude by the conventions of CF, which
// ask for no reference system then.
bool has_degrees_of_cf(GDALDatasetH dataset, const RasterFacts& facts) {
  if (driver_of(dataset) != "netCDF") return false;
  bool north = false, east = false;
  char** metadata = GDALGetMetadata(dataset, nullptr);
  for (int i = 0; metadata != nullptr && metadata[i] != nullptr; ++i) {
    const std::string_view line = metadata[i];
    const std::size_t key = line.find("#units=");
    if (key == std::string_view::npos) continue;
    const std::string_view unit = line.substr(key + 7);
    for (const std::string_view ending : {"north", "N", "_N"})
      north = north || (unit.starts_with("degree") && unit.ends_with(ending));
    for (const std::string_view ending : {"east", "E", "_E"})
      east = east || (unit.starts_with("degree") && unit.ends_with(ending));
  }
  if (!north || !east) return false;
  const Affine& geo = facts.geo;
  const Vec2 corner = affine(geo, Vec2(facts.columns, facts.rows));
  // Half a pixel of a world-wide grid may reach over a pole.
  const double beyond = std::abs(geo[5]);
  for (const double latitude : {geo[3], corner.y()})
    if (std::abs(latitude) > 90 + beyond) return false;
  for (const double longitude : {geo[0], corner.x()})
    if (std::abs(longitude) > 540) return false;
  return geo[2] == 0 && geo[4] == 0;
}

}  // namespace

Result<RasterSource> RasterSource::open(const std::string& path,
                                        const std::string& variable) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored))
    return Error{ErrorCode::kNotFound, path, "there is no such file", ""};
  if (!std::filesystem::is_regular_file(path, ignored))
    return Error{ErrorCode::kBadInput, path, "is not a file but a folder or device",
                 "give one raster file"};
  RasterSource source(path);
  if (auto good = source.choose(variable); !good) return good.error();
  if (auto good = source.look(); !good) return good.error();
  return source;
}

// Opens the file, or the one of its parts that holds the variable.
Result<void> RasterSource::choose(const std::string& variable) {
  const geo::GdalGuard guard;
  // Counts of a damaged header would have the library ask for any amount of memory.
  if (auto whole = check_whole(path_, "netCDF", 0); !whole) return whole;
  dataset_ = geo::open_dataset(path_, geo::DataKind::kRaster);
  if (!dataset_)
    return error("cannot be read as a raster: " + guard.failure(),
                 "docs/environment.md has the formats that can be read");
  if (auto whole =
          check_whole(path_, driver_of(dataset_.get()), pixel_bytes(dataset_.get()));
      !whole)
    return whole;
  const auto parts = subdatasets(dataset_.get());
  if (parts.empty() || (variable.empty() && GDALGetRasterCount(dataset_.get()) > 0))
    return {};
  std::string names;
  const Subdataset* chosen = nullptr;
  for (const Subdataset& part : parts) {
    names += (names.empty() ? "" : ", ") + part.variable;
    if (part.variable == variable) chosen = &part;
  }
  if (chosen == nullptr)
    return Error{ErrorCode::kNotFound, path_,
                 variable.empty() ? "has several variables and none was chosen"
                                  : fmt::format("has no variable \"{}\"", variable),
                 "it has: " + names};
  dataset_ = geo::open_dataset(chosen->name, geo::DataKind::kRaster);
  if (!dataset_)
    return error(
        fmt::format("variable \"{}\" cannot be read: {}", variable, guard.failure()));
  return {};
}

// What the file says of itself.
Result<void> RasterSource::look() {
  const geo::GdalGuard guard;
  GDALDatasetH dataset = dataset_.get();
  facts_.columns = GDALGetRasterXSize(dataset);
  facts_.rows = GDALGetRasterYSize(dataset);
  if (GDALGetRasterCount(dataset) < 1) return error("has no raster band");
  Affine inverse{};
  if (GDALGetGeoTransform(dataset, facts_.geo.data()) != CE_None ||
      GDALInvGeoTransform(facts_.geo.data(), inverse.data()) == 0)
    return error("has no georeference: nothing says where its pixels lie",
                 "an affine transform (world file, GeoTIFF tags...) is needed");
  facts_.system = words_of_system(GDALGetSpatialRef(dataset));
  if (facts_.system.empty() && has_degrees_of_cf(dataset, facts_))
    facts_.system = words_of_degrees();
  if (facts_.system.empty())
    return error("has no coordinate reference system",
                 "assign one, for example with gdal_translate -a_srs");
  for (int i = 1; i <= GDALGetRasterCount(dataset); ++i)
    facts_.bands.push_back(describe_band(dataset, i));
  return {};
}

Result<PixelWindow> RasterSource::read(int band, const PixelWindow& window) const {
  const geo::GdalGuard guard;
  PixelWindow pixels = window;
  pixels.values.resize(static_cast<std::size_t>(window.columns) *
                       static_cast<std::size_t>(window.rows));
  std::vector<unsigned char> valid(pixels.values.size());
  GDALRasterBandH handle = GDALGetRasterBand(dataset_.get(), band);
  const auto fill = [&](GDALRasterBandH from, void* to, GDALDataType type) {
    return GDALRasterIO(from, GF_Read, window.first_column, window.first_row,
                        window.columns, window.rows, to, window.columns, window.rows,
                        type, 0, 0) == CE_None &&
           !guard.failed();
  };
  if (!fill(handle, pixels.values.data(), GDT_Float64) ||
      !fill(GDALGetMaskBand(handle), valid.data(), GDT_Byte))
    return error(
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
    return error(
        fmt::format("band {}, column {}, row {} (from 0): {} is not a finite number",
                    band, window.first_column + static_cast<int>(i % across),
                    window.first_row + static_cast<int>(i / across), value),
        "declare it as the band's \"no data\" value, or repair the file");
  }
  return pixels;
}

}  // namespace skein::environment
