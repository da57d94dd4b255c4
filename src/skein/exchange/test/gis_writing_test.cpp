// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/gis/gis_writing.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "skein/exchange/gis/map_features.h"

namespace skein::exchange::gis_writing_test {
namespace {

class GisWriting : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("skein_gis_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
  geo::LocalFrame frame_ = geo::LocalFrame::at({37, -122, 0}).value();
};

// A square with a hole, and a second part with an island in the hole of the first.
GisFeature burnt() {
  GisFeature feature;
  const auto square = [](double half, bool positive) {
    geo::Ring ring{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    if (!positive) std::reverse(ring.begin(), ring.end());
    return (geo::signed_area(ring) > 0) == positive
               ? ring
               : geo::Ring(ring.rbegin(), ring.rend());
  };
  feature.rings = {square(1000, true), square(600, false), square(200, true)};
  feature.fields = {{"name", std::string("burnt")}, {"area_ha", 272.0}};
  return feature;
}

TEST_F(GisWriting, AreasComeBackFromEveryFormatWithHolesAndIslands) {
  for (const char* ending : {"geojson", "kml", "gpkg", "shp"}) {
    SCOPED_TRACE(ending);
    const auto file = folder_ / (std::string("a.") + ending);
    const auto written = write_gis({burnt()}, "perimeter", frame_, file);
    ASSERT_TRUE(written.ok()) << written.error().text();
    std::vector<std::string> warnings;
    const auto read = read_map(file.string(), &frame_, warnings);
    ASSERT_TRUE(read.ok()) << read.error().text();
    ASSERT_EQ(read.value().size(), 2u) << "two parts";
    double area = 0;
    std::size_t holes = 0;
    for (const MapFeature& part : read.value()) {
      area += std::abs(geo::signed_area(part.points));
      for (const geo::Ring& hole : part.holes) area -= std::abs(geo::signed_area(hole));
      holes += part.holes.size();
      EXPECT_TRUE(part.name == "burnt" || std::string(ending) == "kml") << part.name;
    }
    EXPECT_EQ(holes, 1u);
    EXPECT_NEAR(area, 4e6 - 1.44e6 + 0.16e6, 10);
  }
}

TEST_F(GisWriting, LinesAndSeveralFeaturesToo) {
  GisFeature line;
  line.kind = GisFeature::Kind::kLine;
  line.rings = {{{0, 0}, {100, 0}, {100, 200}}};
  line.fields = {{"name", std::string("scout-1")}, {"until_s", 12.5}};
  const auto file = folder_ / "tracks.geojson";
  ASSERT_TRUE(write_gis({line, line}, "tracks", frame_, file).ok());
  std::vector<std::string> warnings;
  const auto read = read_map(file.string(), &frame_, warnings);
  ASSERT_TRUE(read.ok());
  ASSERT_EQ(read.value().size(), 2u);
  EXPECT_EQ(read.value()[1].points.size(), 3u);
  EXPECT_LT((read.value()[1].points[2] - Vec2(100, 200)).norm(), 0.02);
}

TEST_F(GisWriting, AShapefileIsNotWrittenThroughAPipe) {
  const auto pipe = folder_ / "a.shp";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(write_gis({burnt()}, "x", frame_, pipe).error().code, ErrorCode::kBadInput);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1)
      << "nothing lies beside it";
}

TEST_F(GisWriting, ReplacesAFileWholeAndRefusesOtherEndings) {
  const auto file = folder_ / "a.gpkg";
  ASSERT_TRUE(write_gis({burnt(), burnt()}, "x", frame_, file).ok());
  ASSERT_TRUE(write_gis({burnt()}, "x", frame_, file).ok());
  std::vector<std::string> warnings;
  EXPECT_EQ(read_map(file.string(), &frame_, warnings).value().size(), 2u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1)
      << "nothing else is left behind";
  EXPECT_EQ(write_gis({burnt()}, "x", frame_, folder_ / "a.pdf").error().code,
            ErrorCode::kBadInput);
  EXPECT_EQ(write_gis({burnt()}, "x", frame_, folder_ / "no" / "a.kml").error().code,
            ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace skein::exchange::gis_writing_test
