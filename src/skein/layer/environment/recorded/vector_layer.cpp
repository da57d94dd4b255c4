// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/recorded/vector_layer.h"

#include <cpl_conv.h>
#include <fmt/format.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "skein/base/input_file.h"
#include "skein/base/valid_text.h"
#include "skein/geo/gdal/gdal_guard.h"
#include "skein/geo/gdal/gdal_handles.h"
#include "skein/geo/gdal/vector_files.h"

namespace skein::environment {
namespace {

constexpr std::size_t kMaxPoints = 5'000'000;
constexpr int kDeepest = 16;  // geometry collections within each other

struct DestroyFeature {
  void operator()(void* feature) const {
    OGR_F_Destroy(static_cast<OGRFeatureH>(feature));
  }
};
struct DestroyGeometry {
  void operator()(void* geometry) const {
    OGR_G_DestroyGeometry(static_cast<OGRGeometryH>(geometry));
  }
};

// Features of one kind that were left out.
struct LeftOut {
  std::size_t count = 0;
  std::string first;  // its place

  void add(const std::string& place) {
    if (count++ == 0) first = place;
  }
};

// What of a file is counted over all its features.
struct Counts {
  std::size_t points = 0;
  LeftOut empty, of_points;
};

// Takes geometry apart into rings and lines, in degrees.
class Collector {
 public:
  Collector(const std::string& place, void* to_degrees, Counts& counts)
      : place_(place), to_degrees_(to_degrees), counts_(counts) {}

  Result<void> add(OGRGeometryH geometry, RawPerimeter& out, int depth = 0) {
    if (geometry == nullptr || OGR_G_IsEmpty(geometry) != 0) {
      counts_.empty.add(place_);
      return {};
    }
    if (depth > kDeepest) return error("has geometry collections nested too deeply");
    switch (wkbFlatten(OGR_G_GetGeometryType(geometry))) {
      case wkbPolygon:
      case wkbTriangle:
        return add_polygon(geometry, out);
      case wkbLineString:
      case wkbLinearRing: {
        auto line = points(geometry);
        if (!line) return line.error();
        out.lines.push_back(std::move(line).value());
        return {};
      }
      case wkbMultiPolygon:
      case wkbMultiLineString:
      case wkbGeometryCollection:
      case wkbPolyhedralSurface:
      case wkbTIN:
        for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
          if (auto good = add(OGR_G_GetGeometryRef(geometry, i), out, depth + 1); !good)
            return good;
        return {};
      case wkbPoint:
      case wkbMultiPoint:
        counts_.of_points.add(place_);
        return {};
      default:
        return add_curves(geometry, out, depth);
    }
  }

 private:
  Error error(const std::string& message) const {
    return {ErrorCode::kBadInput, place_, message, ""};
  }

  Result<void> add_polygon(OGRGeometryH geometry, RawPerimeter& out) {
    RawPolygon polygon;
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i) {
      auto ring = points(OGR_G_GetGeometryRef(geometry, i));
      if (!ring) return ring.error();
      if (i == 0)
        polygon.outer = std::move(ring).value();
      else
        polygon.holes.push_back(std::move(ring).value());
    }
    out.polygons.push_back(std::move(polygon));
    return {};
  }

  // Arcs become chords of 4 degrees, the library's default.
  Result<void> add_curves(OGRGeometryH geometry, RawPerimeter& out, int depth) {
    const std::unique_ptr<void, DestroyGeometry> straight(
        OGR_G_GetLinearGeometry(geometry, 0, nullptr));
    if (!straight || OGR_G_HasCurveGeometry(straight.get(), TRUE) != 0 ||
        OGR_G_GetGeometryType(straight.get()) == OGR_G_GetGeometryType(geometry))
      return error(fmt::format("has geometry of the kind {}; areas and lines are allowed",
                               OGR_G_GetGeometryName(geometry)));
    return add(straight.get(), out, depth + 1);
  }

  Result<std::vector<Vec2>> points(OGRGeometryH line) {
    const int count = line == nullptr ? 0 : OGR_G_GetPointCount(line);
    counts_.points += static_cast<std::size_t>(count);
    if (counts_.points > kMaxPoints)
      return error(fmt::format("has over {} points, the maximum allowed", kMaxPoints));
    std::vector<double> x, y;
    for (int i = 0; i < count; ++i) {
      x.push_back(OGR_G_GetX(line, i));
      y.push_back(OGR_G_GetY(line, i));
      if (!std::isfinite(x.back()) || !std::isfinite(y.back()))
        return error(fmt::format("point {} of a line is {}, {}: not finite", i, x.back(),
                                 y.back()));
    }
    std::vector<int> good(x.size(), 1);
    if (count > 0)
      OCTTransformEx(static_cast<OGRCoordinateTransformationH>(to_degrees_), count,
                     x.data(), y.data(), nullptr, good.data());
    std::vector<Vec2> result;
    result.reserve(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (good[i] == 0 || !(std::abs(y[i]) <= 90) || !(std::abs(x[i]) <= 360))
        return error(
            fmt::format("point {} of a line ({}, {}) has no latitude and longitude", i,
                        OGR_G_GetX(line, static_cast<int>(i)),
                        OGR_G_GetY(line, static_cast<int>(i))));
      result.emplace_back(y[i], x[i]);
    }
    return result;
  }

  std::string place_;
  void* to_degrees_;
  Counts& counts_;
};

void note_left_out(const std::string& name, const LeftOut& what, const std::string& why,
                   std::vector<std::string>& warnings) {
  if (what.count > 0)
    warnings.push_back(fmt::format("{}: {} {} left out; the first: {}", name, what.count,
                                   why, what.first));
}

// A date and time field in ISO 8601. The library's zone flag: 100 is UTC, one step is a
// quarter of an hour; 0 and 1 are unknown and local.
std::string date_text(OGRFeatureH feature, int field, bool with_time) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, zone = 0;
  float second = 0;
  if (OGR_F_GetFieldAsDateTimeEx(feature, field, &year, &month, &day, &hour, &minute,
                                 &second, &zone) == 0)
    return {};
  std::string text = fmt::format("{:04}-{:02}-{:02}", year, month, day);
  if (!with_time) return text;
  text += fmt::format("T{:02}:{:02}:{:06.3f}", hour, minute, second);
  if (zone <= 1) return text;
  const int minutes = 15 * (zone - 100);
  return text + fmt::format("{}{:02}:{:02}", minutes < 0 ? '-' : '+',
                            std::abs(minutes) / 60, std::abs(minutes) % 60);
}

std::vector<Attribute> attributes_of(OGRFeatureH feature) {
  std::vector<Attribute> attributes;
  for (int i = 0; i < OGR_F_GetFieldCount(feature); ++i) {
    if (OGR_F_IsFieldSetAndNotNull(feature, i) == 0) continue;
    OGRFieldDefnH definition = OGR_F_GetFieldDefnRef(feature, i);
    const OGRFieldType type = OGR_Fld_GetType(definition);
    const bool date = type == OFTDate || type == OFTDateTime;
    const std::string text = date ? date_text(feature, i, type == OFTDateTime)
                                  : valid_text(OGR_F_GetFieldAsString(feature, i));
    if (text.find_first_not_of(' ') == std::string::npos) continue;
    attributes.push_back({valid_text(OGR_Fld_GetNameRef(definition)), text});
  }
  return attributes;
}

// The text of a shapefile's .prj; empty for anything else.
std::string projection_text(const std::string& name) {
  std::filesystem::path path(name);
  if (path.extension() != ".shp") return {};
  const auto text = read_file(path.replace_extension(".prj"));
  return text ? text.value() : std::string();
}

// Sets an option of GDAL for this thread and this object's life.
class ThreadOption {
 public:
  ThreadOption(const char* key, const char* value) : key_(key) {
    if (const char* before = CPLGetThreadLocalConfigOption(key, nullptr))
      before_ = before;
    CPLSetThreadLocalConfigOption(key, value);
  }
  ~ThreadOption() {
    CPLSetThreadLocalConfigOption(key_, before_ ? before_->c_str() : nullptr);
  }
  ThreadOption(const ThreadOption&) = delete;
  ThreadOption& operator=(const ThreadOption&) = delete;

 private:
  const char* key_;
  std::optional<std::string> before_;
};

}  // namespace

struct VectorReader::Systems {
  std::string text;               // of the last .prj
  geo::GdalTransform to_degrees;  // that it stands for
};

VectorReader::VectorReader() : systems_(std::make_unique<Systems>()) {}
VectorReader::~VectorReader() = default;

Result<std::vector<VectorFeature>> VectorReader::read(
    const std::string& name, std::vector<std::string>& warnings) {
  const geo::GdalGuard guard;
  const std::string text = projection_text(name);
  const bool known = !text.empty() && text == systems_->text && systems_->to_degrees;
  std::optional<ThreadOption> without_search;
  if (known) without_search.emplace("USE_OSR_FIND_MATCHES", "NO");
  const auto error = [&](const std::string& message, const std::string& hint = "") {
    return Error{ErrorCode::kBadInput, name, message, hint};
  };
  const geo::GdalDataset dataset = geo::open_dataset(name, geo::DataKind::kVector);
  if (!dataset)
    return error("cannot be read as vector data: " + guard.failure(),
                 "docs/environment.md has the formats that can be read");
  std::vector<VectorFeature> features;
  Counts counts;
  int layers_with_outlines = 0;
  for (int l = 0; l < GDALDatasetGetLayerCount(dataset.get()); ++l) {
    OGRLayerH layer = GDALDatasetGetLayer(dataset.get(), l);
    // A table of attributes only: styles, attachments.
    if (OGR_L_GetGeomType(layer) == wkbNone) continue;
    ++layers_with_outlines;
    geo::GdalTransform own_transform;
    void* to_degrees = known ? systems_->to_degrees.get() : nullptr;
    OGR_L_ResetReading(layer);
    for (int n = 0;; ++n) {
      const std::unique_ptr<void, DestroyFeature> feature(OGR_L_GetNextFeature(layer));
      if (!feature) break;
      const std::string place = fmt::format("{}: feature {}", name, n);
      if (to_degrees == nullptr) {
        OGRSpatialReferenceH own = OGR_L_GetSpatialRef(layer);
        if (own == nullptr)
          return error("has no coordinate reference system",
                       "a .prj file or an entry in the file is needed");
        own_transform = geo::transform_to_degrees(own);
        to_degrees = own_transform.get();
        if (to_degrees == nullptr)
          return error("has a coordinate reference system that cannot be used: " +
                       guard.failure());
      }
      VectorFeature out;
      out.outline.place = place;
      Collector collector(place, to_degrees, counts);
      if (auto good = collector.add(OGR_F_GetGeometryRef(feature.get()), out.outline);
          !good)
        return good.error();
      if (out.outline.polygons.empty() && out.outline.lines.empty()) continue;
      out.layer = valid_text(OGR_L_GetName(layer));
      out.attributes = attributes_of(feature.get());
      features.push_back(std::move(out));
    }
    if (own_transform && !text.empty()) {
      systems_->text = text;
      systems_->to_degrees = std::move(own_transform);
    }
  }
  if (guard.failed()) return error("is truncated or corrupt: " + guard.failure());
  note_left_out(name, counts.of_points, "point feature(s), which have no outline,",
                warnings);
  note_left_out(name, counts.empty, "feature(s) with an empty geometry", warnings);
  if (geo::says_cut_off(name))
    warnings.push_back(name +
                       ": says that it is not complete (exceededTransferLimit): "
                       "the server cut the download off");
  if (features.empty())
    return error(layers_with_outlines == 0 ? "has tables without geometry only"
                 : counts.of_points.count > 0 || counts.empty.count > 0
                     ? "has no feature with an outline"
                     : "has no features");
  return features;
}

}  // namespace skein::environment
