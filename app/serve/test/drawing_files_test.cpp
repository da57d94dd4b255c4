// SPDX-License-Identifier: Apache-2.0
#include "app/serve/drawing_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace skein::serve::drawing_files_test {
namespace {

using Json = nlohmann::json;

struct Drawn {
  unsigned status;
  Json json;
};

Drawn ask(const std::string& body, AccessRole role = AccessRole::kOperator,
          const char* method = "POST", const char* query = "name=a%20b%0a.geojson") {
  static const geo::LocalFrame frame = geo::LocalFrame::at({38.92, -121.03, 0}).value();
  hmi::HttpRequest request;
  request.method = method;
  request.path = kDrawingsPath;
  request.query = query;
  request.body = body;
  request.access.role = role;
  const hmi::HttpAnswer answer = drawings_of(request, frame);
  return {answer.status, Json::parse(*answer.body)};
}

std::string area_at(double x, double y, const std::string& crs = "") {
  const double d = std::abs(x) > 1000 ? 300 : 0.003;
  const auto at = [](double a, double b) {
    return "[" + std::to_string(a) + "," + std::to_string(b) + "]";
  };
  return R"({"type":"FeatureCollection",)" + crs +
         R"("features":[{"type":"Feature","properties":{"name":"A"},"geometry":{"type":)"
         R"("Polygon","coordinates":[[)" +
         at(x, y) + "," + at(x + d, y) + "," + at(x + d, y + d) + "," + at(x, y) +
         "]]}}]}";
}

TEST(DrawingFiles, AreReadAsTheCommandLineReadsThem) {
  const Drawn degrees = ask(area_at(-121.03, 38.925));
  ASSERT_EQ(degrees.status, 200u) << degrees.json;
  const Json& feature = degrees.json["features"][0];
  EXPECT_EQ(feature["kind"], "area");
  double south = 1e9;
  for (const Json& corner : feature["rings"][0])
    south = std::min(south, corner[0].get<double>());
  EXPECT_NEAR(south, 555, 2);
  // Metres of a projection that the file names; the same, and swapped, without one.
  const Drawn utm = ask(area_at(670802, 4310000,
                                R"("crs":{"type":"name","properties":{"name":)"
                                R"("urn:ogc:def:crs:EPSG::32610"}},)"));
  ASSERT_EQ(utm.status, 200u) << utm.json;
  EXPECT_LT(std::abs(utm.json["features"][0]["rings"][0][0][1].get<double>()), 2000);
  EXPECT_EQ(ask(area_at(-13472997, 4711054)).status, 422u);
  const Drawn swapped = ask(area_at(38.925, -121.03));
  EXPECT_EQ(swapped.status, 422u);
  EXPECT_NE(swapped.json["error"].get<std::string>().find("longitude comes first"),
            std::string::npos);
  EXPECT_EQ(swapped.json["error"].get<std::string>().rfind("a b?.geojson: ", 0), 0u);
}

TEST(DrawingFiles, KeepFencesAndCircles) {
  const Drawn plan = ask(
      R"({"fileType":"Plan","geoFence":{"version":2,"polygons":[],"circles":[{"inclusion":
      false,"circle":{"center":[38.92,-121.03],"radius":40}}]}})");
  ASSERT_EQ(plan.status, 200u) << plan.json;
  const Json& circle = plan.json["features"][0];
  EXPECT_EQ(circle["purpose"], "exclusion");
  EXPECT_EQ(circle["kind"], "circle");
  EXPECT_EQ(circle["radius_m"], 40);
}

TEST(DrawingFiles, TakeNoOtherQueryThanTheirName) {
  const std::string map = area_at(-121.03, 38.925);
  const Drawn refused = ask(map, AccessRole::kOperator, "POST", "name=a&epsg=32610");
  EXPECT_EQ(refused.status, 400u);
  const std::string error = refused.json["error"];
  EXPECT_NE(error.find("epsg"), std::string::npos) << error;
  EXPECT_NE(error.find("Allowed: name."), std::string::npos) << error;
  EXPECT_EQ(ask(map, AccessRole::kOperator, "POST", "").status, 200u);
}

TEST(DrawingFiles, AreForThoseWhoSteer) {
  EXPECT_EQ(ask(area_at(-121.03, 38.925), AccessRole::kViewer).status, 403u);
  EXPECT_EQ(ask("", AccessRole::kOperator, "GET").status, 405u);
  for (const char* nonsense : {"", "hello", "<", "{", "\xFF\xFE", "<kml/>"})
    EXPECT_EQ(ask(nonsense).status, 422u) << nonsense;
}

}  // namespace
}  // namespace skein::serve::drawing_files_test
