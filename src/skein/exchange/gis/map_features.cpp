// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/gis/map_features.h"

#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>

#include "skein/base/csv.h"
#include "skein/base/input_file.h"
#include "skein/base/valid_text.h"
#include "skein/exchange/gis/ground_plan.h"
#include "skein/exchange/gis/map_geometry.h"
#include "skein/geo/gdal/gdal_guard.h"
#include "skein/geo/gdal/gdal_handles.h"
#include "skein/geo/gdal/vector_files.h"

namespace skein::exchange {
namespace {

struct DestroyFeature {
  void operator()(void* feature) const {
    OGR_F_Destroy(static_cast<OGRFeatureH>(feature));
  }
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

// Whether what ends a property's name is a unit.
bool is_unit(std::string_view ending) {
  constexpr std::string_view kUnits[] = {"_m",   "_ft",  "_feet", "_km",  "_nm",  "_mi",
                                         "_mps", "_kt",  "_kts",  "_kmh", "_mph", "_fpm",
                                         "_ms",  "_min", "_s",    "_h"};
  return std::find(std::begin(kUnits), std::end(kUnits), ending) != std::end(kUnits);
}

// "ceiling" or "ceiling_ft" for "ceiling_m": a slip, or another unit.
std::string looks_like(const std::string& name) {
  const std::string base = name.substr(0, name.rfind('_'));
  for (const std::string& known : known_properties()) {
    const std::string known_base = known.substr(0, known.rfind('_'));
    // Words that maps have for other things are none without a unit.
    const bool alone = known == "floor_m" || known == "ceiling_m" || known == "radius_m";
    if (name == known || base != known_base) continue;
    if (alone || is_unit(name.substr(base.size()))) return known;
  }
  return {};
}

// A name of a property as it is known here: in small letters, and whole where a
// shapefile, whose names have ten letters, has cut it.
std::string property_name(std::string text) {
  constexpr std::size_t kShapefileName = 10;
  std::string name = lower(std::move(text));
  if (name.size() == kShapefileName)
    for (const std::string& known : known_properties())
      if (known.starts_with(name)) return known;
  return name;
}

// A purpose that features may have; empty for any other word.
std::string known_purpose(const std::string& word) {
  for (const char* known :
       {"inclusion", "exclusion", "survey", "corridor", "route", "waypoint", "rally"})
    if (word == known) return word;
  return {};
}

// A file in GDAL's memory while it lives.
class MemoryFile {
 public:
  MemoryFile(std::string_view text, const char* ending) {
    static std::atomic<unsigned> made = 0;
    name_ = fmt::format("/vsimem/sent/{}{}", ++made, ending);
    content_.assign(text.begin(), text.end());
    if (VSILFILE* file =
            VSIFileFromMemBuffer(name_.c_str(), reinterpret_cast<GByte*>(content_.data()),
                                 content_.size(), FALSE))
      VSIFCloseL(file);
  }
  ~MemoryFile() { VSIUnlink(name_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  std::vector<char> content_;
};

// Whether a text is one of QGroundControl's, not GeoJSON, which has a type and no
// fileType.
bool is_ground_plan(std::string_view text) {
  const bool collection = text.find("\"features\"") != std::string_view::npos ||
                          text.find("\"geometry\"") != std::string_view::npos ||
                          text.find("\"coordinates\"") != std::string_view::npos;
  return text.find("\"fileType\"") != std::string_view::npos ||
         (!collection && text.find("\"items\"") != std::string_view::npos);
}

// GDAL's words, whose full stop depends on the error.
std::string words_of(const geo::GdalGuard& guard) {
  std::string text = guard.failure();
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text;
}

// Reads one dataset into features.
class Reader {
 public:
  /// @param dataset  that GDAL opens, if it is not `file`.
  Reader(const std::string& file, const geo::LocalFrame* frame,
         std::vector<std::string>& warnings, const std::string& dataset = {})
      : file_(file), frame_(frame), warnings_(warnings), dataset_(dataset) {
    const std::string ending = geo::small_ending(dataset.empty() ? file : dataset);
    rule_of_rings_ = ending == ".geojson" || ending == ".json";
    degrees_only_ = ending == ".kml" || ending == ".kmz";
  }

  Result<std::vector<MapFeature>> read() {
    const geo::GdalGuard guard;
    if (degrees_only_ && frame_ == nullptr)
      return error("KML has latitudes and longitudes; the place on Earth is not known.",
                   "Give --origin.");
    for (const std::string& name : dataset_.empty() ? geo::vector_datasets(file_)
                                                    : std::vector<std::string>{dataset_})
      if (auto good = read_dataset(name, guard); !good) return good.error();
    if (guard.failed()) return error("is truncated or corrupt: " + words_of(guard) + ".");
    if (against_ > 0)
      warnings_.push_back(
          fmt::format("{}: {} outer ring{} clockwise, GeoJSON's rule is "
                      "counter-clockwise; taken as what is inside of {}.",
                      file_, against_, against_ == 1 ? " runs" : "s run",
                      against_ == 1 ? "it" : "them"));
    return std::move(features_);
  }

 private:
  Error error(const std::string& message, const std::string& hint = "") const {
    return {ErrorCode::kBadInput, file_, message, hint};
  }

  Result<void> read_dataset(const std::string& name, const geo::GdalGuard& guard) {
    const geo::GdalDataset dataset = dataset_.empty()
                                         ? geo::open_dataset(name, geo::DataKind::kVector)
                                         : geo::open_sent_dataset(name);
    if (!dataset)
      return error("cannot be read as a map: " + words_of(guard) + ".",
                   "GeoJSON, KML and other vector formats of GDAL are allowed.");
    for (int l = 0; l < GDALDatasetGetLayerCount(dataset.get()); ++l) {
      OGRLayerH layer = GDALDatasetGetLayer(dataset.get(), l);
      // A table of attributes only, such as styles, is no map.
      if (OGR_L_GetGeomType(layer) == wkbNone) continue;
      if (auto good = read_layer(layer, guard); !good) return good;
    }
    if (geo::says_cut_off(name))
      warnings_.push_back(file_ +
                          ": says that it is not complete (exceededTransferLimit): the "
                          "server cut the download off.");
    return {};
  }

  Result<void> read_layer(OGRLayerH layer, const geo::GdalGuard& guard) {
    const geo::GdalTransform to_degrees = transform_of(layer);
    if (frame_ != nullptr && !to_degrees)
      return error("has a coordinate reference system that cannot be used: " +
                   words_of(guard) + ".");
    note_properties(OGR_L_GetLayerDefn(layer));
    OGR_L_ResetReading(layer);
    for (;; ++number_) {
      const std::unique_ptr<void, DestroyFeature> feature(OGR_L_GetNextFeature(layer));
      if (!feature) return {};
      MapFeature common;
      common.place = fmt::format("{}: feature {}", file_, number_);
      if (auto good = read_properties(feature.get(), common); !good) return good;
      GeometryReader geometry(common, frame_, to_degrees.get(), points_);
      if (auto good = geometry.read(OGR_F_GetGeometryRef(feature.get())); !good)
        return good;
      if (rule_of_rings_) against_ += geometry.clockwise();
      join_touching_areas(geometry.features());
      if (frame_ != nullptr) join_cut_lines(geometry.features(), *frame_);
      for (MapFeature& each : geometry.features()) features_.push_back(std::move(each));
    }
  }

  // Null for metres.
  geo::GdalTransform transform_of(OGRLayerH layer) const {
    if (frame_ == nullptr) return nullptr;
    if (OGRSpatialReferenceH own = OGR_L_GetSpatialRef(layer))
      return geo::transform_to_degrees(own);
    const std::unique_ptr<void, decltype(&OSRDestroySpatialReference)> degrees(
        OSRNewSpatialReference(nullptr), &OSRDestroySpatialReference);
    OSRSetWellKnownGeogCS(degrees.get(), "WGS84");
    return geo::transform_to_degrees(degrees.get());
  }

  void note_properties(OGRFeatureDefnH definition) {
    for (int i = 0; i < OGR_FD_GetFieldCount(definition); ++i) {
      const std::string name = property_name(
          valid_text(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i))));
      if (const std::string known = looks_like(name); !known.empty())
        warnings_.push_back(fmt::format("{}: property {} is not known; is {} meant?",
                                        file_, name, known));
    }
  }

  Result<void> read_properties(OGRFeatureH feature, MapFeature& out) const {
    for (int i = 0; i < OGR_F_GetFieldCount(feature); ++i) {
      if (OGR_F_IsFieldSetAndNotNull(feature, i) == 0) continue;
      const std::string name = property_name(
          valid_text(OGR_Fld_GetNameRef(OGR_F_GetFieldDefnRef(feature, i))));
      if (name == "name") out.name = valid_text(OGR_F_GetFieldAsString(feature, i));
      if (name == "what") out.what = valid_text(OGR_F_GetFieldAsString(feature, i));
      if (name == "purpose")
        out.purpose = known_purpose(lower(OGR_F_GetFieldAsString(feature, i)));
      if (name == "altitudemode")
        out.altitude_is_msl = lower(OGR_F_GetFieldAsString(feature, i)) == "absolute";
      const auto& known = known_properties();
      if (std::find(known.begin(), known.end(), name) == known.end()) continue;
      const std::string text = valid_text(OGR_F_GetFieldAsString(feature, i));
      const OGRFieldType type = OGR_Fld_GetType(OGR_F_GetFieldDefnRef(feature, i));
      const bool is_number =
          type == OFTReal || type == OFTInteger || type == OFTInteger64;
      const auto value = is_number ? std::optional(OGR_F_GetFieldAsDouble(feature, i))
                                   : number_in(trimmed(text));
      if (!value || !std::isfinite(*value))
        return Error{ErrorCode::kBadInput, out.place,
                     fmt::format("{} is \"{}\"; a finite number is allowed.", name, text),
                     ""};
      out.numbers[name] = *value;
    }
    return {};
  }

  const std::string& file_;
  const geo::LocalFrame* frame_;
  std::vector<std::string>& warnings_;
  std::string dataset_;  // empty: the file itself
  bool rule_of_rings_ = false, degrees_only_ = false;
  std::vector<MapFeature> features_;
  int number_ = 0, against_ = 0;
  std::size_t points_ = 0;  // of all features
};

}  // namespace

const std::vector<std::string>& known_properties() {
  static const std::vector<std::string> names{
      "floor_m",           "ceiling_m", "from_s",     "until_s",   "radius_m",
      "height_m",          "time_s",    "altitude_m", "climb_mps", "velocity_east_mps",
      "velocity_north_mps"};
  return names;
}

namespace {

Result<std::vector<MapFeature>> read_plan_file(const std::string& file,
                                               const geo::LocalFrame* frame,
                                               std::vector<std::string>& warnings) {
  if (frame == nullptr)
    return Error{ErrorCode::kBadInput, file,
                 "a .plan has latitudes and longitudes; the place on Earth is not known.",
                 "Give --origin."};
  const auto text = read_file(file);
  if (!text) return text.error();
  return read_ground_plan(text.value(), file, *frame, warnings);
}

}  // namespace

Result<std::vector<MapFeature>> read_map_text(std::string_view text,
                                              const std::string& name,
                                              const geo::LocalFrame& frame,
                                              std::vector<std::string>& warnings) {
  std::string_view content = text;
  if (content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);
  content =
      content.substr(std::min(content.find_first_not_of(" \t\r\n"), content.size()));
  if (content.empty() || (content.front() != '<' && content.front() != '{'))
    return Error{ErrorCode::kBadInput, name, "is no GeoJSON, KML or .plan.", ""};
  if (content.front() == '{' && is_ground_plan(content))
    return read_ground_plan(content, name, frame, warnings);
  const geo::GdalGuard guard;
  const MemoryFile file(text, content.front() == '<' ? ".kml" : ".geojson");
  return Reader(name, &frame, warnings, file.name()).read();
}

Result<std::vector<MapFeature>> read_map(const std::string& file,
                                         const geo::LocalFrame* frame,
                                         std::vector<std::string>& warnings) {
  if (const std::string ending = geo::small_ending(file);
      ending == ".plan" || ending == ".mission")
    return read_plan_file(file, frame, warnings);
  // GDAL's own names for archives and places of the network are not for others to give;
  // what tests keep in memory is.
  if (file.starts_with("/vsi") && !file.starts_with("/vsimem/"))
    return Error{ErrorCode::kBadInput, file, "is a name of GDAL's, not of a file.",
                 "Give the file itself; a .zip is read as it is."};
  std::error_code none;
  const auto kind = std::filesystem::status(file, none).type();
  if (!file.starts_with("/vsimem/")) {
    if (kind == std::filesystem::file_type::not_found)
      return Error{ErrorCode::kNotFound, file, "is not there.", ""};
    if (kind != std::filesystem::file_type::regular &&
        kind != std::filesystem::file_type::directory)
      return Error{ErrorCode::kBadInput, file, "is no regular file.", ""};
  }
  return Reader(file, frame, warnings).read();
}

}  // namespace skein::exchange
