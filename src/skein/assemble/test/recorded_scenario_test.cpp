// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/recorded_scenario.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace skein::assemble::recorded_scenario_test {
namespace {

// A square with a side of `degrees` about 38.9 N, 121 W, burnt at `time`.
std::string square(const std::string& time, double degrees) {
  const double low = 38.9 - degrees / 2, high = 38.9 + degrees / 2;
  const double west = -121 - degrees / 2, east = -121 + degrees / 2;
  std::string ring;
  for (const auto& [x, y] :
       {std::pair{west, low}, {east, low}, {east, high}, {west, high}, {west, low}})
    ring +=
        (ring.empty() ? "[" : ",[") + std::to_string(x) + "," + std::to_string(y) + "]";
  return R"({"type":"Feature","properties":{"time":")" + time +
         R"("},"geometry":{"type":"Polygon","coordinates":[[)" + ring + "]]}}";
}

TEST(RecordedScenario, TakesPlaceSizeDurationAndDateFromTheData) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "recorded_scenario";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "fire.geojson") << R"({"type":"FeatureCollection","features":[)"
                                         << square("2021-08-04T23:43:00Z", 0.01) << ","
                                         << square("2021-08-05T00:35:00Z", 0.02) << "]}";
  const auto recorded = read_recorded_scenario(folder, {});
  ASSERT_TRUE(recorded) << recorded.error().text();
  const auto fitted = recorded_overrides(recorded.value());
  const auto has = [&](const std::string& text) {
    return std::any_of(fitted.begin(), fitted.end(),
                       [&](const std::string& o) { return o.starts_with(text); });
  };
  EXPECT_TRUE(has("start_utc=2021-08-04T23:43:00Z"));
  EXPECT_TRUE(has("duration_s=3120"));
  EXPECT_TRUE(has("origin.latitude_deg=38.9000"));
  EXPECT_TRUE(has("origin.longitude_deg=-121.0000"));
  // 1,110 m by 868 m: the circle of that area has a radius of 554 m.
  EXPECT_TRUE(has("missions[0].prior.radius_m=554"));
  EXPECT_TRUE(has("environment.terrain=flat"));
}

TEST(RecordedScenario, SaysWhatIsMissing) {
  const auto none = read_recorded_scenario("no/such/folder", {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace skein::assemble::recorded_scenario_test
