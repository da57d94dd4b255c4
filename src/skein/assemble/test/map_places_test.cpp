// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/map_places.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace skein::assemble::map_places_test {
namespace {

using scenario::FeatureUse;

class MapPlaces : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("skein_map_places_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  static geo::LocalFrame frame() { return geo::LocalFrame::at({50, 14, 0}).value(); }

  std::filesystem::path folder_;
};

constexpr const char* kMap = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"name":"tower"},"geometry":{"type":"Point","coordinates":[14.01,50.02]}},
{"type":"Feature","properties":{"name":"road"},"geometry":{"type":"LineString","coordinates":[[14,50],[14.01,50],[14.01,50.01]]}},
{"type":"Feature","properties":{"name":"field"},"geometry":{"type":"Polygon","coordinates":[[[14,50],[14.01,50],[14.01,50.01],[14,50]]]}},
{"type":"Feature","properties":{"name":"twin"},"geometry":{"type":"Point","coordinates":[14,50]}},
{"type":"Feature","properties":{"name":"twin"},"geometry":{"type":"Point","coordinates":[14,50.1]}}]})";

TEST_F(MapPlaces, ReadsPointsLinesAndAreasByName) {
  const std::string file = write("map.geojson", kMap);
  const auto point = feature_points(file, "tower", FeatureUse::kPoint, frame());
  ASSERT_TRUE(point.ok()) << point.error().text();
  EXPECT_LT((point.value().front() - frame().to_plane(50.02, 14.01)).norm(), 1e-6);
  const auto line = feature_points(file, "road", FeatureUse::kLine, frame());
  ASSERT_TRUE(line.ok()) << line.error().text();
  EXPECT_EQ(line.value().size(), 3u);
  EXPECT_LT(line.value().front().norm(), 1e-6);
  // An area's outline is a line too.
  for (const FeatureUse use : {FeatureUse::kArea, FeatureUse::kLine}) {
    const auto area = feature_points(file, "field", use, frame());
    ASSERT_TRUE(area.ok()) << area.error().text();
    EXPECT_EQ(area.value().size(), 3u);
  }
}

TEST_F(MapPlaces, ReadsTheOnlyFeatureOfAFileWithoutItsName) {
  const std::string file = write("place.kml", R"(<?xml version="1.0"?>
<kml xmlns="http://www.opengis.net/kml/2.2"><Document><Placemark><name>here</name>
<Point><coordinates>14.0,50.01,0</coordinates></Point></Placemark></Document></kml>)");
  const auto point = feature_points(file, "", FeatureUse::kPoint, frame());
  ASSERT_TRUE(point.ok()) << point.error().text();
  EXPECT_NEAR(point.value().front().x(), 1112, 2);
}

TEST_F(MapPlaces, SaysWhatTheFileHasInstead) {
  const std::string file = write("map.geojson", kMap);
  const auto says = [&](const std::string& name, FeatureUse use) {
    const auto found = feature_points(file, name, use, frame());
    return found ? std::string("found") : found.error().text();
  };
  EXPECT_NE(says("towre", FeatureUse::kPoint).find("has no point \"towre\""),
            std::string::npos);
  EXPECT_NE(says("towre", FeatureUse::kPoint).find("It has \"tower\", \"twin\""),
            std::string::npos);
  EXPECT_NE(says("tower", FeatureUse::kArea).find("has no area \"tower\""),
            std::string::npos);
  EXPECT_NE(says("twin", FeatureUse::kPoint).find("several points are called \"twin\""),
            std::string::npos);
  EXPECT_NE(says("", FeatureUse::kPoint).find("has several points"), std::string::npos);
  const auto none = feature_points("/no/such.kml", "a", FeatureUse::kPoint, frame());
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace skein::assemble::map_places_test
