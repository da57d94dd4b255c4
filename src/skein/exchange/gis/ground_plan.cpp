// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/gis/ground_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "skein/geo/place_limits.h"

namespace skein::exchange {
namespace {

using Json = nlohmann::json;

// MAV_CMD whose place is flown through: waypoint, loiters, landing, take-off, loiter to
// an altitude, spline, take-off and landing of a VTOL, payload place.
constexpr int kFlownThrough[] = {16, 17, 18, 19, 21, 22, 31, 82, 84, 85, 94};
// MAV_FRAME with latitude and longitude: global, relative to home, over terrain.
constexpr int kGlobalFrames[] = {0, 3, 5, 6, 10, 11};

template <std::size_t N>
bool is_one_of(const int (&list)[N], int value) {
  return std::find(std::begin(list), std::end(list), value) != std::end(list);
}

class GroundPlanReader {
 public:
  GroundPlanReader(const std::string& place, const geo::LocalFrame& frame)
      : place_(place), frame_(frame) {}

  Result<std::vector<MapFeature>> read(const Json& plan) {
    if (auto good = mission(member(plan, "mission")); !good) return good.error();
    if (auto good = fences(member(plan, "geoFence")); !good) return good.error();
    for (const Json& point : list(member(plan, "rallyPoints"), "points"))
      if (auto good = add_point("rally point", "rally", point); !good)
        return good.error();
    return std::move(features_);
  }

  int left() const { return left_; }

 private:
  Error error(const std::string& message, const std::string& hint = "") const {
    return {ErrorCode::kBadInput, place_, message, hint};
  }

  static const Json& member(const Json& object, const char* key) {
    static const Json none;
    return object.is_object() && object.contains(key) ? object.at(key) : none;
  }
  static const Json& list(const Json& object, const char* key) {
    static const Json empty = Json::array();
    const Json& found = member(object, key);
    return found.is_array() ? found : empty;
  }
  static std::optional<double> number(const Json& values, std::size_t index) {
    if (!values.is_array() || index >= values.size() || !values[index].is_number())
      return std::nullopt;
    return values[index].get<double>();
  }

  // [latitude, longitude, ...] in the plane.
  Result<Vec2> in_plane(const Json& values, std::size_t at = 0) const {
    const auto latitude = number(values, at), longitude = number(values, at + 1);
    if (!latitude || !longitude || !(std::abs(*latitude) <= 90) ||
        !(std::abs(*longitude) <= 360))
      return error(fmt::format(
          "{} is no latitude and longitude.",
          values.dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 80)));
    const double distance = geo::distance_from_origin(frame_, *latitude, *longitude);
    if (distance > geo::kMaxPlaceDistance)
      return error(fmt::format("a place ({}, {}) lies {:.0f} km from the origin; at most "
                               "{:.0f} km are allowed.",
                               *latitude, *longitude, distance / 1000,
                               geo::kMaxPlaceDistance / 1000),
                   "Is the origin right?");
    return frame_.to_plane(*latitude, *longitude);
  }

  MapFeature named(const char* name, const char* purpose, MapFeature::Kind kind) const {
    MapFeature feature;
    feature.kind = kind;
    feature.place = place_;
    feature.name = name;
    feature.purpose = purpose;
    return feature;
  }

  Result<void> add_points(const char* name, const char* purpose, MapFeature::Kind kind,
                          const Json& points) {
    MapFeature feature = named(name, purpose, kind);
    for (const Json& each : points) {
      const auto p = in_plane(each);
      if (!p) return p.error();
      if (feature.points.empty() || feature.points.back() != p.value())
        feature.points.push_back(p.value());
    }
    if (kind == MapFeature::Kind::kArea) {
      while (feature.points.size() > 1 && feature.points.front() == feature.points.back())
        feature.points.pop_back();
      if (feature.points.size() < 3)
        return error(fmt::format("a {} has fewer than 3 corners.", name));
      if (geo::signed_area(feature.points) < 0)
        std::reverse(feature.points.begin(), feature.points.end());
    }
    features_.push_back(std::move(feature));
    return {};
  }

  Result<void> add_point(const char* name, const char* purpose, const Json& at) {
    return add_points(name, purpose, MapFeature::Kind::kPoint, Json::array({at}));
  }

  Result<void> mission(const Json& mission) {
    for (const Json& item : list(mission, "items"))
      if (auto good = add_item(item); !good) return good;
    if (route_.empty()) return {};
    const bool line = route_.size() > 1;
    MapFeature feature = named(line ? "route" : "waypoint", line ? "route" : "waypoint",
                               line ? MapFeature::Kind::kLine : MapFeature::Kind::kPoint);
    feature.points = std::move(route_);
    features_.push_back(std::move(feature));
    return {};
  }

  Result<void> add_item(const Json& item) {
    if (const Json& polygon = list(item, "polygon"); !polygon.empty())
      return add_points("survey", "survey", MapFeature::Kind::kArea, polygon);
    if (const Json& line = list(item, "polyline"); !line.empty())
      return add_points("corridor", "corridor", MapFeature::Kind::kLine, line);
    if (const Json& landing = list(item, "landCoordinate"); !landing.empty()) {
      for (const char* before : {"landingApproachCoordinate", "loiterCoordinate"})
        if (const Json& at = list(item, before); !at.empty()) {
          if (auto good = fly_to(at); !good) return good;
          break;
        }
      return fly_to(landing);
    }
    const Json& command = member(item, "command");
    const Json& frame = member(item, "frame");
    const Json& params = list(item, "params");
    const auto latitude = number(params, 4), longitude = number(params, 5);
    const bool global =
        !frame.is_number_integer() || is_one_of(kGlobalFrames, frame.get<int>());
    // Latitude and longitude 0 mean where the vehicle is.
    const bool somewhere = latitude && longitude && (*latitude != 0 || *longitude != 0);
    if (command.is_number_integer() && is_one_of(kFlownThrough, command.get<int>()) &&
        global && somewhere)
      return fly_to(params, 4);
    ++left_;
    return {};
  }

  Result<void> fly_to(const Json& values, std::size_t at = 0) {
    const auto p = in_plane(values, at);
    if (!p) return p.error();
    if (route_.empty() || route_.back() != p.value()) route_.push_back(p.value());
    return {};
  }

  // What neither says true nor false could be an exclusion fence that becomes the
  // opposite.
  Result<const char*> sense_of(const Json& fence) const {
    const Json& inclusion = member(fence, "inclusion");
    if (inclusion.is_boolean()) return inclusion.get<bool>() ? "inclusion" : "exclusion";
    return error(
        inclusion.is_null()
            ? std::string("a part of the fence does not say whether it is an inclusion.")
            : fmt::format("inclusion of a fence is {}; true and false are allowed.",
                          inclusion.dump(-1, ' ', false, Json::error_handler_t::replace)
                              .substr(0, 40)),
        "Open it in QGroundControl and save it again.");
  }

  Result<void> fences(const Json& fence) {
    if (const Json& polygon = list(fence, "polygon"); !polygon.empty())
      if (auto good = add_points("fence", "inclusion", MapFeature::Kind::kArea, polygon);
          !good)
        return good;
    for (const Json& each : list(fence, "polygons")) {
      const auto sense = sense_of(each);
      if (!sense) return sense.error();
      if (auto good = add_points("fence", sense.value(), MapFeature::Kind::kArea,
                                 list(each, "polygon"));
          !good)
        return good;
    }
    for (const Json& each : list(fence, "circles")) {
      const auto sense = sense_of(each);
      if (!sense) return sense.error();
      const Json& circle = member(each, "circle");
      const Json& radius = member(circle, "radius");
      if (!radius.is_number() || !(radius.get<double>() > 0) ||
          !(radius.get<double>() <= 1e6))
        return error("a circle of the fence has no radius above 0 m.");
      if (auto good = add_point("fence", sense.value(), member(circle, "center")); !good)
        return good;
      features_.back().numbers["radius_m"] = radius.get<double>();
    }
    if (!list(fence, "breachReturn").empty()) ++left_;
    return {};
  }

  const std::string& place_;
  const geo::LocalFrame& frame_;
  std::vector<MapFeature> features_;
  std::vector<Vec2> route_;
  int left_ = 0;
};

}  // namespace

Result<std::vector<MapFeature>> read_ground_plan(std::string_view text,
                                                 const std::string& place,
                                                 const geo::LocalFrame& frame,
                                                 std::vector<std::string>& warnings) {
  const auto refused = [&](const std::string& message, const std::string& hint = "") {
    return Error{ErrorCode::kBadInput, place, message, hint};
  };
  const Json plan = Json::parse(text, nullptr, false);
  if (!plan.is_object()) return refused("is no .plan: it is no JSON object.");
  if (plan.value("fileType", Json()) != "Plan")
    return refused("is no .plan: its fileType is not Plan.",
                   "A .mission of before 2017 is opened in QGroundControl and saved as "
                   ".plan.");
  try {
    GroundPlanReader reader(place, frame);
    auto features = reader.read(plan);
    if (features && reader.left() > 0)
      warnings.push_back(fmt::format("{}: {} item(s) without a place to fly to left out.",
                                     place, reader.left()));
    return features;
  } catch (const Json::exception& why) {
    return refused(fmt::format("is no .plan: {}.", why.what()));
  }
}

}  // namespace skein::exchange
