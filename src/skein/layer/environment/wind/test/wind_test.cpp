// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "skein/layer/environment/wind/series_wind.h"
#include "skein/layer/environment/wind/uniform_wind.h"

namespace skein::environment::wind_test {
namespace {

Vec2 at(const WindField& wind, double seconds) {
  return geo::horizontal(wind.wind(Vec3(10, -20, -30), Time::from_seconds(seconds)));
}

TEST(UniformWind, FromTheWestBlowsEast) {
  const UniformWind wind({5, geo::radians(270)});
  EXPECT_NEAR((at(wind, 0) - Vec2(0, 5)).norm(), 0, 1e-14);
  EXPECT_EQ(wind.wind(Vec3::Zero(), Time()).z(), 0);
}

TEST(SeriesWind, InterpolatesComponentsNotAngles) {
  // From 350 to 10 degrees: the mean blows from north, not from south.
  const auto series =
      SeriesWind::parse("t_s,speed_mps,from_deg\n0,4,350\n100,4,10\n", "s.csv");
  ASSERT_TRUE(series.ok()) << series.error().text();
  const Vec2 middle = at(series.value(), 50);
  EXPECT_NEAR(middle.x(), -4 * std::cos(geo::radians(10)), 1e-14);
  EXPECT_NEAR(middle.y(), 0, 1e-14);
}

TEST(SeriesWind, HoldsItsEndsAndMeetsItsEntries) {
  const auto series = SeriesWind::parse(
      "east_mps,t_s,north_mps\n1,-10,2\n# gust\n3,20,8\n-5,40,0\n", "s.csv");
  ASSERT_TRUE(series.ok()) << series.error().text();
  EXPECT_EQ(at(series.value(), -1000), Vec2(2, 1));
  EXPECT_EQ(at(series.value(), -10), Vec2(2, 1));
  EXPECT_EQ(at(series.value(), 20), Vec2(8, 3));
  EXPECT_EQ(at(series.value(), 5), Vec2(5, 2));
  EXPECT_EQ(at(series.value(), 1000), Vec2(0, -5));
}

TEST(SeriesWind, RefusesWithFileAndLine) {
  const auto text = [](const char* content) {
    const auto series = SeriesWind::parse(content, "s.csv");
    return series.ok() ? std::string("accepted") : series.error().text();
  };
  EXPECT_NE(text("t_s,speed_mps\n0,1\n").find("from_deg"), std::string::npos);
  EXPECT_NE(text("t_s,speed_mps,from_deg\n").find("no rows"), std::string::npos);
  EXPECT_EQ(text("t_s,speed_mps,from_deg\n0,-1,0\n").find("s.csv:2"), 0u);
  EXPECT_EQ(text("t_s,speed_mps,from_deg\n0,1,0\n0,1,0\n").find("s.csv:3"), 0u);
  EXPECT_EQ(text("t_s,speed_mps,from_deg\n0,nan,0\n").find("s.csv:2"), 0u);
  EXPECT_EQ(text("t_s,speed_mps,from_deg\n1e300,1,0\n").find("s.csv:2"), 0u);
  EXPECT_FALSE(make_series_wind({"/no/such/wind.csv"}).ok());
}

}  // namespace
}  // namespace skein::environment::wind_test
