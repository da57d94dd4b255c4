// SPDX-License-Identifier: Apache-2.0
// `skein fire`: recorded fires as agencies publish them.
#include <fmt/format.h>

#include <fstream>

#include "app/test/program.h"

namespace skein::app {
namespace {

// A perimeter as the interagency service gives it: a square, milliseconds, an incident.
std::string published(const std::string& incident, long long milliseconds, double size) {
  const double south = 38.9 - size, north = 38.9 + size;
  const double west = -121 - size, east = -121 + size;
  return fmt::format(R"({{"type":"Feature","properties":{{"poly_IncidentName":"{}",)"
                     R"("poly_PolygonDateTime":{},"poly_CreateDate":1640000000000}},)"
                     R"("geometry":{{"type":"MultiPolygon","coordinates":)"
                     R"([[[[{},{}],[{},{}],[{},{}],[{},{}],[{},{}]]]]}}}})",
                     incident, milliseconds, west, south, east, south, east, north, west,
                     north, west, south);
}

TEST_F(Program, ReadsAFireAsAgenciesPublishItAndFliesThere) {
  std::ofstream(folder_ / "published.geojson")
      << R"({"type":"FeatureCollection","features":[)"
      << published("Bridge", 1630850640000, 0.002) << ","
      << published("River", 1628120160000, 0.01) << ","
      << published("Bridge", 1630854240000, 0.004)
      << ","
      // Shrinks: what has burnt stays burnt.
      << published("Bridge", 1630856040000, 0.0038) << "]}";
  const Finished open = run({"fire", "published.geojson"});
  EXPECT_EQ(open.status, 2);
  EXPECT_NE(open.err.find("BRIDGE (3), RIVER (1)"), std::string::npos) << open.err;

  const Finished read = run({"fire", "published.geojson", "--incident", "bridge",
                             "--scenario", "it's.yaml", "--out", "p.geojson"});
  ASSERT_EQ(read.status, 0) << read.err;
  for (const char* text : {"2021-09-05T14:04:00Z", "2021-09-05T15:34:00Z",
                           "assumed: times are in poly_PolygonDateTime",
                           "burnt before are missing from it, united"})
    EXPECT_NE(read.out.find(text), std::string::npos) << text << "\n" << read.out;
  const auto written = nlohmann::json::parse(read_file(folder_ / "p.geojson"));
  ASSERT_EQ(written["features"].size(), 3u);
  EXPECT_EQ(written["features"][1]["properties"]["time_utc"], "2021-09-05T15:04:00Z");
  EXPECT_NEAR(written["features"][0]["properties"]["area_ha"], 444 * 347 / 1e4, 0.2);

  const Finished flown =
      run({"run", "it's.yaml", "--set", "duration_s=60", "--out", "r"});
  EXPECT_EQ(flown.status, 0) << flown.err;
  EXPECT_NE(flown.err.find("assumed: times are in"), std::string::npos) << flown.err;
  // What was written is read without assuming anything.
  const Finished again = run({"fire", "p.geojson"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.out.find("assumed"), std::string::npos) << again.out;
  EXPECT_NE(again.out.find("2021-09-05T15:34:00Z"), std::string::npos) << again.out;
}

TEST_F(Program, SaysWhatAFireFileLacks) {
  std::ofstream(folder_ / "none.geojson")
      << R"({"type":"FeatureCollection","features":[{"type":"Feature",
      "properties":{"acres":7},"geometry":{"type":"Polygon",
      "coordinates":[[[-121,38.9],[-120.99,38.9],[-121,38.91],[-121,38.9]]]}}]})";
  const Finished none = run({"fire", "none.geojson"});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("its attributes: acres"), std::string::npos) << none.err;
  EXPECT_EQ(run({"fire", "no-such-file"}).status, 2);
  EXPECT_EQ(run({"fire", "none.geojson", "--utc-offset-h", "30"}).status, 2);
}

}  // namespace
}  // namespace skein::app
