// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "skein/exchange/plan/samples.h"
#include "skein/exchange/table/formats.h"
#include "skein/exchange/table/writers.h"
#include "skein/geo/antimeridian.h"
#include "skein/geo/vec.h"

namespace skein::exchange {
namespace {

using Json = nlohmann::ordered_json;

double wrapped_deg(double angle) {
  return geo::degrees(geo::wrap_2pi(angle)) + 0.0;  // a zero has no minus sign
}

class GeoJsonWriter {
 public:
  GeoJsonWriter(const Document& document, const WritingOptions& options)
      : document_(document), frame_(*document.frame), options_(options) {}

  std::string write() {
    for (const NamedPlan& plan : document_.plans) add_plan(plan);
    for (const Zone& zone : document_.zones) add_zone(zone);
    for (const Shape& shape : document_.shapes) add_shape(shape);
    for (const Mark& mark : document_.marks) add_mark(mark);
    for (const MovingObstacle& mover : document_.movers) add_mover(mover);
    Json file = {{"type", "FeatureCollection"}, {"name", document_.title}};
    file["features"] = std::move(features_);
    return file.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  }

 private:
  Json on_map(const Vec2& p) const {
    const geo::Geodetic at = frame_.from_plane(p);
    return {at.longitude_deg, at.latitude_deg};
  }
  static Json on_map(const geo::Geodetic& at) {
    return {at.longitude_deg, at.latitude_deg};
  }
  Json in_space(const Vec3& p) const {
    Json at = on_map(p.head<2>());
    if (document_.has_altitude) at.push_back(-p.z());
    return at;
  }

  void add(const char* type, Json coordinates, Json properties) {
    Json geometry = {{"type", type}};
    geometry["coordinates"] = std::move(coordinates);
    Json feature = {{"type", "Feature"}};
    feature["properties"] = std::move(properties);
    feature["geometry"] = std::move(geometry);
    features_.push_back(std::move(feature));
  }

  // The points of a line with what is said of each.
  struct Line {
    Json points = Json::array(), times = Json::array(), headings = Json::array();
  };

  // One line, or several where it crosses 180 degrees of longitude.
  std::vector<Line> lines_of(const std::vector<FlightSample>& moments) const {
    std::vector<Vec2> points;
    for (const FlightSample& each : moments) points.push_back(each.moment.p_N.head<2>());
    std::vector<Line> lines;
    for (const std::vector<geo::CutPoint>& part : geo::cut_line(points, frame_)) {
      Line& line = lines.emplace_back();
      for (const geo::CutPoint& each : part) {
        const FlightSample& from = moments[each.before];
        const FlightSample& to = moments[each.share > 0 ? each.before + 1 : each.before];
        const auto between = [&](double a, double b) { return a + each.share * (b - a); };
        Json at = on_map(each.at);
        if (document_.has_altitude)
          at.push_back(-between(from.moment.p_N.z(), to.moment.p_N.z()));
        line.points.push_back(std::move(at));
        line.times.push_back(between(from.time, to.time));
        line.headings.push_back(
            wrapped_deg(between(from.moment.heading, to.moment.heading)));
      }
    }
    return lines;
  }

  void add_plan(const NamedPlan& plan) {
    for (std::size_t k = 0; k < plan.plan.size(); ++k) {
      const FlightElement& e = plan.plan[k];
      std::vector<Line> lines = lines_of(samples(e, options_.tolerance));
      Line all;
      for (Line& each : lines) {
        all.points.push_back(std::move(each.points));
        all.times.push_back(std::move(each.times));
        all.headings.push_back(std::move(each.headings));
      }
      const bool whole = lines.size() == 1;
      if (whole)
        all = {Json(all.points.front()), Json(all.times.front()),
               Json(all.headings.front())};
      Json is = {{"what", "element"}, {"plan", plan.name}};
      if (!plan.word.empty()) is["word"] = plan.word;
      is["element"] = k;
      is["kind"] = kind_of(e);
      is["start_s"] = e.start;
      is["duration_s"] = e.duration;
      is["length_m"] = model::ground_length(e);
      is["airspeed_mps"] = e.airspeed;
      if (e.turn_rate != 0) is["turn_radius_m"] = e.airspeed / std::abs(e.turn_rate);
      is["climb_mps"] = e.climb_rate;
      if (e.climb_acceleration != 0) is["climb_mps2"] = e.climb_acceleration;
      is["wind_north_mps"] = e.wind.x();
      is["wind_east_mps"] = e.wind.y();
      is["times_s"] = std::move(all.times);
      is["headings_deg"] = std::move(all.headings);
      add(whole ? "LineString" : "MultiLineString", std::move(all.points), std::move(is));
    }
  }

  // RFC 7946 wants outer rings counter-clockwise; ours are clockwise.
  static Json closed(const std::vector<geo::Geodetic>& ring) {
    Json corners = Json::array();
    for (auto at = ring.rbegin(); at != ring.rend(); ++at) corners.push_back(on_map(*at));
    corners.push_back(on_map(ring.back()));
    return corners;
  }

  // One polygon, or several where it crosses 180 degrees of longitude.
  void add_area(geo::Ring ring, Json is) {
    if (geo::signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
    Json polygons = Json::array();
    for (const geo::PlacePolygon& polygon : geo::cut_region({ring}, frame_)) {
      Json rings = Json::array();
      for (const std::vector<geo::Geodetic>& each : polygon)
        rings.push_back(closed(each));
      polygons.push_back(std::move(rings));
    }
    if (polygons.size() == 1)
      add("Polygon", Json(polygons.front()), std::move(is));
    else if (!polygons.empty())
      add("MultiPolygon", std::move(polygons), std::move(is));
  }

  static void add_limits(const Zone& zone, Json& is) {
    if (!zone.name.empty()) is["name"] = zone.name;
    for (const auto& [key, value] :
         {std::pair{"floor_m", zone.floor_msl}, std::pair{"ceiling_m", zone.ceiling_msl},
          std::pair{"from_s", zone.from}, std::pair{"until_s", zone.until}})
      if (std::isfinite(value)) is[key] = value;
  }

  void add_zone(const Zone& zone) {
    Json is = {{"what", "zone"}};
    add_limits(zone, is);
    if (const auto* disc = std::get_if<Disc>(&zone.area)) {
      is["radius_m"] = disc->radius;
      add("Point", on_map(disc->centre), std::move(is));
    } else {
      add_area(std::get<geo::Ring>(zone.area), std::move(is));
    }
  }

  void add_shape(const Shape& shape) {
    const char* const what = shape.left_out ? "hole" : shape.closed ? "area" : "line";
    Json is = {{"what", what}, {"name", shape.name}};
    if (shape.closed) return add_area(shape.points, std::move(is));
    Json lines = Json::array();
    for (const std::vector<geo::CutPoint>& part : geo::cut_line(shape.points, frame_)) {
      Json line = Json::array();
      for (const geo::CutPoint& each : part) line.push_back(on_map(each.at));
      lines.push_back(std::move(line));
    }
    if (lines.size() == 1)
      add("LineString", Json(lines.front()), std::move(is));
    else
      add("MultiLineString", std::move(lines), std::move(is));
  }

  void add_mark(const Mark& mark) {
    constexpr const char* kWhat[] = {"start", "goal", "place"};
    Json is = {{"what", kWhat[static_cast<int>(mark.kind)]}, {"name", mark.name}};
    if (mark.heading) is["heading_deg"] = wrapped_deg(*mark.heading);
    add("Point", in_space(mark.p_N), std::move(is));
  }

  void add_mover(const MovingObstacle& m) {
    Json is = {{"what", "obstacle"},
               {"time_s", m.time},
               {"altitude_m", -m.p_N.z()},
               {"velocity_east_mps", m.v_N.y()},
               {"velocity_north_mps", m.v_N.x()},
               {"climb_mps", -m.v_N.z()},
               {"radius_m", m.radius},
               {"height_m", m.height}};
    if (std::isfinite(m.from)) is["from_s"] = m.from;
    if (std::isfinite(m.until)) is["until_s"] = m.until;
    add("Point", on_map(m.p_N.head<2>()), std::move(is));
  }

  const Document& document_;
  const geo::LocalFrame& frame_;
  const WritingOptions& options_;
  Json features_ = Json::array();
};

}  // namespace

Result<std::string> to_geojson(const Document& document, const WritingOptions& options) {
  if (auto good = check_known(Format::kGeojson, known_of(document)); !good)
    return good.error();
  return GeoJsonWriter(document, options).write();
}

}  // namespace skein::exchange
