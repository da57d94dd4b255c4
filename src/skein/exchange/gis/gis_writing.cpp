// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/gis/gis_writing.h"

#include <fmt/format.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <memory>
#include <system_error>

#include "skein/base/input_file.h"
#include "skein/base/output_file.h"
#include "skein/geo/antimeridian.h"
#include "skein/geo/gdal/gdal_guard.h"
#include "skein/geo/gdal/gdal_handles.h"

namespace skein::exchange {
namespace {

namespace fs = std::filesystem;

struct GisFormat {
  const char* ending;
  const char* driver;
};
constexpr GisFormat kGisFormats[] = {{".geojson", "GeoJSON"},
                                     {".kml", "KML"},
                                     {".gpkg", "GPKG"},
                                     {".shp", "ESRI Shapefile"}};

struct DestroySystem {
  void operator()(void* system) const { OSRDestroySpatialReference(system); }
};
struct DestroyGisFeature {
  void operator()(void* feature) const {
    OGR_F_Destroy(static_cast<OGRFeatureH>(feature));
  }
};

class GisWriter {
 public:
  GisWriter(const geo::LocalFrame& frame, const GisFormat& format)
      : frame_(frame), format_(format), system_(OSRNewSpatialReference(nullptr)) {
    OSRSetWellKnownGeogCS(system_.get(), "WGS84");
    // Longitude first, whatever the authority says.
    OSRSetAxisMappingStrategy(system_.get(), OAMS_TRADITIONAL_GIS_ORDER);
  }

  Result<void> write(const std::vector<GisFeature>& features, const std::string& layer,
                     const fs::path& file) {
    GDALDriverH driver = GDALGetDriverByName(format_.driver);
    if (!driver) return failed(file);
    geo::GdalDataset dataset(
        GDALCreate(driver, file.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    if (!dataset) return failed(file);
    char rfc[] = "RFC7946=YES";
    char* options[] = {rfc, nullptr};
    const bool json = format_.driver == std::string_view("GeoJSON");
    OGRLayerH made = GDALDatasetCreateLayer(dataset.get(), layer.c_str(), system_.get(),
                                            type_of(features), json ? options : nullptr);
    if (!made) return failed(file);
    if (!features.empty())
      for (const auto& [name, value] : features.front().fields) {
        OGRFieldDefnH field = OGR_Fld_Create(
            name.c_str(), std::holds_alternative<double>(value) ? OFTReal : OFTString);
        const bool good = OGR_L_CreateField(made, field, TRUE) == OGRERR_NONE;
        OGR_Fld_Destroy(field);
        if (!good) return failed(file);
      }
    for (const GisFeature& feature : features)
      if (!put(made, feature)) return failed(file);
    dataset.reset();
    return guard_.failed() ? failed(file) : Result<void>();
  }

 private:
  bool put(OGRLayerH layer, const GisFeature& feature) const {
    std::unique_ptr<void, DestroyGisFeature> made(
        OGR_F_Create(OGR_L_GetLayerDefn(layer)));
    for (std::size_t k = 0; k < feature.fields.size(); ++k) {
      const auto& value = feature.fields[k].second;
      const int at = static_cast<int>(k);
      auto* row = static_cast<OGRFeatureH>(made.get());
      const auto* number = std::get_if<double>(&value);
      if (number && std::isfinite(*number)) OGR_F_SetFieldDouble(row, at, *number);
      if (number && !std::isfinite(*number)) OGR_F_SetFieldNull(row, at);
      if (!number) OGR_F_SetFieldString(row, at, std::get<std::string>(value).c_str());
    }
    OGRGeometryH shape =
        feature.kind == GisFeature::Kind::kLine ? lines(feature) : areas(feature);
    OGR_F_SetGeometryDirectly(static_cast<OGRFeatureH>(made.get()), shape);
    return OGR_L_CreateFeature(layer, static_cast<OGRFeatureH>(made.get())) ==
           OGRERR_NONE;
  }

  static void add_point(OGRGeometryH to, const geo::Geodetic& at) {
    OGR_G_AddPoint_2D(to, at.longitude_deg, at.latitude_deg);
  }

  std::vector<std::vector<geo::CutPoint>> parts_of(const GisFeature& line) const {
    std::vector<Vec2> points;
    for (const geo::Ring& each : line.rings)
      points.insert(points.end(), each.begin(), each.end());
    return geo::cut_line(points, frame_);
  }

  // Lines are several in one where any of them is cut.
  OGRwkbGeometryType type_of(const std::vector<GisFeature>& features) {
    if (features.empty() || features.front().kind == GisFeature::Kind::kArea)
      return wkbMultiPolygon;
    several_ = std::any_of(features.begin(), features.end(), [&](const GisFeature& each) {
      return parts_of(each).size() > 1;
    });
    return several_ ? wkbMultiLineString : wkbLineString;
  }

  OGRGeometryH lines(const GisFeature& feature) const {
    OGRGeometryH all = OGR_G_CreateGeometry(wkbMultiLineString);
    for (const std::vector<geo::CutPoint>& part : parts_of(feature)) {
      OGRGeometryH made = OGR_G_CreateGeometry(wkbLineString);
      for (const geo::CutPoint& each : part) add_point(made, each.at);
      OGR_G_AddGeometryDirectly(all, made);
    }
    return several_ ? all : OGR_G_ForceToLineString(all);
  }

  OGRGeometryH areas(const GisFeature& feature) const {
    OGRGeometryH all = OGR_G_CreateGeometry(wkbMultiPolygon);
    for (const geo::PlacePolygon& polygon : geo::cut_region(feature.rings, frame_)) {
      OGRGeometryH part = OGR_G_CreateGeometry(wkbPolygon);
      for (const std::vector<geo::Geodetic>& ring : polygon) {
        OGRGeometryH made = OGR_G_CreateGeometry(wkbLinearRing);
        for (const geo::Geodetic& each : ring) add_point(made, each);
        add_point(made, ring.front());
        OGR_G_AddGeometryDirectly(part, made);
      }
      OGR_G_AddGeometryDirectly(all, part);
    }
    return all;
  }

  Result<void> failed(const fs::path& file) const {
    return Error{ErrorCode::kUnavailable, file.string(),
                 fmt::format("cannot be written: {}.", guard_.failure()), ""};
  }

  geo::GdalGuard guard_;
  const geo::LocalFrame& frame_;
  const GisFormat& format_;
  std::unique_ptr<void, DestroySystem> system_;
  bool several_ = false;  // lines in one feature
};

// Moves all files of a folder to where they belong.
Result<void> move_all(const fs::path& from, const fs::path& to) {
  std::error_code failure;
  for (const fs::directory_entry& each : fs::directory_iterator(from, failure))
    if (auto moved = move_into_place(each.path(), to / each.path().filename()); !moved)
      return moved;
  if (failure)
    return Error{ErrorCode::kUnavailable, to.string(),
                 fmt::format("cannot be written: {}.", failure.message()), ""};
  return {};
}

constexpr GisFormat kPackedShapefile{".shp.zip", "ESRI Shapefile"};

// A folder that nobody else has, gone with this.
class PrivateFolder {
 public:
  explicit PrivateFolder(const fs::path& in = fs::temp_directory_path()) {
    std::string name = (in / ".skein-gis-XXXXXX").string();
    if (::mkdtemp(name.data())) path_ = name;
  }
  ~PrivateFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;
  // Empty where it could not be made.
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

Result<std::string> gis_bytes(const std::vector<GisFeature>& features,
                              const std::string& layer, const geo::LocalFrame& frame,
                              const std::string& ending) {
  const GisFormat* format =
      ending == kPackedShapefile.ending ? &kPackedShapefile : nullptr;
  for (const GisFormat& each : kGisFormats)
    if (ending == each.ending && ending != ".shp") format = &each;
  if (!format)
    return Error{ErrorCode::kBadInput, ending, "is no ending that is known.",
                 "Allowed: .geojson, .kml, .gpkg, .shp.zip."};
  const PrivateFolder folder;
  if (folder.path().empty())
    return Error{ErrorCode::kUnavailable, fs::temp_directory_path().string(),
                 fmt::format("cannot be written: {}.", std::strerror(errno)), ""};
  const fs::path file = folder.path() / (layer + ending);
  if (auto done = GisWriter(frame, *format).write(features, layer, file); !done)
    return done.error();
  return read_file(file);
}

Result<void> write_gis(const std::vector<GisFeature>& features, const std::string& layer,
                       const geo::LocalFrame& frame, const fs::path& file) {
  const auto format =
      std::find_if(std::begin(kGisFormats), std::end(kGisFormats),
                   [&](const GisFormat& f) { return file.extension() == f.ending; });
  if (format == std::end(kGisFormats))
    return Error{ErrorCode::kBadInput, file.string(), "has an ending that is not known.",
                 "Allowed: .geojson, .kml, .gpkg, .shp."};
  const auto place = output_place(file);
  if (!place) return place.error();
  if (place.value() != OutputPlace::kReplaced && file.extension() == ".shp")
    return Error{ErrorCode::kBadInput, file.string(),
                 "is no regular file, and a shapefile is several.",
                 "Write a .gpkg, .geojson or .kml there, or the shapefile elsewhere."};
  // In a folder beside it first: what others read is always whole. Beside a device
  // nothing is made.
  const fs::path target = fs::absolute(file).parent_path();
  const PrivateFolder folder(
      place.value() == OutputPlace::kReplaced ? target : fs::temp_directory_path());
  if (folder.path().empty())
    return Error{ErrorCode::kUnavailable, file.string(),
                 fmt::format("cannot be written: {}.", std::strerror(errno)), ""};
  if (auto done = GisWriter(frame, *format)
                      .write(features, layer, folder.path() / file.filename());
      !done)
    return done;
  return move_all(folder.path(), target);
}

}  // namespace skein::exchange
