// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "skein/scenario/scenario_file.h"
#include "skein/scenario/test/fake_kinds.h"

namespace skein::scenario::place_test {
namespace {

// Knows a point, a line and an area, wherever they are asked for.
Result<std::vector<Vec2>> fake_features(const std::string& file, const std::string& name,
                                        FeatureUse use, const geo::LocalFrame& frame) {
  if (name == "tower" && use == FeatureUse::kPoint)
    return std::vector<Vec2>{frame.to_plane(50.001, 14)};
  if (name == "road" && use == FeatureUse::kLine)
    return std::vector<Vec2>{{0, 0}, {100, 0}, {100, 50}};
  if (name == "field" && use == FeatureUse::kArea)
    return std::vector<Vec2>{{0, 0}, {9, 0}, {9, 9}};
  return Error{ErrorCode::kNotFound, file.substr(file.rfind('/') + 1),
               "has no such feature.", ""};
}

ReadOutcome read(const std::string& text) {
  KindTable kinds = test::fake_kinds();
  kinds.set_feature_reader(fake_features);
  return read_scenario_text(text, "test.yaml", ".", kinds);
}

constexpr const char* kOrigin = "origin: {latitude_deg: 50, longitude_deg: 14}\n";

TEST(Places, AreLocalMetresOrLatitudeAndLongitudeFromTheOriginOfTheFile) {
  const auto outcome =
      read(std::string("environment: {objects: [{position_m: {latitude_deg: 50.01, "
                       "longitude_deg: 14.02}}, {position_m: [30, 40]}]}\n") +
           kOrigin);  // whatever the order of the keys
  ASSERT_TRUE(outcome.ok()) << outcome.report();
  const auto frame = geo::LocalFrame::at({50, 14, 0}).value();
  const auto& objects = outcome.scenario->environment.objects;
  EXPECT_EQ(objects[0].position, frame.to_plane(50.01, 14.02));
  EXPECT_NEAR(objects[0].position.x(), 1112, 2);  // a hundredth of a degree
  EXPECT_NEAR(objects[0].position.y(), 1434, 3);
  EXPECT_EQ(objects[1].position, Vec2(30, 40));
}

TEST(Places, OfAnOpenedScenarioAreReadOnceForEachOrigin) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "places_test";
  std::filesystem::create_directories(folder);
  const auto file = folder / "s.yaml";
  std::ofstream(folder / "map.geojson") << "{}";
  std::ofstream(file) << kOrigin
                      << "environment: {objects: [{position_m: {feature: tower, file: "
                         "map.geojson}}]}\n";
  KindTable kinds = test::fake_kinds();
  int calls = 0;
  kinds.set_feature_reader([&](const std::string& map, const std::string& name,
                               FeatureUse use, const geo::LocalFrame& frame) {
    ++calls;
    return fake_features(map, name, use, frame);
  });
  const OpenedDocument opened = open_scenario(file);
  std::ofstream(file) << "nonsense: 1\n";
  const auto north_of = [&](const std::string& change) {
    const Override one[] = {{change}};
    const auto outcome = read_scenario(opened, kinds, one);
    EXPECT_TRUE(outcome.ok()) << outcome.report();
    return outcome.ok() ? outcome.scenario->environment.objects[0].position.x() : 0;
  };
  for (const char* change : {"seed=1", "seed=2", "duration_s=7"})
    EXPECT_NEAR(north_of(change), 111.2, 0.2);
  EXPECT_EQ(calls, 1);
  EXPECT_NEAR(north_of("origin.latitude_deg=50.001"), 0, 1e-6);
  EXPECT_EQ(calls, 2);
  EXPECT_NE(open_scenario(folder / "none.yaml").failure, "");
  EXPECT_FALSE(read_scenario(open_scenario(folder / "none.yaml"), kinds).ok());
  std::filesystem::remove_all(folder);
}

TEST(Places, AreNamedFeaturesOfMapFiles) {
  const auto outcome =
      read(std::string(kOrigin) +
           "environment:\n"
           "  objects: [{position_m: {feature: tower, file: map.geojson}}]\n"
           "  zones: [{name: a, ring_m: {feature: field, file: map.geojson}}]\n"
           "  zones_m: [{feature: field, file: map.geojson}]\n"
           "aircraft: [{count: 3, start: {placement: list, positions_m: {feature: road, "
           "file: map.geojson}}}]\n");
  ASSERT_TRUE(outcome.ok()) << outcome.report();
  const Scenario& scenario = *outcome.scenario;
  EXPECT_NEAR(scenario.environment.objects[0].position.x(), 111.2, 0.2);
  EXPECT_EQ(scenario.environment.zones[0].ring->size(), 3u);
  EXPECT_EQ(scenario.environment.zone_rings[0].size(), 3u);
  EXPECT_EQ(scenario.aircraft[0].start.positions[2], Vec2(100, 50));
}

TEST(Places, AreWrittenAsLocalMetres) {
  KindTable kinds = test::fake_kinds();
  kinds.set_feature_reader(fake_features);
  const auto outcome = read(std::string(kOrigin) +
                            "environment: {objects: [{position_m: {latitude_deg: 50.01, "
                            "longitude_deg: 14.02}}]}\n");
  ASSERT_TRUE(outcome.ok());
  const std::string text = write_scenario(*outcome.scenario, kinds);
  const auto again = read_scenario_text(text, "again.yaml", ".", kinds);
  ASSERT_TRUE(again.ok()) << again.report();
  EXPECT_EQ(again.scenario->environment.objects[0].position,
            outcome.scenario->environment.objects[0].position);
}

struct Case {
  const char* value;
  const char* says;
};

TEST(Places, SayWhatIsWrongAndWhatIsAllowed) {
  for (const Case& each :
       {Case{"{latitude_deg: 50}", "has no longitude_deg"},
        Case{"{latitude_deg: 91, longitude_deg: 0}", "91 must be from -90 to 90"},
        Case{"{lat: 50, lon: 14}",
             "unknown key \"lat\" of a place. A place is [north, "
             "east], {latitude_deg"},
        Case{"{feature: nowhere, file: map.kml}", "map.kml: has no such feature"},
        Case{"{feature: road}", "needs the name of a file"},
        Case{"{file: [a]}", "needs the name of a file"},
        Case{"{latitude_deg: x, longitude_deg: 0}", "found \"x\""},
        Case{"5", "needs [north, east], a latitude and longitude or a feature"}}) {
    const auto outcome =
        read(std::string(kOrigin) + "environment: {objects: [{position_m: " + each.value +
             "}]}\n");
    EXPECT_NE(outcome.report().find(each.says), std::string::npos)
        << each.value << ": " << outcome.report();
    EXPECT_NE(outcome.report().find("objects[0].position_m"), std::string::npos)
        << outcome.report();
  }
}

TEST(Places, AnOriginThatIsNotValidIsReportedOnce) {
  const auto outcome = read(
      "origin: {latitude_deg: 200}\nenvironment: {objects: [{position_m: "
      "{latitude_deg: 50.01, longitude_deg: 14.02}}]}\n");
  EXPECT_EQ(outcome.problem_count, 1u) << outcome.report();
}

TEST(Places, VelocitiesAreNone) {
  const auto outcome = read(
      std::string(kOrigin) +
      "environment: {gusts: [{at_s: 1, velocity_mps: {latitude_deg: 1, longitude_deg: "
      "2}}]}\n");
  EXPECT_NE(outcome.report().find("needs [north, east] each"), std::string::npos)
      << outcome.report();
}

}  // namespace
}  // namespace skein::scenario::place_test
