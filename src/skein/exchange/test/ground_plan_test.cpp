// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/gis/ground_plan.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "skein/exchange/gis/zones.h"

namespace skein::exchange::ground_plan_test {
namespace {

using Json = nlohmann::json;

const geo::LocalFrame& frame() {
  static const geo::LocalFrame at = geo::LocalFrame::at({47.4, 8.5, 0}).value();
  return at;
}

Json item(int command, double latitude, double longitude, int kind_of_frame = 3) {
  return {{"type", "SimpleItem"},
          {"command", command},
          {"frame", kind_of_frame},
          {"params", {0, 0, 0, nullptr, latitude, longitude, 50}}};
}

Json square(double half) {
  return {{47.4 + half, 8.5 - half},
          {47.4 + half, 8.5 + half},
          {47.4 - half, 8.5 + half},
          {47.4 - half, 8.5 - half}};
}

Json plan(const Json& items, const Json& fence = Json::object(),
          const Json& rally = Json::array()) {
  return {{"fileType", "Plan"},
          {"mission", {{"items", items}}},
          {"geoFence", fence},
          {"rallyPoints", {{"points", rally}}}};
}

struct GotPlan {
  std::vector<MapFeature> features;
  std::vector<std::string> warnings;
  std::string error;
};

GotPlan read_plan_of(const std::string& text) {
  GotPlan got;
  auto features = read_map_text(text, "f.plan", frame(), got.warnings);
  if (features)
    got.features = std::move(features).value();
  else
    got.error = features.error().text();
  return got;
}

TEST(GroundPlan, KeepsWhatEverythingIsFor) {
  const Json fence = {{"version", 2},
                      {"polygons",
                       {{{"inclusion", true}, {"polygon", square(0.01)}},
                        {{"inclusion", false}, {"polygon", square(0.001)}}}},
                      {"circles",
                       {{{"inclusion", false},
                         {"circle", {{"center", {47.405, 8.5}}, {"radius", 40}}}}}}};
  const Json items = {item(16, 47.401, 8.5),
                      item(16, 47.402, 8.5),
                      {{"type", "ComplexItem"}, {"polygon", square(0.002)}}};
  const GotPlan got = read_plan_of(plan(items, fence, {{47.4, 8.502, 50}}).dump());
  ASSERT_EQ(got.error, "");
  std::vector<std::string> purposes;
  for (const MapFeature& each : got.features) purposes.push_back(each.purpose);
  EXPECT_EQ(purposes, (std::vector<std::string>{"survey", "route", "inclusion",
                                                "exclusion", "exclusion", "rally"}));
  const auto zones = zones_of(got.features);
  ASSERT_TRUE(zones) << zones.error().text();
  EXPECT_EQ(zones.value().size(), 2u) << "the exclusion fences only";
  EXPECT_TRUE(area_of(got.features)) << "the survey";
}

TEST(GroundPlan, FliesThroughAllPlacesInTheirOrder) {
  const Json landing = {{"type", "ComplexItem"},
                        {"landingApproachCoordinate", {47.406, 8.5, 50}},
                        {"landCoordinate", {47.407, 8.5, 0}}};
  const GotPlan got = read_plan_of(
      plan({item(22, 47.400, 8.501), item(16, 47.401, 8.5), item(19, 47.402, 8.5),
            item(82, 47.403, 8.5), item(178, 0, 0, 2), item(21, 0, 0), landing})
          .dump());
  ASSERT_EQ(got.error, "");
  ASSERT_EQ(got.features.size(), 1u);
  EXPECT_EQ(got.features[0].points.size(), 6u);
  ASSERT_EQ(got.warnings.size(), 1u);
  EXPECT_NE(got.warnings[0].find("2 item(s)"), std::string::npos) << got.warnings[0];
}

TEST(GroundPlan, ReadsTheFenceOfTheFirstVersion) {
  const GotPlan got = read_plan_of(
      plan(Json::array(), {{"version", 1}, {"polygon", square(0.01)}}).dump());
  ASSERT_EQ(got.features.size(), 1u) << got.error;
  EXPECT_EQ(got.features[0].purpose, "inclusion");
  EXPECT_EQ(got.features[0].points.size(), 4u);
}

TEST(GroundPlan, RefusesWhatIsNone) {
  EXPECT_NE(read_plan_of(R"({"items":[{"coordinate":[1,2,3]}],"MAV_AUTOPILOT":3})")
                .error.find(".mission"),
            std::string::npos);
  EXPECT_NE(
      read_plan_of(plan(Json::array({item(16, 8.5, 47.4)})).dump()).error.find("km from"),
      std::string::npos);
  EXPECT_NE(read_plan_of(plan(Json::array({item(16, 147.4, 8.5)})).dump())
                .error.find("no latitude"),
            std::string::npos);
  for (const char* text : {"", "[]", "no", "{", R"({"fileType":7})",
                           R"({"fileType":"Plan","geoFence":{"circles":[7]}})"})
    EXPECT_NE(read_plan_of(text).error, "") << text;
}

// Taken for an inclusion, an exclusion fence would be the opposite of itself.
TEST(GroundPlan, AFenceThatDoesNotSayWhichWayRoundIsRefused) {
  const auto error_of = [](const Json& sense, bool circle) {
    Json part = {{"polygon", square(0.01)},
                 {"circle", {{"center", {47.405, 8.5}}, {"radius", 40}}}};
    if (!sense.is_null()) part["inclusion"] = sense;
    const Json fence = {{"version", 2}, {circle ? "circles" : "polygons", {part}}};
    return read_plan_of(plan(Json::array(), fence).dump()).error;
  };
  for (const bool circle : {false, true}) {
    EXPECT_EQ(error_of(false, circle), "");
    EXPECT_EQ(error_of(true, circle), "");
    for (const Json& odd : {Json("false"), Json(0), Json(1), Json::object()})
      EXPECT_NE(error_of(odd, circle).find("true and false"), std::string::npos) << odd;
    EXPECT_NE(error_of(nullptr, circle).find("does not say"), std::string::npos);
  }
}

TEST(GroundPlan, OfGeoJsonKeepsThePurposeToo) {
  const GotPlan got = read_plan_of(
      R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":
      {"name":"A","purpose":"exclusion"},"geometry":{"type":"Polygon","coordinates":
      [[[8.5,47.4],[8.51,47.4],[8.51,47.41],[8.5,47.4]]]}}]})");
  ASSERT_EQ(got.features.size(), 1u) << got.error;
  EXPECT_EQ(got.features[0].purpose, "exclusion");
}

}  // namespace
}  // namespace skein::exchange::ground_plan_test
