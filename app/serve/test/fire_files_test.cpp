// SPDX-License-Identifier: Apache-2.0
#include "app/serve/fire_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace skein::serve::fire_files_test {
namespace {

class FireFiles : public testing::Test {
 protected:
  FireFiles() {
    PerimeterRecord record;
    record.mission = "fire";
    record.belief = square(300);
    record.belief.time = Time::from_seconds(60);
    record.truth = {{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}};  // is not given away
    fire.take(record);
    for (const double made : {30.0, 60.0})
      for (const double ahead : {600.0, 1800.0}) {
        ForecastRecord forecast;
        forecast.forecast.mission = "fire";
        forecast.forecast.made = Time::from_seconds(made);
        forecast.forecast.boundary = square(300 + ahead / 10);
        forecast.forecast.boundary.time = Time::from_seconds(made + ahead);
        fire.take(forecast);
      }
  }
  static BoundaryEstimate square(double half) {
    BoundaryEstimate boundary;
    auto& ring = boundary.rings.emplace_back();
    for (const Vec2& corner : {Vec2(1, 1), Vec2(-1, 1), Vec2(-1, -1), Vec2(1, -1)}) {
      BoundaryPoint point;
      point.position = half * corner;
      point.normal = corner.normalized();
      point.sigma = 20;
      ring.push_back(point);
    }
    // Outer rings run clockwise on the map.
    geo::Ring corners;
    for (const BoundaryPoint& point : ring) corners.push_back(point.position);
    if (geo::signed_area(corners) < 0) std::reverse(ring.begin(), ring.end());
    return boundary;
  }
  std::optional<hmi::HttpAnswer> ask(const char* path) const {
    return fire_file(path, fire, frame, 1'780'000'000);
  }

  hmi::FireState fire;
  geo::LocalFrame frame = geo::LocalFrame::at({37, -122, 0}).value();
};

TEST_F(FireFiles, HaveTheBoundaryWithItsBandsAndTheNewestPredictions) {
  const auto answer = ask("/api/fire.geojson");
  ASSERT_TRUE(answer);
  ASSERT_EQ(answer->status, 200u);
  EXPECT_EQ(answer->file, "fire.geojson");
  const auto features = nlohmann::json::parse(*answer->body)["features"];
  ASSERT_EQ(features.size(), 5u + 2 * 3u);
  double last = 0;
  for (std::size_t k = 0; k < 5; ++k) {  // from surely to hardly burnt
    const double area = features[k]["properties"]["area_ha"];
    EXPECT_GT(area, last);
    last = area;
    EXPECT_EQ(features[k]["properties"]["time_utc"], "2026-05-28T20:27:40Z");
  }
  EXPECT_NEAR(features[2]["properties"]["area_ha"].get<double>(), 36, 0.1);
  for (std::size_t k = 5; k < features.size(); ++k)
    EXPECT_EQ(features[k]["properties"]["made_utc"], "2026-05-28T20:27:40Z");
  EXPECT_EQ(features[10]["properties"]["ahead_min"], 30);
}

TEST_F(FireFiles, AreOfEachFormat) {
  const auto begin = [](const std::optional<hmi::HttpAnswer>& answer) {
    return answer && answer->status == 200 ? answer->body->substr(0, 6) : std::string();
  };
  EXPECT_EQ(begin(ask("/api/fire.gpkg")), "SQLite");
  EXPECT_EQ(begin(ask("/api/fire.shp.zip")).substr(0, 2), "PK");
  EXPECT_EQ(begin(ask("/api/fire.kml")).substr(0, 5), "<?xml");
  const auto packed = ask("/api/fire.shp.zip");
  for (const char* part : {"fire.shp", "fire.dbf", "fire.prj", "fire.shx"})
    EXPECT_NE(packed->body->find(part), std::string::npos) << part;
  for (const char* other :
       {"/api/fire", "/api/fire.shp", "/api/fire.gpkg/..", "/fire.kml"})
    EXPECT_FALSE(ask(other)) << other;
}

TEST_F(FireFiles, OfNothingAreNone) {
  fire.clear();
  EXPECT_EQ(ask("/api/fire.gpkg")->status, 404u);
}

}  // namespace
}  // namespace skein::serve::fire_files_test
