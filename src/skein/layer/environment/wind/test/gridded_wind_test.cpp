// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/wind/gridded_wind.h"

#include "skein/layer/environment/raster/test/make_raster.h"
#include "skein/layer/environment/wind/uniform_wind.h"

namespace skein::environment::gridded_wind_test {
namespace {

std::vector<std::string> warnings;

using geo::radians;

const double kLatitude = 38.9, kLongitude = -121.0;

geo::LocalFrame frame() {
  return geo::LocalFrame::at({kLatitude, kLongitude, 0}).value();
}

// 0.01 degree pixels in latitude and longitude about the origin, every band constant.
RasterRecipe constant_bands(const std::vector<double>& values) {
  RasterRecipe recipe;
  recipe.columns = recipe.rows = 40;
  recipe.epsg = 4326;
  recipe.geo = {kLongitude - 0.2, 0.01, 0, kLatitude + 0.2, 0, -0.01};
  for (const double v : values) recipe.bands.emplace_back(1600, v);
  return recipe;
}

GriddedWindOptions options_for(const std::string& file) {
  GriddedWindOptions options;
  options.file = file;
  options.area = 5000;
  options.unit = "m/s";
  return options;
}

Vec2 at(const WindField& wind, const Vec2& p, double seconds, double height = 0) {
  return geo::horizontal(
      wind.wind(Vec3(p.x(), p.y(), -height), Time::from_seconds(seconds)));
}

std::string refusal(const GriddedWindOptions& options) {
  const auto wind = make_gridded_wind(options, frame(), warnings);
  return wind.ok() ? std::string("accepted") : wind.error().text();
}

TEST(GriddedWind, SpeedAndFromBecomeAVelocityTo) {
  const std::string path = scratch("wind.tif");
  make_raster(path, constant_bands({6, 270}));
  const auto wind = make_gridded_wind(options_for(path), frame(), warnings);
  ASSERT_TRUE(wind.ok()) << wind.error().text();
  EXPECT_NEAR((at(*wind.value(), Vec2::Zero(), 0) - Vec2(0, 6)).norm(), 0, 1e-6);
  // 5 km to the east, true north leans west by 5000 m * tan(latitude) / R.
  const double lean = 5000 / 6.386e6 * std::tan(radians(kLatitude));
  const Vec2 east = at(*wind.value(), Vec2(0, 5000), 0);
  EXPECT_NEAR(east.x(), 6 * std::sin(lean), 6 * 0.02 * lean);
  EXPECT_NEAR(east.norm(), 6, 1e-6);
}

TEST(GriddedWind, DirectionsAcrossNorthAreMixedAsComponents) {
  RasterRecipe recipe = constant_bands({4, 0});
  for (int r = 0; r < 40; ++r)
    for (int c = 0; c < 40; ++c)
      recipe.bands[1][static_cast<std::size_t>(40 * r + c)] = c < 20 ? 350 : 10;
  const std::string path = scratch("wind.tif");
  make_raster(path, recipe);
  const auto wind = make_gridded_wind(options_for(path), frame(), warnings);
  ASSERT_TRUE(wind.ok()) << wind.error().text();
  const Vec2 middle = at(*wind.value(), Vec2::Zero(), 0);
  EXPECT_NEAR(middle.x(), -4 * std::cos(radians(10)), 1e-5);
  EXPECT_NEAR(middle.y(), 0, 1e-5);
}

TEST(GriddedWind, PairOfFilesInTimeIsLinearAndHeld) {
  const std::string u = scratch("u.tif"), v = scratch("v.tif");
  make_raster(u, constant_bands({1, 3, -1}));
  make_raster(v, constant_bands({0, 8, 8}));
  GriddedWindOptions options = options_for(u);
  options.second_file = v;
  options.kind = WindKind::kComponents;
  EXPECT_NE(refusal(options).find("times"), std::string::npos);
  options.times = {600, 0, 1200};  // in any order
  const auto wind = make_gridded_wind(options, frame(), warnings);
  ASSERT_TRUE(wind.ok()) << wind.error().text();
  const auto expect = [&](double t, const Vec2& want) {
    EXPECT_NEAR((at(*wind.value(), Vec2::Zero(), t) - want).norm(), 0, 1e-6) << t;
  };
  expect(-50, Vec2(8, 3));
  expect(0, Vec2(8, 3));
  expect(300, Vec2(4, 2));
  expect(600, Vec2(0, 1));
  expect(900, Vec2(4, 0));
  expect(5000, Vec2(8, -1));
}

TEST(GriddedWind, ComponentsOnAProjectedGridNeedTheirNorth) {
  RasterRecipe recipe;
  recipe.columns = recipe.rows = 40;
  recipe.epsg = 32610;  // central meridian 123 W
  recipe.geo = {660000, 1000, 0, 4330000, 0, -1000};
  recipe.bands = {std::vector<double>(1600, 0.0), std::vector<double>(1600, 5.0)};
  const std::string path = scratch("utm.tif");
  make_raster(path, recipe);
  GriddedWindOptions options = options_for(path);
  options.kind = WindKind::kComponents;
  EXPECT_NE(refusal(options).find("true north or to the grid"), std::string::npos);
  options.north = WindNorth::kTrue;
  const auto to_true = make_gridded_wind(options, frame(), warnings);
  ASSERT_TRUE(to_true.ok()) << to_true.error().text();
  EXPECT_NEAR((at(*to_true.value(), Vec2::Zero(), 0) - Vec2(5, 0)).norm(), 0, 1e-6);
  options.north = WindNorth::kGrid;
  const auto to_grid = make_gridded_wind(options, frame(), warnings);
  ASSERT_TRUE(to_grid.ok()) << to_grid.error().text();
  const double convergence =
      std::atan(std::tan(radians(kLongitude + 123)) * std::sin(radians(kLatitude)));
  // The transverse Mercator formula on a sphere: good to 1e-4 rad here.
  EXPECT_NEAR(geo::bearing(at(*to_grid.value(), Vec2::Zero(), 0)), convergence, 1e-4);
}

TEST(GriddedWind, HeightsAreLinearOrTheNearestIsChosen) {
  const std::vector<double> flat(9, 2.0), fast(9, 6.0), none(9, 0.0);
  const GridShape shape{Vec2(-100, -100), 100, 3, 3};
  const GriddedWind wind({Time()}, {10, 50},
                         {{GridField(shape, flat), GridField(shape, none)},
                          {GridField(shape, fast), GridField(shape, none)}});
  EXPECT_DOUBLE_EQ(at(wind, Vec2::Zero(), 0, 0).x(), 2);
  EXPECT_DOUBLE_EQ(at(wind, Vec2::Zero(), 0, 20).x(), 3);
  EXPECT_DOUBLE_EQ(at(wind, Vec2::Zero(), 0, 50).x(), 6);
  EXPECT_DOUBLE_EQ(at(wind, Vec2::Zero(), 0, 500).x(), 6);
}

TEST(GriddedWind, RefusesInvalidData) {
  const std::string path = scratch("wind.tif");
  make_raster(path, constant_bands({-2, 90}));
  EXPECT_NE(refusal(options_for(path)).find("speed of -2"), std::string::npos);
  make_raster(path, constant_bands({9999, 90}));
  EXPECT_NE(refusal(options_for(path)).find("speed of 9999"), std::string::npos);
  make_raster(path, constant_bands({5, 9999}));
  EXPECT_NE(refusal(options_for(path)).find("direction of 9999"), std::string::npos);
  make_raster(path, constant_bands({5, std::nan("")}));
  EXPECT_NE(refusal(options_for(path)).find("not a finite number"), std::string::npos);
  make_raster(path, constant_bands({5, 6, 7}));
  EXPECT_NE(refusal(options_for(path)).find("3 bands"), std::string::npos);
  make_raster(path, constant_bands({5, 90}));
  GriddedWindOptions options = options_for(path);
  EXPECT_EQ(refusal(options), "accepted");
  options.area = 50000;
  EXPECT_NE(refusal(options).find("does not cover"), std::string::npos);
  options.extend = true;
  EXPECT_EQ(refusal(options), "accepted");
  options.first = "speed";
  EXPECT_NE(refusal(options).find("no band named \"speed\""), std::string::npos);
  options = options_for(path);
  options.start_utc = "noon";
  EXPECT_NE(refusal(options).find("times"), std::string::npos);
  options = options_for(path);
  options.second_file = scratch("other.tif");
  RasterRecipe other = constant_bands({5, 90});
  (*other.geo)[0] += 0.05;
  make_raster(options.second_file, other);
  EXPECT_NE(refusal(options).find("differ in place"), std::string::npos);
  cut_file(path, 0.4);
  EXPECT_NE(refusal(options_for(path)).find(path), std::string::npos);
}

TEST(GriddedWind, ObeysTheUnitOfTheFileOrTheKey) {
  const std::string path = scratch("wind.tif");
  GriddedWindOptions options = options_for(path);
  options.unit = "";
  make_raster(path, constant_bands({10, 270}));
  EXPECT_NE(refusal(options).find("no unit"), std::string::npos);
  options.unit = "mph";
  const auto key = make_gridded_wind(options, frame(), warnings);
  ASSERT_TRUE(key.ok()) << key.error().text();
  EXPECT_NEAR(at(*key.value(), Vec2::Zero(), 0).norm(), 4.4704, 1e-6);
  options.unit = "furlongs";
  EXPECT_NE(refusal(options).find("\"furlongs\""), std::string::npos);
  RasterRecipe components = constant_bands({10, 0});
  components.unit = "km h**-1";
  make_raster(path, components);
  options.unit = "";
  options.kind = WindKind::kComponents;
  const auto file = make_gridded_wind(options, frame(), warnings);
  ASSERT_TRUE(file.ok()) << file.error().text();
  EXPECT_NEAR(at(*file.value(), Vec2::Zero(), 0).y(), 10 / 3.6, 1e-6);
}

TEST(GriddedWind, OfAWorldWideGridOnlyTheAreaCounts) {
  // Pixel centres from 0 to 359 degrees east and on both poles.
  RasterRecipe recipe;
  recipe.columns = 360;
  recipe.rows = 181;
  recipe.epsg = 4326;
  recipe.geo = {-0.5, 1, 0, 90.5, 0, -1};
  recipe.unit = "m/s";
  recipe.bands = {std::vector<double>(360 * 181, 3.0), std::vector<double>(360 * 181)};
  for (std::size_t i = 0; i < 360 * 181; ++i)
    recipe.bands[1][i] = i % 360 == 359 ? 6 : i % 360 == 0 ? 2 : 4;
  GriddedWindOptions options;
  options.file = scratch("world.tif");
  options.kind = WindKind::kComponents;
  options.area = 5000;
  make_raster(options.file, recipe);
  const auto of = [&](double longitude) {
    const auto here = geo::LocalFrame::at({51, longitude, 0}).value();
    const auto wind = make_gridded_wind(options, here, warnings);
    EXPECT_TRUE(wind.ok()) << wind.error().text();
    return wind.ok() ? at(*wind.value(), Vec2::Zero(), 0) : Vec2::Zero().eval();
  };
  EXPECT_NEAR((of(-121) - Vec2(4, 3)).norm(), 0, 1e-6);
  EXPECT_NEAR((of(0) - Vec2(2, 3)).norm(), 0, 1e-6);
  // The seam of the columns, half way between the last centre and the first.
  EXPECT_NEAR((of(-0.5) - Vec2(4, 3)).norm(), 0, 1e-3);
  EXPECT_NEAR((of(359.5) - Vec2(4, 3)).norm(), 0, 1e-3);
}

TEST(GriddedWind, NdfdForecastHasTheWindOfItsPixels) {
  const std::string file = std::string(SKEIN_SHARED_DATA) + "/wind/ndfd_20170603T1800.nc";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  GriddedWindOptions options;
  options.file = file;
  options.first = "Wind_speed_height_above_ground";
  options.second = "Wind_direction_from_which_blowing_height_above_ground";
  options.area = 8000;
  // Pixel values: gdallocationinfo -valonly NETCDF:<file>:<variable> 23 69, and 60 50.
  // Places of their middles: the inverse formulas of the Lambert conformal projection on
  // the sphere (standard parallel 25, central meridian 265, R 6371.2 km) with the geo
  // transform that gdalinfo prints, evaluated with Python, not with PROJ.
  struct Case {
    double latitude, longitude, speed, from;
  };
  for (const Case& c : {Case{42.991161982621946, -113.5062588525604, 4.625, 101},
                        Case{43.504359357490834, -112.49209348458257, 3.625, 142}}) {
    const auto here = geo::LocalFrame::at({c.latitude, c.longitude, 0}).value();
    const auto wind = make_gridded_wind(options, here, warnings);
    ASSERT_TRUE(wind.ok()) << wind.error().text();
    const Vec2 want = blowing_from(c.speed, radians(c.from));
    // The middle of a pixel to 1e-6 of its size; neighbours differ by less than 1 m/s.
    EXPECT_NEAR((at(*wind.value(), Vec2::Zero(), 0) - want).norm(), 0, 1e-5);
    // Both bands are of 2017-06-03T18:00Z alone: the wind holds.
    EXPECT_EQ(at(*wind.value(), Vec2::Zero(), 7200), at(*wind.value(), Vec2::Zero(), 0));
  }
  // Between pixels (23, 69) 4.625 m/s 101, (24, 69) 4.5 m/s 101, (23, 70) 4.6875 m/s 102
  // and (24, 70) 4.625 m/s 102: their corner has the mean of the four velocities.
  const Vec2 mean =
      (blowing_from(4.625, radians(101)) + blowing_from(4.5, radians(101)) +
       blowing_from(4.6875, radians(102)) + blowing_from(4.625, radians(102))) /
      4;
  // Corner (24, 70), as above.
  const auto corner =
      geo::LocalFrame::at({42.98190514999628, -113.48957711083418, 0}).value();
  const auto wind = make_gridded_wind(options, corner, warnings);
  ASSERT_TRUE(wind.ok()) << wind.error().text();
  EXPECT_NEAR((at(*wind.value(), Vec2::Zero(), 0) - mean).norm(), 0, 1e-5);

  options.first = "Wind_speed";
  const auto refused = make_gridded_wind(options, corner, warnings);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().text().find("Wind_speed_height_above_ground"),
            std::string::npos);
}

}  // namespace
}  // namespace skein::environment::gridded_wind_test
