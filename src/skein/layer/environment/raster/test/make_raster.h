// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cpl_string.h>
#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_srs_api.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace skein::environment {

/// A folder of this process's own, gone when it ends.
class ScratchFolder {
 public:
  ScratchFolder()
      : path_(std::filesystem::path(::testing::TempDir()) /
              ("skein_environment_" + std::to_string(::getpid()))) {}
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A name for a file of the running test; nothing of this name exists yet.
inline std::string scratch(const std::string& name) {
  static const ScratchFolder folder;
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto own =
      folder.path() / (std::string(info->test_suite_name()) + "." + info->name());
  std::filesystem::create_directories(own);
  std::filesystem::remove_all(own / name);
  return (own / name).string();
}

/// What make_raster writes.
struct RasterRecipe {
  std::string driver = "GTiff";
  int columns = 8, rows = 6;
  int epsg = 32611;  ///< 0: none
  std::optional<std::array<double, 6>> geo = std::array<double, 6>{};
  std::vector<std::vector<double>> bands;
  std::optional<double> nodata;
  double scale = 1, offset = 0;
  GDALDataType type = GDT_Float64;
  std::vector<std::string> names;
  std::string unit;                 ///< of every band; empty: none
  std::vector<const char*> create;  ///< options of the driver, as "FORMAT=NC4"
};

/// Writes a small raster with GDAL itself.
inline void make_raster(const std::string& path, const RasterRecipe& recipe) {
  GDALAllRegister();
  GDALDriverH memory = GDALGetDriverByName("MEM");
  GDALDatasetH data =
      GDALCreate(memory, "", recipe.columns, recipe.rows,
                 static_cast<int>(recipe.bands.size()), recipe.type, nullptr);
  if (recipe.geo) {
    auto geo = *recipe.geo;
    GDALSetGeoTransform(data, geo.data());
  }
  if (recipe.epsg != 0) {
    OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
    OSRImportFromEPSG(system, recipe.epsg);
    OSRSetAxisMappingStrategy(system, OAMS_TRADITIONAL_GIS_ORDER);
    GDALSetSpatialRef(data, system);
    OSRDestroySpatialReference(system);
  }
  for (std::size_t b = 0; b < recipe.bands.size(); ++b) {
    GDALRasterBandH band = GDALGetRasterBand(data, static_cast<int>(b) + 1);
    if (recipe.nodata) GDALSetRasterNoDataValue(band, *recipe.nodata);
    if (recipe.scale != 1 || recipe.offset != 0) {
      GDALSetRasterScale(band, recipe.scale);
      GDALSetRasterOffset(band, recipe.offset);
    }
    if (!recipe.unit.empty()) GDALSetRasterUnitType(band, recipe.unit.c_str());
    if (b < recipe.names.size()) GDALSetDescription(band, recipe.names[b].c_str());
    auto values = recipe.bands[b];
    ASSERT_EQ(GDALRasterIO(band, GF_Write, 0, 0, recipe.columns, recipe.rows,
                           values.data(), recipe.columns, recipe.rows, GDT_Float64, 0, 0),
              CE_None);
  }
  GDALDriverH driver = GDALGetDriverByName(recipe.driver.c_str());
  ASSERT_NE(driver, nullptr) << recipe.driver;
  char** create = nullptr;
  for (const char* option : recipe.create) create = CSLAddString(create, option);
  GDALDatasetH copy =
      GDALCreateCopy(driver, path.c_str(), data, FALSE, create, nullptr, nullptr);
  CSLDestroy(create);
  ASSERT_NE(copy, nullptr);
  GDALClose(copy);
  GDALClose(data);
}

/// Leaves only the first `share` of a file.
inline void cut_file(const std::string& path, double share) {
  const auto size = static_cast<double>(std::filesystem::file_size(path));
  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(size * share));
}

}  // namespace skein::environment
