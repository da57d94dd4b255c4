// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/foxglove/messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/data/describe/json.h"
#include "skein/geo/antimeridian.h"
#include "skein/geo/rotation.h"

namespace skein::hmi::foxglove {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kWorld = "world";
constexpr double kArrow = 40;                       // length of an aircraft [m]
constexpr double kLabel = 12;                       // of its name [px]
constexpr double kLineWidth = 2;                    // [px]
constexpr double kZoneTop = 500;                    // of a zone without a ceiling [m]
constexpr int kDeleteAll = 1;                       // SceneEntityDeletionType
constexpr int kLineStrip = 0;                       // LineType
constexpr int kInfo = 2, kWarning = 3, kError = 4;  // LogLevel
constexpr int kDiagonal = 2;  // PositionCovarianceType: DIAGONAL_KNOWN

struct Colour {
  double r, g, b, a = 1;
};
constexpr Colour kAircraft{0.10, 0.45, 0.90}, kPath{0.10, 0.65, 0.60, 0.8},
    kBelief{0.95, 0.55, 0.05}, kTruth{0.80, 0.10, 0.10}, kZone{0.70, 0.10, 0.45};

// Millimetres are enough; keeps the text short.
double rounded(double value) {
  return std::round(value * 1000) / 1000;
}

Json vector(double x, double y, double z) {
  return {{"x", rounded(x)}, {"y", rounded(y)}, {"z", rounded(z)}};
}

// From N to the world of a viewer.
Json point(const Vec2& p, double altitude_msl) {
  return vector(p.y(), p.x(), altitude_msl);
}

Json colour(const Colour& c) {
  return {{"r", c.r}, {"g", c.g}, {"b", c.b}, {"a", c.a}};
}

Json no_rotation() {
  return {{"x", 0}, {"y", 0}, {"z", 0}, {"w", 1}};
}

// Of a body with x forward, y left, z up in the world.
Json attitude(double heading_deg, double roll_deg) {
  geo::Euler angles;
  angles.roll = geo::radians(roll_deg);
  angles.yaw = geo::kPi / 2 - geo::radians(heading_deg);
  const Quat q = geo::from_euler(angles);
  return {{"x", q.x()}, {"y", q.y()}, {"z", q.z()}, {"w", q.w()}};
}

std::string name_of_entity(EntityId id, const Messages::Names& names) {
  const auto found = names.find(id);
  return found == names.end() ? fmt::format("{}", id.value) : found->second;
}

Json line(Json points, const Colour& c) {
  return {{"type", kLineStrip},
          {"pose", {{"position", vector(0, 0, 0)}, {"orientation", no_rotation()}}},
          {"thickness", kLineWidth},
          {"scale_invariant", true},
          {"points", std::move(points)},
          {"color", colour(c)},
          {"colors", Json::array()},
          {"indices", Json::array()}};
}

Json ring(const geo::Ring& ring, double altitude_msl) {
  Json points = Json::array();
  for (const Vec2& p : ring) points.push_back(point(p, altitude_msl));
  if (!ring.empty()) points.push_back(point(ring.front(), altitude_msl));
  return points;
}

geo::Ring ring_of(const std::vector<BoundaryPoint>& points) {
  geo::Ring ring;
  for (const BoundaryPoint& each : points) ring.push_back(each.position);
  return ring;
}

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json stamp(std::uint64_t ns) {
  return {{"sec", ns / 1'000'000'000}, {"nsec", ns % 1'000'000'000}};
}

// What was there before is gone.
class Scene {
 public:
  explicit Scene(Json time) : time_(std::move(time)) {
    update_["deletions"] = Json::array();
    update_["deletions"].push_back(
        {{"timestamp", time_}, {"type", kDeleteAll}, {"id", ""}});
    update_["entities"] = Json::array();
  }
  void add(const std::string& id, Json arrows, Json lines, Json texts) {
    Json none = Json::array();
    update_["entities"].push_back({{"timestamp", time_},
                                   {"frame_id", kWorld},
                                   {"id", id},
                                   {"lifetime", {{"sec", 0}, {"nsec", 0}}},
                                   {"frame_locked", true},
                                   {"metadata", none},
                                   {"arrows", std::move(arrows)},
                                   {"cubes", none},
                                   {"spheres", none},
                                   {"cylinders", none},
                                   {"lines", std::move(lines)},
                                   {"triangles", none},
                                   {"texts", std::move(texts)},
                                   {"models", none}});
  }
  void add_lines(const std::string& id, Json lines) {
    add(id, Json::array(), std::move(lines), Json::array());
  }
  std::string text() const { return dumped(update_); }

 private:
  Json time_, update_;
};

Json degrees(const geo::Geodetic& at) {
  return Json::array({at.longitude_deg, at.latitude_deg});
}
Json degrees(const geo::LocalFrame& frame, const Vec2& p) {
  return degrees(frame.from_plane(p));
}

Json feature(Json geometry, Json properties) {
  return {{"type", "Feature"},
          {"geometry", std::move(geometry)},
          {"properties", std::move(properties)}};
}

// A ring as GeoJSON has it: closed, and cut at 180 degrees of longitude.
Json polygon(const geo::LocalFrame& frame, const geo::Ring& ring) {
  geo::Region region = {ring};
  if (geo::signed_area(ring) < 0) std::reverse(region[0].begin(), region[0].end());
  Json polygons = Json::array();
  for (const geo::PlacePolygon& part : geo::cut_region(region, frame)) {
    Json corners = Json::array();
    for (const geo::Geodetic& at : part.front()) corners.push_back(degrees(at));
    corners.push_back(degrees(part.front().front()));
    polygons.push_back(Json::array({std::move(corners)}));
  }
  if (polygons.size() == 1)
    return {{"type", "Polygon"}, {"coordinates", std::move(polygons.front())}};
  return {{"type", "MultiPolygon"}, {"coordinates", std::move(polygons)}};
}

std::string geojson(Json features) {
  const Json all = {{"type", "FeatureCollection"}, {"features", std::move(features)}};
  return dumped({{"geojson", dumped(all)}});
}

}  // namespace

std::uint64_t Messages::since_1970_ns(Time time) const {
  return static_cast<std::uint64_t>(facts_.start_s * 1'000'000'000 + time.ns());
}

std::string Messages::transforms(const FleetFrame& fleet, const Names& names) const {
  const Json time = stamp(since_1970_ns(fleet.time));
  Json all = Json::array();
  for (const VehicleView& view : fleet.vehicles)
    all.push_back({{"timestamp", time},
                   {"parent_frame_id", kWorld},
                   {"child_frame_id", name_of_entity(view.id, names)},
                   {"translation", point(Vec2(view.north, view.east), view.altitude_msl)},
                   {"rotation", attitude(view.heading_deg, view.roll_deg)}});
  return dumped({{"transforms", std::move(all)}});
}

std::string Messages::aircraft(const FleetFrame& fleet, const Names& names) const {
  Scene scene(stamp(since_1970_ns(fleet.time)));
  for (const VehicleView& view : fleet.vehicles) {
    const std::string name = name_of_entity(view.id, names);
    const Json place = point(Vec2(view.north, view.east), view.altitude_msl);
    const Json arrow = {{"pose",
                         {{"position", place},
                          {"orientation", attitude(view.heading_deg, view.roll_deg)}}},
                        {"shaft_length", 0.6 * kArrow},
                        {"shaft_diameter", 0.15 * kArrow},
                        {"head_length", 0.4 * kArrow},
                        {"head_diameter", 0.35 * kArrow},
                        {"color", colour(kAircraft)}};
    const Json label = {{"pose", {{"position", place}, {"orientation", no_rotation()}}},
                        {"billboard", true},
                        {"font_size", kLabel},
                        {"scale_invariant", true},
                        {"color", colour(kAircraft)},
                        {"text", name}};
    scene.add(name, Json::array({arrow}), Json::array(), Json::array({label}));
  }
  return scene.text();
}

std::string Messages::location(const VehicleView& view, Time time) const {
  if (!facts_.frame) return {};
  const geo::Geodetic at =
      facts_.frame->to_geodetic({view.north, view.east, -view.altitude_msl});
  const double variance = static_cast<double>(view.position_sd) * view.position_sd;
  return dumped({{"timestamp", stamp(since_1970_ns(time))},
                 {"frame_id", kWorld},
                 {"latitude", at.latitude_deg},
                 {"longitude", at.longitude_deg},
                 {"altitude", rounded(at.height_m)},
                 {"position_covariance",
                  Json::array({variance, 0, 0, 0, variance, 0, 0, 0, variance})},
                 {"position_covariance_type", kDiagonal}});
}

std::string Messages::state(const VehicleView& view, Time time) const {
  Json state = {{"timestamp", stamp(since_1970_ns(time))}};
  state.update(json::to_json(view));
  for (auto& [name, value] : state.items())
    if (value.is_number_float()) value = rounded(value.get<double>());
  return dumped(state);
}

std::string Messages::boundaries_on_map(const Boundaries& all) const {
  if (!facts_.frame) return {};
  Json features = Json::array();
  for (const auto& [mission, record] : all) {
    for (const auto& points : record.belief.rings) {
      features.push_back(feature(polygon(*facts_.frame, ring_of(points)),
                                 {{"what", "believed boundary"}, {"mission", mission}}));
      for (const BoundaryPoint& each : points)
        features.push_back(feature(
            {{"type", "Point"}, {"coordinates", degrees(*facts_.frame, each.position)}},
            {{"sigma_m", rounded(each.sigma)}, {"rate_mps", rounded(each.rate)}}));
    }
    for (const geo::Ring& ring : record.truth)
      features.push_back(feature(polygon(*facts_.frame, ring),
                                 {{"what", "true boundary"}, {"mission", mission}}));
  }
  return geojson(std::move(features));
}

std::string Messages::boundaries(const Boundaries& all, Time time) const {
  Scene scene(stamp(since_1970_ns(time)));
  for (const auto& [mission, record] : all) {
    Json belief = Json::array(), truth = Json::array();
    for (const auto& points : record.belief.rings) {
      belief.push_back(line(ring(ring_of(points), 0), kBelief));
      // Where it may be: one deviation to both sides.
      for (const BoundaryPoint& each : points)
        belief.push_back(
            line(Json::array({point(each.position - each.sigma * each.normal, 0),
                              point(each.position + each.sigma * each.normal, 0)}),
                 kBelief));
    }
    for (const geo::Ring& each : record.truth)
      truth.push_back(line(ring(each, 0), kTruth));
    scene.add_lines("believed " + mission, std::move(belief));
    if (!truth.empty()) scene.add_lines("true " + mission, std::move(truth));
  }
  return scene.text();
}

std::string Messages::zones_on_map(const Zones& all) const {
  if (!facts_.frame) return {};
  Json features = Json::array();
  for (const auto& [name, zone] : all)
    features.push_back(feature(
        polygon(*facts_.frame, outline(zone)),
        {{"what", "no-fly zone"},
         {"name", name},
         {"floor_msl_m",
          std::isfinite(zone.floor_msl) ? Json(zone.floor_msl) : Json(nullptr)},
         {"ceiling_msl_m",
          std::isfinite(zone.ceiling_msl) ? Json(zone.ceiling_msl) : Json(nullptr)}}));
  return geojson(std::move(features));
}

std::string Messages::zones(const Zones& all, Time time) const {
  Scene scene(stamp(since_1970_ns(time)));
  for (const auto& [name, zone] : all) {
    const geo::Ring area = outline(zone);
    const double bottom = std::isfinite(zone.floor_msl) ? zone.floor_msl : 0;
    const double top = std::isfinite(zone.ceiling_msl) ? zone.ceiling_msl : kZoneTop;
    scene.add_lines(name, Json::array({line(ring(area, bottom), kZone),
                                       line(ring(area, top), kZone)}));
  }
  return scene.text();
}

std::string Messages::paths(const Paths& all, Time time) const {
  Scene scene(stamp(since_1970_ns(time)));
  for (const auto& [id, record] : all) {
    Json points = Json::array();
    for (const PathPoint& each : record.value.points)
      points.push_back(point(Vec2(each.north, each.east), each.altitude_msl));
    scene.add_lines(fmt::format("{}", id.value),
                    Json::array({line(std::move(points), kPath)}));
  }
  return scene.text();
}

std::string Messages::metrics(const MetricSample& sample) const {
  Json values = Json::object();
  for (const NamedValue& each : sample.values)
    if (std::isfinite(each.value)) values[each.name] = each.value;
  return dumped({{"timestamp", stamp(since_1970_ns(sample.time))},
                 {"mission", sample.mission},
                 {"values", std::move(values)}});
}

std::string Messages::clock(const RunClock& clock) const {
  Json state = {{"timestamp", stamp(since_1970_ns(clock.time))}};
  state.update(json::to_json(clock));
  return dumped(state);
}

std::string Messages::log(const Event& event, const std::string& whose) const {
  // By its severity, from information on.
  constexpr int kLevels[] = {kInfo, kInfo, kWarning, kError};
  const auto severity = static_cast<std::size_t>(row_of(event.kind.kind()).severity);
  return dumped({{"timestamp", stamp(since_1970_ns(event.time))},
                 {"level", kLevels[severity]},
                 {"message", std::string(event.kind.name()) +
                                 (event.text.empty() ? "" : ": " + event.text)},
                 {"name", whose},
                 {"file", ""},
                 {"line", 0}});
}

}  // namespace skein::hmi::foxglove
