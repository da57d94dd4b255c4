// SPDX-License-Identifier: Apache-2.0
// What the writers write, read by others' readers: GDAL, nlohmann-json.
#include "skein/exchange/table/writers.h"

#include <cpl_vsi.h>
#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_api.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "skein/base/csv.h"
#include "skein/exchange/plan/samples.h"
#include "skein/exchange/table/text_shown.h"
#include "skein/model/connection/connection.h"

namespace skein::exchange::writers_test {
namespace {

Document example() {
  Document d;
  d.title = "Test <of & \"names\">";
  d.frame = geo::LocalFrame::at({50.05, 14.4, 0}).value();
  d.has_altitude = true;
  const model::Pose from{{0, 0}, 1.0}, to{{700, 900}, 4.0};
  const model::AirMotion air{15, 60, {3, -4}};
  d.plans.push_back(
      {"flight, \"one\"", "RSR",
       model::to_flight_plan(model::connect(from, to, air), from, air, 100, -350)});
  d.zones.push_back({geo::Ring{{100, 300}, {100, 500}, {-100, 500}, {-100, 300}}, 200,
                     500, 0, 1000, "limited"});
  d.zones.push_back({Disc{{400, -300}, 120}, {}, {}, {}, {}, "round"});
  d.zones[1].floor_msl = -std::numeric_limits<double>::infinity();
  d.zones[1].ceiling_msl = std::numeric_limits<double>::infinity();
  d.zones[1].from = -std::numeric_limits<double>::infinity();
  d.zones[1].until = std::numeric_limits<double>::infinity();
  d.marks = {{Mark::Kind::kStart, "start", {0, 0, -350}, 1.0},
             {Mark::Kind::kGoal, "goal", {700, 900, -350}, 4.0}};
  d.shapes.push_back({"field", true, false, {{0, 0}, {0, 100}, {100, 100}}});
  d.movers.push_back({});
  return d;
}

// Distance of a point from a segment.
double off(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double t =
      std::clamp((p - a).dot(along) / std::max(along.squaredNorm(), 1e-12), 0.0, 1.0);
  return (a + t * along - p).norm();
}

// How far a plan is from a line through points, at worst.
double farthest(const FlightPlan& plan, const std::vector<Vec2>& line) {
  double worst = 0;
  for (const FlightSample& each : samples(plan, 1e-3, 0.1)) {
    double nearest = 1e300;
    for (std::size_t i = 1; i < line.size(); ++i)
      nearest = std::min(nearest, off(each.moment.p_N.head<2>(), line[i - 1], line[i]));
    worst = std::max(worst, nearest);
  }
  return worst;
}

// A text as a file that GDAL opens, for the test's life.
class VirtualFile {
 public:
  VirtualFile(const std::string& name, std::string text)
      : name_("/vsimem/" + name), text_(std::move(text)) {
    GDALAllRegister();
    VSIFCloseL(VSIFileFromMemBuffer(name_.c_str(), reinterpret_cast<GByte*>(text_.data()),
                                    text_.size(), FALSE));
    dataset_ = GDALOpenEx(name_.c_str(), GDAL_OF_VECTOR, nullptr, nullptr, nullptr);
  }
  ~VirtualFile() {
    if (dataset_) GDALClose(dataset_);
    VSIUnlink(name_.c_str());
  }
  VirtualFile(const VirtualFile&) = delete;
  VirtualFile& operator=(const VirtualFile&) = delete;
  GDALDatasetH dataset() const { return dataset_; }

 private:
  std::string name_, text_;
  GDALDatasetH dataset_ = nullptr;
};

// All points of the features whose text field `field` is `value`, in the local plane.
std::vector<Vec2> points_of(GDALDatasetH dataset, const geo::LocalFrame& frame,
                            const char* field, const std::string& value,
                            std::vector<double>* altitudes = nullptr) {
  std::vector<Vec2> points;
  for (int l = 0; l < GDALDatasetGetLayerCount(dataset); ++l) {
    OGRLayerH layer = GDALDatasetGetLayer(dataset, l);
    OGR_L_ResetReading(layer);
    while (OGRFeatureH feature = OGR_L_GetNextFeature(layer)) {
      const int index = OGR_F_GetFieldIndex(feature, field);
      OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
      if (index >= 0 && OGR_F_GetFieldAsString(feature, index) == value && geometry) {
        if (wkbFlatten(OGR_G_GetGeometryType(geometry)) == wkbPolygon)
          geometry = OGR_G_GetGeometryRef(geometry, 0);
        for (int i = 0; i < OGR_G_GetPointCount(geometry); ++i) {
          points.push_back(
              frame.to_plane(OGR_G_GetY(geometry, i), OGR_G_GetX(geometry, i)));
          if (altitudes) altitudes->push_back(OGR_G_GetZ(geometry, i));
        }
      }
      OGR_F_Destroy(feature);
    }
  }
  return points;
}

TEST(Samples, KeepTheToleranceThatTheySay) {
  const Document d = example();
  for (const double tolerance : {0.01, 0.3, 5.0}) {
    std::vector<Vec2> line;
    for (const FlightSample& each : samples(d.plans[0].plan, tolerance))
      line.emplace_back(each.moment.p_N.head<2>());
    const double off_by = farthest(d.plans[0].plan, line);
    EXPECT_LE(off_by, tolerance);
    EXPECT_GT(off_by, tolerance / 8) << "no denser than it must be";
  }
}

TEST(Samples, HaveEveryElementOnceAndTimesThatGrow) {
  const FlightPlan plan = example().plans[0].plan;
  const auto all = samples(plan, 1, 2);
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_GT(all[i].time, all[i - 1].time);
    EXPECT_LE(all[i].time - all[i - 1].time, 2 + 1e-9);
    EXPECT_LE(all[i].element - all[i - 1].element, 1u);
  }
  EXPECT_EQ(all.front().time, 100);
  EXPECT_NEAR(all.back().time, model::end_time_of(plan), 1e-9);
  EXPECT_TRUE(samples(FlightPlan{}, 1).empty());
}

TEST(Geojson, IsReadByGdalAsItWasWritten) {
  const Document d = example();
  const VirtualFile file("plan.geojson", to_geojson(d, {0.5, 1}).value());
  ASSERT_NE(file.dataset(), nullptr);
  std::vector<double> altitudes;
  const auto line = points_of(file.dataset(), *d.frame, "what", "element", &altitudes);
  ASSERT_GT(line.size(), 5u);
  EXPECT_LE(farthest(d.plans[0].plan, line), 0.5);
  for (const double altitude : altitudes) EXPECT_NEAR(altitude, 350, 1e-9);
  const auto start = points_of(file.dataset(), *d.frame, "what", "start");
  ASSERT_EQ(start.size(), 1u);
  EXPECT_LT(start[0].norm(), 1e-6);
  const auto zone = points_of(file.dataset(), *d.frame, "name", "limited");
  ASSERT_EQ(zone.size(), 5u) << "closed";
  EXPECT_LT((zone.front() - zone.back()).norm(), 1e-9);
  EXPECT_LT(geo::signed_area(std::span(zone).first(4)), 0)
      << "RFC 7946: counter-clockwise";
  EXPECT_NEAR(std::abs(geo::signed_area(std::span(zone).first(4))), 200 * 200, 0.1);
}

TEST(Geojson, HasTimesForEveryPointAndNoNumbersThatAreNone) {
  const auto file = nlohmann::json::parse(to_geojson(example(), {}).value());
  EXPECT_EQ(file["type"], "FeatureCollection");
  double time = 100;
  for (const auto& feature : file["features"]) {
    const auto& is = feature["properties"];
    if (is["what"] != "element") continue;
    EXPECT_EQ(is["times_s"].size(), feature["geometry"]["coordinates"].size());
    EXPECT_EQ(is["headings_deg"].size(), is["times_s"].size());
    EXPECT_NEAR(is["times_s"].front(), time, 1e-9);
    time = is["times_s"].back();
    EXPECT_EQ(is["plan"], "flight, \"one\"");
  }
  const std::string text = file.dump();
  EXPECT_EQ(text.find("null"), std::string::npos) << "limits that there are not";
}

TEST(Kml, IsReadByGdalAsItWasWritten) {
  const Document d = example();
  const VirtualFile file("plan.kml", to_kml(d, {0.5, 1}).value());
  ASSERT_NE(file.dataset(), nullptr);
  const auto line = points_of(file.dataset(), *d.frame, "Name", "flight, \"one\"");
  ASSERT_GT(line.size(), 5u);
  EXPECT_LE(farthest(d.plans[0].plan, line), 0.5);
  const auto round = points_of(file.dataset(), *d.frame, "Name", "round");
  ASSERT_GT(round.size(), 8u);
  for (const Vec2& p : round)
    EXPECT_GE((p - Vec2(400, -300)).norm(), 120 - 1e-6) << "around the disc, not in it";
}

TEST(Csv, HasAllMomentsInItsColumns) {
  const Document d = example();
  std::istringstream in(to_csv(d, {1, 2}));
  std::string line;
  std::getline(in, line);
  std::vector<std::string> names;
  CsvCells header(line);
  while (const auto cell = header.next()) names.emplace_back(*cell);
  int rows = 0;
  while (std::getline(in, line)) {
    ++rows;
    std::vector<std::string> cells;
    CsvCells row(line);
    while (const auto cell = row.next()) cells.emplace_back(*cell);
    ASSERT_EQ(cells.size(), names.size()) << line;
    const auto value = [&](const char* name) {
      const auto at = std::find(names.begin(), names.end(), name) - names.begin();
      return std::stod(cells[static_cast<std::size_t>(at)]);
    };
    const model::FlightMoment m = model::moment_at(d.plans[0].plan, value("time_s"));
    EXPECT_NEAR(value("east_m"), m.p_N.y(), 1e-9);
    EXPECT_NEAR(value("north_m"), m.p_N.x(), 1e-9);
    EXPECT_NEAR(value("altitude_m"), 350, 1e-9);
    EXPECT_NEAR(value("ground_speed_mps"), m.v_N.head<2>().norm(), 1e-9);
    const Vec2 back = d.frame->to_plane(value("latitude_deg"), value("longitude_deg"));
    EXPECT_LT((back - m.p_N.head<2>()).norm(), 1e-6);
  }
  EXPECT_GT(rows, 20);
}

TEST(QgcPlan, HasTheStructureThatItsDocumentationGives) {
  const Document d = example();
  const auto file = nlohmann::json::parse(to_qgc_plan(d, {0.5, 1}).value());
  EXPECT_EQ(file["fileType"], "Plan");
  EXPECT_EQ(file["version"], 1);
  EXPECT_EQ(file["groundStation"], "QGroundControl");
  EXPECT_EQ(file["rallyPoints"]["version"], 2);
  EXPECT_EQ(file["geoFence"]["version"], 2);
  ASSERT_EQ(file["geoFence"]["circles"].size(), 1u);
  EXPECT_EQ(file["geoFence"]["circles"][0]["circle"]["radius"], 120);
  EXPECT_EQ(file["geoFence"]["circles"][0]["inclusion"], false);
  EXPECT_EQ(file["geoFence"]["polygons"].size(), 0u) << "the other zone has limits";
  const auto& mission = file["mission"];
  EXPECT_EQ(mission["version"], 2);
  for (const char* key : {"cruiseSpeed", "hoverSpeed", "firmwareType", "vehicleType",
                          "globalPlanAltitudeMode", "plannedHomePosition"})
    EXPECT_TRUE(mission.contains(key)) << key;
  std::vector<Vec2> line;
  int number = 0;
  for (const auto& item : mission["items"]) {
    EXPECT_EQ(item["type"], "SimpleItem");
    EXPECT_EQ(item["doJumpId"], ++number);
    EXPECT_EQ(item["autoContinue"], true);
    ASSERT_EQ(item["params"].size(), 7u);
    if (item["command"] == 178) {
      EXPECT_EQ(item["frame"], 2);
      EXPECT_EQ(item["params"][1], 15);
      continue;
    }
    EXPECT_EQ(item["command"], 16);
    EXPECT_EQ(item["frame"], 0);
    EXPECT_EQ(item["AltitudeMode"], 2);
    EXPECT_NEAR(item["Altitude"], 350, 1e-9);
    line.push_back(d.frame->to_plane(item["params"][4], item["params"][5]));
  }
  EXPECT_LE(farthest(d.plans[0].plan, line), 0.5);
}

TEST(Waypoints, AreRowsOfTwelveNumbers) {
  const Document d = example();
  std::istringstream in(to_waypoints(d, {0.5, 1}).value());
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "QGC WPL 110");
  std::vector<Vec2> track;
  int index = 0;
  while (std::getline(in, line)) {
    EXPECT_EQ(std::count(line.begin(), line.end(), '\t'), 11) << line;
    std::istringstream row(line);
    std::vector<double> n;
    for (double value = 0; row >> value;) n.push_back(value);
    ASSERT_EQ(n.size(), 12u) << line;
    EXPECT_EQ(n[0], index);
    EXPECT_EQ(n[1], index == 0 ? 1 : 0);
    EXPECT_EQ(n[11], 1);
    if (index > 0 && n[3] == 16) track.push_back(d.frame->to_plane(n[8], n[9]));
    ++index;
  }
  EXPECT_LE(farthest(d.plans[0].plan, track), 0.5);
}

TEST(Missions, AreRefusedWithoutPlaceAltitudeOrOneFlight) {
  Document d = example();
  d.has_altitude = false;
  EXPECT_NE(to_waypoints(d, {}).error().hint.find("--altitude-m"), std::string::npos);
  d = example();
  d.frame.reset();
  for (const auto& refused :
       {to_waypoints(d, {}), to_qgc_plan(d, {}), to_geojson(d, {}), to_kml(d, {})})
    EXPECT_NE(refused.error().hint.find("--origin"), std::string::npos);
  d = example();
  d.plans.push_back(d.plans[0]);
  EXPECT_FALSE(to_qgc_plan(d, {}).ok());
  d.plans.clear();
  EXPECT_FALSE(to_qgc_plan(d, {}).ok());
}

TEST(Pictures, AreWholeXmlWithoutOutsideThings) {
  const std::string svg = to_svg(example()), html = to_html(example());
  EXPECT_NE(svg.find("Test &lt;of &amp; &quot;names&quot;&gt;"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  EXPECT_EQ(std::count(svg.begin(), svg.end(), '<'),
            std::count(svg.begin(), svg.end(), '>'));
  for (const char* outside : {"http://", "https://", "src=", "@import", "url(http"}) {
    std::string rest = html;
    EXPECT_EQ(rest.find(outside), std::string::npos) << outside;
  }
  EXPECT_NE(html.find("id=\"e0-0\""), std::string::npos);
  EXPECT_NE(html.find("data-element=\"e0-0\""), std::string::npos);
}

TEST(Pictures, OfPagesHaveABarThatShrinksWithTheMap) {
  const std::string html = to_html(example());
  const auto width_in = [&](const std::string& before) {
    const std::size_t at = html.find(before);
    return at == std::string::npos ? 0 : std::atof(html.c_str() + at + before.size());
  };
  const double map = width_in("class=\"map\" viewBox=\"0 0 ");
  EXPECT_GT(map, 0);
  EXPECT_EQ(width_in("class=\"bar\" viewBox=\"0 -8 "), map);
}

TEST(Pictures, OfNothingAreThere) {
  Document nothing;
  EXPECT_NE(to_svg(nothing).find("</svg>"), std::string::npos);
  EXPECT_NE(to_html(nothing).find("</html>"), std::string::npos);
  Document only_zone;
  only_zone.zones = {example().zones[1]};
  EXPECT_NE(to_svg(only_zone).find("round"), std::string::npos);
}

TEST(Text, EscapesWhatIsNoText) {
  EXPECT_EQ(escaped("a<b>&\"\x01z"), "a&lt;b&gt;&amp;&quot; z");
  EXPECT_EQ(escaped("é€𝄞"), "é€𝄞");
  EXPECT_EQ(escaped("\xff\xc3 \xed\xa0\x80"), "?? ???");
}

TEST(Text, ShowsTimesAndLengths) {
  EXPECT_EQ(shown_time(83.214), "83.21 s");
  EXPECT_EQ(shown_time(725.04), "12 min 5.0 s");
  EXPECT_EQ(shown_time(779.97), "13 min 0.0 s");
  EXPECT_EQ(shown_time(7390), "2 h 3 min 10 s");
  EXPECT_EQ(shown_time(360000), "4.2 days");
  EXPECT_EQ(shown_time(-1e15), "-over 100000 days");
  EXPECT_EQ(shown_time_below(83.219), "83.21 s");
  EXPECT_EQ(shown_time_below(99.999), "99.99 s");
  EXPECT_EQ(shown_time_below(725.09), "12 min 5.0 s");
  EXPECT_EQ(shown_time_below(3599.99), "59 min 59.9 s");
  EXPECT_EQ(shown_time_below(7390.9), "2 h 3 min 10 s");
  EXPECT_EQ(shown_time_below(364000), "4.2 days");
  EXPECT_EQ(shown_clock(1e15), "over 100000 days");
  EXPECT_EQ(shown_tenths(-0.04), "0.0");
  EXPECT_EQ(shown_tenths(-0.06), "-0.1");
  EXPECT_EQ(shown_bearing(-0.0), "0.0");
  EXPECT_EQ(shown_bearing(-1e-4), "0.0") << "not 360.0";
  EXPECT_EQ(shown_bearing(-2e-3), "359.9");
  EXPECT_EQ(shown_clock(45), "45 s");
  EXPECT_EQ(shown_clock(65), "1:05");
  EXPECT_EQ(shown_clock(3600), "1:00:00");
  EXPECT_EQ(shown_length(85.4), "85 m");
  EXPECT_EQ(shown_length(1250), "1.25 km");
  for (const double value : {0.3, 1.0, 4.9, 51.0, 999.0}) {
    EXPECT_LE(round_below(value), value);
    EXPECT_GE(round_below(value), value / 2.5 * (1 - 1e-9));
  }
}

}  // namespace
}  // namespace skein::exchange::writers_test
