// SPDX-License-Identifier: Apache-2.0
// Maps as people draw them, and as nobody should.
#include <arpa/inet.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "skein/exchange/gis/map_features.h"
#include "skein/exchange/gis/zones.h"
#include "skein/exchange/table/writers.h"

namespace skein::exchange::map_test {
namespace {

// A text as a file in memory, for the test's life.
class MapFile {
 public:
  MapFile(const std::string& file, std::string text)
      : name("/vsimem/" + file), text_(std::move(text)) {
    VSIFCloseL(VSIFileFromMemBuffer(name.c_str(), reinterpret_cast<GByte*>(text_.data()),
                                    text_.size(), FALSE));
  }
  ~MapFile() { VSIUnlink(name.c_str()); }
  MapFile(const MapFile&) = delete;
  MapFile& operator=(const MapFile&) = delete;
  const std::string name;

 private:
  std::string text_;
};

std::string feature(const std::string& type, const std::string& coordinates,
                    const std::string& properties = "") {
  return R"({"type":"Feature","properties":{)" + properties +
         R"(},"geometry":{"type":")" + type + R"(","coordinates":)" + coordinates + "}}";
}

std::string collection(const std::string& features) {
  return R"({"type":"FeatureCollection","features":[)" + features + "]}";
}

const std::string kSquare = "[[0,0],[100,0],[100,100],[0,100],[0,0]]";

struct Read {
  Result<std::vector<MapFeature>> features = Error{};
  std::vector<std::string> warnings;
};

Read read(const std::string& text, const geo::LocalFrame* frame = nullptr,
          const std::string& name = "map.geojson") {
  const MapFile file(name, text);
  Read read;
  read.features = read_map(file.name, frame, read.warnings);
  return read;
}

std::string error_of_map(const std::string& text,
                         const geo::LocalFrame* frame = nullptr) {
  const Read got = read(text, frame);
  return got.features ? "" : got.features.error().text();
}

std::string error_of_zones(const std::string& text) {
  const Read got = read(text);
  if (!got.features) return got.features.error().text();
  const auto zones = zones_of(got.features.value());
  return zones ? "" : zones.error().text();
}

std::vector<Zone> zones_in(const std::string& text) {
  const Read got = read(text);
  EXPECT_TRUE(got.features.ok()) << got.features.error().text();
  auto zones = zones_of(got.features.value());
  EXPECT_TRUE(zones.ok()) << zones.error().text();
  return zones.value();
}

TEST(Map, ZonesHaveAreaLimitsAndName) {
  const auto zones = zones_in(collection(
      feature("Polygon", "[" + kSquare + "]",
              R"("name":"field","floor_m":100,"ceiling_m":"300","from_s":5.5)") +
      "," + feature("Point", "[500,-200]", R"("radius_m":60)")));
  ASSERT_EQ(zones.size(), 2u);
  EXPECT_EQ(zones[0].name, "field");
  EXPECT_EQ(zones[0].floor_msl, 100);
  EXPECT_EQ(zones[0].ceiling_msl, 300);
  EXPECT_EQ(zones[0].from, 5.5);
  EXPECT_TRUE(std::isinf(zones[0].until));
  EXPECT_NEAR(geo::signed_area(std::get<geo::Ring>(zones[0].area)), 1e4, 1e-9);
  EXPECT_TRUE(covers(zones[0], {50, 20})) << "50 m north, 20 m east";
  const Disc disc = std::get<Disc>(zones[1].area);
  EXPECT_EQ(disc.radius, 60);
  EXPECT_EQ(disc.centre, Vec2(-200, 500)) << "x is east";
}

TEST(Map, RingsMayRunInEitherSense) {
  const auto there = read(feature("Polygon", "[" + kSquare + "]"));
  const auto back = read(feature("Polygon", "[[[0,0],[0,100],[100,100],[100,0],[0,0]]]"));
  ASSERT_TRUE(there.features.ok() && back.features.ok());
  EXPECT_GT(geo::signed_area(there.features.value()[0].points), 0);
  EXPECT_GT(geo::signed_area(back.features.value()[0].points), 0);
  EXPECT_TRUE(there.warnings.empty());
  ASSERT_EQ(back.warnings.size(), 1u);
  EXPECT_NE(back.warnings[0].find("clockwise"), std::string::npos);
}

TEST(Map, HolesArePlacesWhereOneMayFly) {
  const auto zones =
      zones_in(feature("Polygon", "[" + kSquare +
                                      ",[[20,20],[40,20],[40,40],[20,40],[20,20]],"
                                      "[[60,60],[80,60],[80,80],[60,80],[60,60]]]"));
  double area = 0;
  for (const Zone& zone : zones) area += geo::signed_area(std::get<geo::Ring>(zone.area));
  EXPECT_NEAR(area, 1e4 - 2 * 400, 3 * 0.2 * 100) << "cut, with a little overlap";
  for (double x = 1.5; x < 100; x += 3)
    for (double y = 1.5; y < 100; y += 3) {
      const bool hole = (x > 20 && x < 40 && y > 20 && y < 40) ||
                        (x > 60 && x < 80 && y > 60 && y < 80);
      bool inside = false;
      for (const Zone& zone : zones) inside = inside || covers(zone, {x, y});
      EXPECT_EQ(inside, !hole) << x << " " << y;
    }
}

TEST(Map, GeographicPlacesComeIntoThePlane) {
  const auto frame = geo::LocalFrame::at({50, 14, 0}).value();
  const auto got =
      read(feature("LineString", "[[14,50],[14.01,50],[14.01,50.01]]"), &frame);
  ASSERT_TRUE(got.features.ok()) << got.features.error().text();
  const auto line = line_of(got.features.value()).value();
  EXPECT_LT(line.points[0].norm(), 1e-6);
  EXPECT_NEAR(line.points[1].y(), 717, 1);   // 0.01 degrees of longitude at 50 degrees
  EXPECT_NEAR(line.points[2].x(), 1112, 1);  // and of latitude
}

TEST(Map, PropertiesCountInAnyCaseAndAsShapefilesCutThem) {
  const auto zones = zones_in(collection(
      feature("Polygon", "[" + kSquare + "]",
              R"("NAME":"field","FLOOR_M":100,"Ceiling_M":300,"PURPOSE":"Exclusion")") +
      "," +
      feature("Polygon", "[" + kSquare + "]", R"("Purpose":"INCLUSION","what":"zone")")));
  ASSERT_EQ(zones.size(), 1u) << "an inclusion is no zone to keep out of";
  EXPECT_EQ(zones[0].name, "field");
  EXPECT_EQ(zones[0].floor_msl, 100);
  EXPECT_EQ(zones[0].ceiling_msl, 300);
  const auto movers = movers_of(
      read(feature("Point", "[0,0,120]",
                   R"("radius_m":5,"height_m":5,"velocity_e":2,"velocity_n":-3)"))
          .features.value());
  ASSERT_TRUE(movers) << movers.error().text();
  EXPECT_EQ(movers.value()[0].v_N.head<2>(), Vec2(-3, 2));
}

TEST(Map, PropertiesInOtherUnitsAreSaid) {
  const auto warnings = [](const std::string& properties) {
    std::string all;
    for (const std::string& each :
         read(feature("Point", "[0,0,120]", properties)).warnings)
      all += each + "\n";
    return all;
  };
  for (const char* odd : {"ceiling_ft", "CEILING", "Radius_NM", "height_ft",
                          "altitude_ft", "velocity_east_kt", "climb_fpm", "from_min"}) {
    const std::string said = warnings("\"" + std::string(odd) + "\":1");
    EXPECT_NE(said.find("is not known"), std::string::npos) << odd << ": " << said;
  }
  EXPECT_EQ(warnings(R"("time_utc":"2021-09-05T14:04:00Z","height":3,"area_ha":2)"), "");
}

// The altitude of such a point is none above the sea.
TEST(Map, AltitudesOfKmlAboveTheGroundAreNotThoseAboveTheSea) {
  const auto frame = geo::LocalFrame::at({50, 14, 0}).value();
  const auto error = [&](const std::string& mode) {
    const auto got = read(
        R"(<?xml version="1.0"?><kml xmlns="http://www.opengis.net/kml/2.2"><Document>
<Placemark><ExtendedData><Data name="radius_m"><value>20</value></Data>
<Data name="height_m"><value>20</value></Data></ExtendedData><Point><altitudeMode>)" +
            mode + R"(</altitudeMode><coordinates>14,50,300</coordinates></Point>
</Placemark></Document></kml>)",
        &frame, "map.kml");
    EXPECT_TRUE(got.features.ok()) << got.features.error().text();
    const auto movers = movers_of(got.features.value());
    return movers ? "" : movers.error().text();
  };
  EXPECT_EQ(error("absolute"), "");
  EXPECT_NE(error("relativeToGround").find("altitudeMode"), std::string::npos);
}

TEST(Map, KmlHasZonesToo) {
  const auto frame = geo::LocalFrame::at({50, 14, 0}).value();
  const auto got = read(
      R"(<?xml version="1.0"?><kml xmlns="http://www.opengis.net/kml/2.2"><Document>
<Placemark><name>town</name><ExtendedData><Data name="ceiling_m"><value>450</value></Data>
</ExtendedData><Polygon><outerBoundaryIs><LinearRing><coordinates>14,50,0 14.01,50,0
14.01,50.01,0 14,50.01,0 14,50,0</coordinates></LinearRing></outerBoundaryIs></Polygon>
</Placemark></Document></kml>)",
      &frame, "map.kml");
  ASSERT_TRUE(got.features.ok()) << got.features.error().text();
  const auto zones = zones_of(got.features.value()).value();
  ASSERT_EQ(zones.size(), 1u);
  EXPECT_EQ(zones[0].name, "town");
  EXPECT_EQ(zones[0].ceiling_msl, 450);
  std::vector<std::string> warnings;
  EXPECT_NE(read_map("/vsimem/none.kml", nullptr, warnings).error().hint.find("--origin"),
            std::string::npos);
}

TEST(Map, WhatSkeinWritesItReads) {
  Document d;
  d.frame = geo::LocalFrame::at({50, 14, 0}).value();
  Zone zone;
  zone.area = geo::Ring{{0, 0}, {200, 300}, {0, 300}};
  zone.floor_msl = 50;
  zone.name = "corner \"a\"";
  Zone disc;
  disc.area = Disc{{700, -100}, 80};
  disc.until = 900;
  d.zones = {zone, disc};
  d.marks = {{Mark::Kind::kStart, "start", {0, 0, 0}, 0.0}};
  d.movers = {{10, {5, 6, -70}, {1, 2, -3}, 40, 20, -5, 500}};
  const auto got = read(to_geojson(d, {}).value(), &*d.frame);
  ASSERT_TRUE(got.features.ok()) << got.features.error().text();
  EXPECT_TRUE(got.warnings.empty());
  const auto zones = zones_of(got.features.value()).value();
  ASSERT_EQ(zones.size(), 2u) << "the start is no zone";
  EXPECT_EQ(zones[0].name, zone.name);
  EXPECT_EQ(zones[0].floor_msl, 50);
  const auto& ring = std::get<geo::Ring>(zones[0].area);
  ASSERT_EQ(ring.size(), 3u);
  EXPECT_NEAR(geo::signed_area(ring), 30000, 1e-3);
  EXPECT_LT((std::get<Disc>(zones[1].area).centre - Vec2(700, -100)).norm(), 1e-6);
  EXPECT_EQ(zones[1].until, 900);
  const auto movers = movers_of(got.features.value()).value();
  ASSERT_EQ(movers.size(), 1u);
  EXPECT_EQ(movers[0].v_N, Vec3(1, 2, -3));
  EXPECT_EQ(movers[0].until, 500);
  EXPECT_EQ(movers[0].radius, 40);
}

TEST(Map, SaysWhatIsWrongWhere) {
  const auto frame = geo::LocalFrame::at({50, 14, 0}).value();
  const std::string good = feature("Point", "[0,0]", R"("radius_m":5)") + ",";
  const std::vector<std::pair<std::string, const char*>> errors = {
      {"", "cannot be read as a map"},
      {"{\"type\":", "cannot be read as a map"},
      {collection(good + R"({"type":"Feature","properties":{},"geometry":null})"),
       "feature 1: has an empty geometry"},
      {collection(good + feature("Polygon", "[]")), "feature 1: has an empty geometry"},
      {feature("Polygon", "[[[0,0],[10,0],[0,0]]]"), "at least 3 are needed"},
      {feature("Polygon", "[[[0,0],[10,10],[20,20],[0,0]]]"), "without an area"},
      {feature("Polygon", "[[[0,0],[0,0],[0,0],[0,0]]]"), "1 different points"},
      {feature("LineString", "[[3,3],[3,3]]"), "fewer than two different points"},
      {feature("Point", "[1e300,0]"), "km from the origin"},
      {feature("Point", "[0,0]", R"("radius_m":"wide")"), "radius_m is \"wide\""},
  };
  for (const auto& [text, said] : errors)
    EXPECT_NE(error_of_map(text).find(said), std::string::npos) << said << "\n"
                                                                << error_of_map(text);
  EXPECT_NE(
      error_of_map(feature("Point", "[50,140]"), &frame).find("longitude comes first"),
      std::string::npos);
  EXPECT_NE(error_of_map(feature("Point", "[50,14]"), &frame).find("km from the origin"),
            std::string::npos);
  EXPECT_NE(error_of_map(feature("Point", "[NaN,14]")), "");
}

TEST(Map, SaysWhyThatIsNoZone) {
  const std::vector<std::pair<std::string, const char*>> errors = {
      {feature("Polygon", "[[[0,0],[100,100],[100,0],[0,90],[0,0]]]"), "crosses itself"},
      {feature("LineString", "[[0,0],[10,10]]"), "is a line, which is no zone"},
      {feature("Point", "[0,0]"), "without radius_m"},
      {feature("Point", "[0,0]", R"("radius_m":0)"), "radius_m is 0"},
      {feature("Point", "[0,0]", R"("radius_m":-4)"), "radius_m is -4"},
      {feature("Polygon", "[" + kSquare + "]", R"("floor_m":300,"ceiling_m":100)"),
       "floor_m 300 is above ceiling_m 100"},
      {feature("Polygon", "[" + kSquare + "]", R"("from_s":9,"until_s":1)"),
       "from_s 9 is after until_s 1"},
      {feature("Polygon", "[" + kSquare + "," + kSquare + "]"), "leave nothing"}};
  for (const auto& [text, said] : errors)
    EXPECT_NE(error_of_zones(text).find(said), std::string::npos) << said << "\n"
                                                                  << error_of_zones(text);
}

TEST(Map, WarnsOfPropertiesThatLookLikeItsOwn) {
  const auto got = read(feature("Polygon", "[" + kSquare + "]",
                                R"("ceiling_ft":900,"floor":3,"colour":"red")"));
  ASSERT_EQ(got.warnings.size(), 2u);
  EXPECT_NE(got.warnings[0].find("is ceiling_m meant?"), std::string::npos);
  EXPECT_NE(got.warnings[1].find("is floor_m meant?"), std::string::npos);
}

TEST(Map, AnAreaAndALineAreOneEach) {
  const auto two = read(collection(feature("Polygon", "[" + kSquare + "]") + "," +
                                   feature("Polygon", "[" + kSquare + "]")));
  EXPECT_NE(
      area_of(two.features.value()).error().text().find("feature 1: is a second area"),
      std::string::npos);
  const auto point = read(feature("Point", "[0,0]"));
  EXPECT_FALSE(area_of(point.features.value()).ok());
  EXPECT_FALSE(line_of(point.features.value()).ok());
  const auto one = read(feature("Polygon", "[" + kSquare + "]"));
  const auto rim = line_of(one.features.value()).value();
  EXPECT_EQ(rim.points.size(), 5u);
  EXPECT_EQ(rim.points.front(), rim.points.back());
}

TEST(Map, ObstaclesNeedTheirSizesAndAltitude) {
  const auto error = [](const std::string& text) {
    const auto movers = movers_of(read(text).features.value());
    return movers ? "" : movers.error().text();
  };
  EXPECT_NE(error(feature("Point", "[0,0]", R"("radius_m":5)")).find("has no height_m"),
            std::string::npos);
  EXPECT_NE(error(feature("Point", "[0,0]", R"("radius_m":5,"height_m":5)"))
                .find("has no altitude"),
            std::string::npos);
  EXPECT_NE(error(feature("LineString", "[[0,0],[5,5]]")).find("is no point"),
            std::string::npos);
  EXPECT_EQ(error(feature("Point", "[0,0,120]", R"("radius_m":5,"height_m":5)")), "");
}

TEST(Map, MayBeEmpty) {
  const auto none = read(collection(""));
  ASSERT_TRUE(none.features.ok());
  EXPECT_TRUE(none.features.value().empty());
  EXPECT_TRUE(zones_of(none.features.value()).value().empty());
  EXPECT_FALSE(area_of(none.features.value()).ok());
}

TEST(Map, ObstaclesAmongZonesAreCounted) {
  const auto got = read(collection(
      feature("Point", "[0,0]", R"("radius_m":5,"velocity_east_mps":2)") + "," +
      feature("Point", "[0,0]", R"("radius_m":5)") + "," +
      feature("Point", "[0,0]", R"("what":"obstacle","radius_m":5,"height_m":5)")));
  EXPECT_EQ(movers_among_zones(got.features.value()), 1);
}

TEST(Map, ErrorsEndWithOneFullStop) {
  EXPECT_EQ(error_of_map("hello").find(".."), std::string::npos) << error_of_map("hello");
}

TEST(Map, AMissingFileIsNotThere) {
  std::vector<std::string> warnings;
  EXPECT_EQ(read_map("nothing.geojson", nullptr, warnings).error().code,
            ErrorCode::kNotFound);
}

TEST(MapFiles, AnAreaThatIsCutAtTheDateLineIsOne) {
  const geo::LocalFrame fiji = geo::LocalFrame::at({-16.8, 180, 0}).value();
  const auto ring = [](double west, double east) {
    return fmt::format(
        "[[[{0},-16.805],[{1},-16.805],[{1},-16.795],[{0},-16.795],"
        "[{0},-16.805]]]",
        west, east);
  };
  const Read cut =
      read(collection(feature("MultiPolygon", "[" + ring(179.995, 180) + "," +
                                                  ring(-180, -179.995) + "]")),
           &fiji);
  ASSERT_TRUE(cut.features) << cut.features.error().text();
  ASSERT_EQ(cut.features.value().size(), 1u);
  const auto area = area_of(cut.features.value());
  ASSERT_TRUE(area) << area.error().text();
  EXPECT_NEAR(geo::area({area.value().points}), 1.18e6, 0.01e6);
  const Read apart =
      read(collection(feature("MultiPolygon", "[" + ring(179.995, 179.997) + "," +
                                                  ring(-180, -179.995) + "]")),
           &fiji);
  EXPECT_EQ(apart.features.value().size(), 2u);
}

TEST(MapFiles, PlacesBeyondTheHorizonAreFarNotNear) {
  const geo::LocalFrame here = geo::LocalFrame::at({50, 14, 0}).value();
  // The plane folds back there: the antipode would lie at the origin.
  EXPECT_NE(error_of_map(collection(feature("Point", "[-166,-50]")), &here)
                .find("km from the origin"),
            std::string::npos);
}

// A map may not choose whom this machine asks: a server that waits sees nobody.
TEST(MapTest, NothingIsFetchedFromTheNetwork) {
  const int server = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::bind(server, reinterpret_cast<sockaddr*>(&place), sizeof place), 0);
  ASSERT_EQ(::listen(server, 4), 0);
  socklen_t size = sizeof place;
  ASSERT_EQ(::getsockname(server, reinterpret_cast<sockaddr*>(&place), &size), 0);
  const std::string host = fmt::format("127.0.0.1:{}", ntohs(place.sin_port));
  const MapFile linked(
      "linked.geojson",
      fmt::format(R"({{"type":"FeatureCollection","crs":{{"type":"link","properties":)"
                  R"({{"href":"http://{}/crs","type":"proj4"}}}},"features":[{}]}})",
                  host, feature("Polygon", "[[[7,50],[7.01,50],[7.01,50.01],[7,50]]]")));
  std::vector<std::string> warnings;
  EXPECT_FALSE(read_map(linked.name, nullptr, warnings));
  for (const std::string& name :
       {"/vsicurl/http://" + host + "/a.geojson",
        "/vsicurl?url=http%3A%2F%2F" + host + "%2Fa.geojson",
        "/vsizip//vsicurl/http://" + host + "/a.zip", "/vsis3/" + host + "/a.geojson"}) {
    const auto map = read_map(name, nullptr, warnings);
    ASSERT_FALSE(map) << name;
    EXPECT_NE(map.error().text().find("is a name of GDAL's"), std::string::npos)
        << map.error().text();
  }
  EXPECT_EQ(::accept(server, nullptr, nullptr), -1) << "somebody asked";
  ::close(server);
}

}  // namespace
}  // namespace skein::exchange::map_test
