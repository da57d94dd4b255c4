// SPDX-License-Identifier: Apache-2.0
// What crosses 180 degrees of longitude is cut there in files (RFC 7946, 3.1.9) and comes
// back uncut.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "skein/exchange/gis/gis_writing.h"
#include "skein/exchange/gis/map_features.h"
#include "skein/exchange/plan/plan_reading.h"
#include "skein/exchange/table/formats.h"
#include "skein/geo/clip.h"
#include "skein/model/connection/connection.h"
#include "skein/model/path/flight_plan.h"

namespace skein::exchange::antimeridian_files_test {
namespace {

using Json = nlohmann::json;

// 180 degrees are 532 m east of the origin.
const geo::LocalFrame& frame() {
  static const geo::LocalFrame at = geo::LocalFrame::at({-16.8, 179.995, 0}).value();
  return at;
}

// No two neighbours of a line or ring lie more than 180 degrees apart.
void expect_no_step(const std::string& geojson) {
  const std::function<void(const Json&)> look = [&](const Json& list) {
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (!list[k].is_array()) return;
      if (list[k][0].is_array()) {
        look(list[k]);
      } else if (k > 0) {
        EXPECT_LT(std::abs(list[k][0].get<double>() - list[k - 1][0].get<double>()), 180);
      }
    }
  };
  const Json file = Json::parse(geojson);
  for (const Json& feature : file["features"]) look(feature["geometry"]["coordinates"]);
}

std::vector<MapFeature> read_back(const std::string& text) {
  std::vector<std::string> warnings;
  auto read = read_map_text(text, "map", frame(), warnings);
  EXPECT_TRUE(read.ok()) << read.error().text();
  return read ? std::move(read).value() : std::vector<MapFeature>();
}

const geo::Ring kField = {{-400, -300}, {-400, 1500}, {300, 1200}, {500, 0}};
const std::vector<Vec2> kLine = {{0, 0}, {100, 1000}, {200, 900}, {300, -100}};

geo::Ring positive(geo::Ring ring) {
  if (geo::signed_area(ring) < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

// The same line, whatever points lie on its straight pieces; `near` [m].
void expect_same_line(const std::vector<Vec2>& read, const std::vector<Vec2>& line,
                      double near = 1e-3) {
  const auto length = [](const std::vector<Vec2>& points) {
    double sum = 0;
    for (std::size_t k = 1; k < points.size(); ++k)
      sum += (points[k] - points[k - 1]).norm();
    return sum;
  };
  EXPECT_NEAR(length(read), length(line), near);
  for (const Vec2& p : line) {
    double nearest = 1e9;
    for (const Vec2& each : read) nearest = std::min(nearest, (each - p).norm());
    EXPECT_LT(nearest, near);
  }
}

TEST(Antimeridian, AreasZonesAndLinesOfAPlanComeBackWhole) {
  Document document;
  document.frame = frame();
  document.shapes = {{"field", true, false, kField}, {"line", false, false, kLine}};
  document.zones = {{positive(kField), 0, 100, 0, 1000, "zone"}};
  const std::string text = to_text(document, Format::kGeojson, {}).value();
  expect_no_step(text);
  std::size_t areas = 0, lines = 0;
  for (const MapFeature& each : read_back(text)) {
    if (each.kind == MapFeature::Kind::kArea) {
      ++areas;
      EXPECT_GT(geo::iou({each.points}, {positive(kField)}), 1 - 1e-6) << each.name;
    } else if (each.kind == MapFeature::Kind::kLine) {
      ++lines;
      expect_same_line(each.points, kLine);
    }
  }
  EXPECT_EQ(areas, 2u) << "the field and the zone";
  EXPECT_EQ(lines, 1u);
}

TEST(Antimeridian, APlanIsCutAndReadAsTheSame) {
  const model::AirMotion air{15, 60, {3, -4}};
  FlightPlan plan;
  model::Pose from{{0, 0}, 0.3};
  for (const model::Pose& to : {model::Pose{{300, 1200}, 2}, model::Pose{{-300, 540}, 0},
                                model::Pose{{400, 520}, 4}}) {
    const double start = plan.empty() ? 12.5 : model::end_time_of(plan);
    const FlightPlan next =
        model::to_flight_plan(model::connect(from, to, air), from, air, start, -150);
    plan.insert(plan.end(), next.begin(), next.end());
    from = to;
  }
  Document document;
  document.frame = frame();
  document.has_altitude = true;
  document.plans = {{"aircraft", "", plan}};
  const std::string text = to_text(document, Format::kGeojson, {}).value();
  expect_no_step(text);
  int cut = 0;
  const Json file = Json::parse(text);
  for (const Json& feature : file["features"]) {
    const Json &geometry = feature["geometry"], &is = feature["properties"];
    if (geometry["type"] != "MultiLineString") continue;
    ++cut;
    double before = 0;
    for (std::size_t k = 0; k < geometry["coordinates"].size(); ++k) {
      EXPECT_EQ(is["times_s"][k].size(), geometry["coordinates"][k].size());
      EXPECT_EQ(is["headings_deg"][k].size(), geometry["coordinates"][k].size());
      if (k > 0) {
        EXPECT_EQ(is["times_s"][k].front(), before) << "parts join";
      }
      before = is["times_s"][k].back();
    }
  }
  EXPECT_GE(cut, 2);
  const auto read = plan_from_geojson(text, "plan", frame());
  ASSERT_TRUE(read.ok()) << read.error().text();
  ASSERT_EQ(read.value().size(), plan.size());
  for (double t = model::start_of(plan); t < model::end_time_of(plan); t += 1)
    EXPECT_LT(
        (model::moment_at(plan, t).p_N - model::moment_at(read.value(), t).p_N).norm(),
        1e-5)
        << t;
}

TEST(Antimeridian, MapsOfEveryFormatComeBackWhole) {
  GisFeature area;
  area.rings = {positive(kField)};
  geo::Ring hole = positive({{0, 500}, {0, 600}, {100, 600}, {100, 500}});
  std::reverse(hole.begin(), hole.end());
  area.rings.push_back(hole);
  area.fields = {{"name", std::string("field")}};
  GisFeature line{GisFeature::Kind::kLine, {kLine}, {{"name", std::string("line")}}};
  GisFeature west{
      GisFeature::Kind::kLine, {{{0, 0}, {0, 100}}}, {{"name", std::string("west")}}};
  constexpr double kDigits = 0.02;  // of degrees with seven decimals [m]
  for (const char* ending : {".geojson", ".kml"}) {
    const std::string areas = gis_bytes({area}, "a", frame(), ending).value();
    const std::string lines = gis_bytes({line, west}, "l", frame(), ending).value();
    if (ending == std::string(".geojson")) {
      expect_no_step(areas);
      expect_no_step(lines);
    }
    const auto read = read_back(areas);
    ASSERT_EQ(read.size(), 1u) << ending;
    geo::Region whole = {read[0].points};
    if (!read[0].holes.empty()) whole = geo::subtract(whole, read[0].holes);
    EXPECT_GT(geo::iou(whole, area.rings), 1 - 1e-4) << ending;
    const auto read_lines = read_back(lines);
    ASSERT_EQ(read_lines.size(), 2u) << ending;
    expect_same_line(read_lines[0].points, kLine, kDigits);
  }
}

TEST(Antimeridian, AnAreaThatOthersHaveCutIsOne) {
  const auto area_of = [](const char* coordinates, const char* type) {
    const auto read = read_back(
        std::string(R"({"type": "FeatureCollection", "features": [{"type": "Feature",
            "properties": {"name": "A"}, "geometry": {"type": ")") +
        type + R"(", "coordinates": )" + coordinates + "}}]}");
    EXPECT_EQ(read.size(), 1u);
    return read.empty() ? 0 : geo::signed_area(read[0].points);
  };
  const double cut = area_of(
      "[[[[179.995, -16.805], [180, -16.805], [180, -16.795], [179.995, -16.795], "
      "[179.995, -16.805]]], [[[-180, -16.805], [-179.995, -16.805], [-179.995, "
      "-16.795], [-180, -16.795], [-180, -16.805]]]]",
      "MultiPolygon");
  const double whole = area_of(
      "[[[179.995, -16.805], [-179.995, -16.805], [-179.995, -16.795], [179.995, "
      "-16.795], [179.995, -16.805]]]",
      "Polygon");
  EXPECT_NEAR(cut, whole, 1e-6 * whole);
}

TEST(Antimeridian, LinesThatTouchElsewhereStayApart) {
  EXPECT_EQ(read_back(R"({"type": "MultiLineString", "coordinates":
      [[[179.99, -16.8], [179.995, -16.8]], [[179.995, -16.8], [179.998, -16.81]]]})")
                .size(),
            2u);
}

}  // namespace
}  // namespace skein::exchange::antimeridian_files_test
