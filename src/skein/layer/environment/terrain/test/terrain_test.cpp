// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "skein/base/random.h"
#include "skein/layer/environment/raster/test/make_raster.h"
#include "skein/layer/environment/terrain/raster_terrain.h"
#include "skein/layer/environment/terrain/synthetic_terrain.h"

namespace skein::environment::terrain_test {
namespace {

std::vector<std::string> warnings;

// The law of every terrain: gradient() is the derivative of elevation_msl().
void expect_gradient_matches(const Terrain& terrain, double reach, double tolerance) {
  RandomStream random(3, 0, Purpose::kTest);
  const double h = 1e-3;
  for (int i = 0; i < 500; ++i) {
    const Vec2 p(random.uniform(-reach, reach), random.uniform(-reach, reach));
    const Vec2 g = terrain.gradient(p);
    const Vec2 north(h, 0), east(0, h);
    const auto z = [&](const Vec2& q) { return terrain.elevation_msl(q); };
    EXPECT_NEAR(g.x(), (z(p + north) - z(p - north)) / (2 * h), tolerance)
        << p.transpose();
    EXPECT_NEAR(g.y(), (z(p + east) - z(p - east)) / (2 * h), tolerance) << p.transpose();
  }
}

TEST(SyntheticTerrain, GradientsAreDerivatives) {
  // Central differences over 2 mm: rounding of some 500 m leaves 1e-13 * 500 / 2e-3.
  expect_gradient_matches(FlatTerrain({120}), 5000, 1e-12);
  expect_gradient_matches(HillTerrain({50, 200, 400, Vec2(100, -50)}), 2000, 1e-7);
  expect_gradient_matches(CanyonTerrain({}), 5000, 1e-7);
}

TEST(HillTerrain, HasItsHeightAndSteepestSlopeWhereStated) {
  const HillTerrain hill({50, 200, 400, Vec2(100, -50)});
  EXPECT_DOUBLE_EQ(hill.elevation_msl(Vec2(100, -50)), 250);
  EXPECT_NEAR(hill.elevation_msl(Vec2(100, 1e5)), 50, 1e-12);
  const double steepest = hill.gradient(Vec2(500, -50)).norm();
  EXPECT_NEAR(steepest, 200.0 / 400 * std::exp(-0.5), 1e-12);
  EXPECT_LT(hill.gradient(Vec2(450, -50)).norm(), steepest);
  EXPECT_LT(hill.gradient(Vec2(550, -50)).norm(), steepest);
}

TEST(CanyonTerrain, IsACanyonAsDeepAndSteepAsItSays) {
  const CanyonTerrainOptions options;
  const CanyonTerrain canyon(options);
  const Vec2 along = geo::unit(options.bearing), across = geo::turned_right(along);
  double steepest = 0;
  for (double s = -4000; s <= 4000; s += 50) {
    const double river =
        options.meander * std::sin(2 * geo::kPi * s / options.meander_length);
    const Vec2 bed = s * along + river * across;
    EXPECT_NEAR(canyon.elevation_msl(bed), options.floor - options.fall * s, 1e-9);
    for (const double side : {-1.0, 1.0}) {
      const double rim = canyon.elevation_msl(bed + side * 5 * options.width * across) -
                         canyon.elevation_msl(bed);
      EXPECT_GE(rim, options.depth * 0.999);
      EXPECT_LE(rim, options.depth + options.ridge);
      for (double c = 0; c < 1500; c += 50)
        steepest = std::max(steepest, canyon.gradient(bed + side * c * across).norm());
    }
  }
  EXPECT_GT(geo::degrees(std::atan(steepest)), 30);
  EXPECT_LT(geo::degrees(std::atan(steepest)), 45);
}

RasterRecipe plane_raster() {
  // Elevation 100 + 0.2 * easting offset, 20 m pixels, 4 km x 4 km in UTM 10 N.
  RasterRecipe recipe;
  recipe.columns = recipe.rows = 200;
  recipe.epsg = 32610;
  recipe.geo = {670000, 20, 0, 4312000, 0, -20};
  recipe.nodata = -9999;
  recipe.bands.resize(1);
  for (int r = 0; r < 200; ++r)
    for (int c = 0; c < 200; ++c) recipe.bands[0].push_back(100 + 0.2 * 20 * (c + 0.5));
  return recipe;
}

geo::LocalFrame frame_in_the_middle() {
  // 672000 E 4310000 N of zone 10 north (gdaltransform -s_srs EPSG:32610 -t_srs
  // EPSG:4326).
  return geo::LocalFrame::at({38.9220692210965, -121.015926783747, 0}).value();
}

TEST(RasterTerrain, ReadsAPlane) {
  const std::string path = scratch("plane.tif");
  make_raster(path, plane_raster());
  RasterTerrainOptions options;
  options.file = path;
  options.area = 1500;
  const auto terrain = make_raster_terrain(options, frame_in_the_middle(), warnings);
  ASSERT_TRUE(terrain.ok()) << terrain.error().text();
  EXPECT_NEAR(terrain.value()->elevation_msl(Vec2::Zero()), 100 + 0.2 * 2000, 0.01);
  // East on the map is turned by the convergence of 1.25 degrees; the scale errs by 1e-4.
  const Vec2 slope = terrain.value()->gradient(Vec2(33, 77));
  EXPECT_NEAR(slope.norm(), 0.2, 0.2 * 3e-4);
  EXPECT_NEAR(geo::degrees(geo::bearing(slope)), 90 + 1.246, 0.05);
  expect_gradient_matches(*terrain.value(), 1400, 1e-6);
}

TEST(RasterTerrain, OutsideIsAnErrorOrTheEdge) {
  const std::string path = scratch("plane.tif");
  make_raster(path, plane_raster());
  RasterTerrainOptions options;
  options.file = path;
  options.area = 3000;
  const auto refused = make_raster_terrain(options, frame_in_the_middle(), warnings);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().text().find("does not cover the area"), std::string::npos);
  EXPECT_EQ(refused.error().place, path);
  options.outside = Outside::kEdge;
  const auto edge = make_raster_terrain(options, frame_in_the_middle(), warnings);
  ASSERT_TRUE(edge.ok()) << edge.error().text();
  EXPECT_NEAR(edge.value()->elevation_msl(Vec2(0, 2900)), 100 + 0.2 * 3990, 2.1);
  EXPECT_NEAR(edge.value()->elevation_msl(Vec2(0, 1e6)), 100 + 0.2 * 3990, 2.1);
}

TEST(RasterTerrain, RefusesWhatIsNoElevation) {
  RasterRecipe recipe = plane_raster();
  recipe.nodata.reset();
  recipe.bands[0][200 * 100 + 100] = -9999;
  const std::string path = scratch("undeclared.tif");
  make_raster(path, recipe);
  RasterTerrainOptions options;
  options.file = path;
  options.area = 1000;
  const auto refused = make_raster_terrain(options, frame_in_the_middle(), warnings);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().text().find("declared"), std::string::npos);

  for (const double area : {0.0, -5.0, std::nan(""), 1e9}) {
    options.area = area;
    EXPECT_FALSE(make_raster_terrain(options, frame_in_the_middle(), warnings).ok())
        << area;
  }
  options.area = 1000;
  options.spacing = 1e-3;
  EXPECT_FALSE(make_raster_terrain(options, frame_in_the_middle(), warnings).ok());
  options.spacing = 1e7;  // coarser than the area: two points a side
  options.file = scratch("plane.tif");
  make_raster(options.file, plane_raster());
  EXPECT_TRUE(make_raster_terrain(options, frame_in_the_middle(), warnings).ok());
}

TEST(RasterTerrain, ObeysTheUnitOfTheFileOrTheKey) {
  const std::string path = scratch("feet.tif");
  RasterRecipe recipe = plane_raster();
  recipe.unit = "US survey foot";
  make_raster(path, recipe);
  RasterTerrainOptions options;
  options.file = path;
  options.area = 1500;
  const double metres = (100 + 0.2 * 2000) * 1200 / 3937;
  const auto feet = make_raster_terrain(options, frame_in_the_middle(), warnings);
  ASSERT_TRUE(feet.ok()) << feet.error().text();
  EXPECT_NEAR(feet.value()->elevation_msl(Vec2::Zero()), metres, 0.01);
  options.unit = "m";
  const auto key = make_raster_terrain(options, frame_in_the_middle(), warnings);
  ASSERT_TRUE(key.ok());
  EXPECT_NEAR(key.value()->elevation_msl(Vec2::Zero()), 500, 0.01);
  options.unit = "hPa";
  EXPECT_FALSE(make_raster_terrain(options, frame_in_the_middle(), warnings).ok());
  recipe.unit = "hPa";
  options.unit = "";
  options.file = scratch("pressure.tif");
  make_raster(options.file, recipe);
  const auto refused = make_raster_terrain(options, frame_in_the_middle(), warnings);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().text().find("\"hPa\""), std::string::npos);
}

TEST(RasterTerrain, TakesTheSeaForItsFloor) {
  RasterRecipe recipe = plane_raster();
  for (int r = 0; r < 40; ++r)
    for (int c = 0; c < 40; ++c)
      recipe.bands[0][static_cast<std::size_t>(200 * r + c)] = -900;
  RasterTerrainOptions options;
  options.file = scratch("coast.tif");
  options.area = 1900;
  options.outside = Outside::kEdge;
  make_raster(options.file, recipe);
  std::vector<std::string> said;
  const auto coast = make_raster_terrain(options, frame_in_the_middle(), said);
  ASSERT_TRUE(coast.ok()) << coast.error().text();
  EXPECT_NEAR(coast.value()->elevation_msl(Vec2::Zero()), 500, 0.01);
  EXPECT_EQ(coast.value()->elevation_msl(Vec2(1800, -1800)), 0);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("sea"), std::string::npos);
}

TEST(RasterTerrain, ATruncatedFileIsRefused) {
  const std::string path = scratch("cut.tif");
  make_raster(path, plane_raster());
  cut_file(path, 0.5);
  RasterTerrainOptions options;
  options.file = path;
  options.area = 1500;
  const auto refused = make_raster_terrain(options, frame_in_the_middle(), warnings);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().place, path);
}

TEST(RasterTerrain, OfTheBridgeFireHasTheStatedRelief) {
  const std::string file =
      std::string(SKEIN_SHARED_DATA) + "/fires/bridge_2021/landscape/elevation.tif";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  RasterTerrainOptions options;
  options.file = file;
  options.area = 3000;
  options.spacing = 10;
  const auto frame = geo::LocalFrame::at({38.9212722, -121.0351222, 0}).value();
  const auto terrain = make_raster_terrain(options, frame, warnings);
  ASSERT_TRUE(terrain.ok()) << terrain.error().text();
  double low = 1e9, high = -1e9;
  for (double n = -3000; n <= 3000; n += 30)
    for (double e = -3000; e <= 3000; e += 30) {
      const double z = terrain.value()->elevation_msl(Vec2(n, e));
      low = std::min(low, z);
      high = std::max(high, z);
    }
  EXPECT_GE(low, 137);  // the data's README: 137-724 m in the whole raster
  EXPECT_LE(high, 724);
  EXPECT_GT(high - low, 200);
}

TEST(RasterTerrain, OfAskerveinMatchesPixelsReadByHand) {
  const std::string file =
      std::string(SKEIN_SHARED_DATA) + "/terrain/askervein/askervein.tif";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  // Middle of pixel (128, 128): gdallocationinfo -valonly askervein.tif 128 128, its
  // place by gdaltransform -t_srs EPSG:4326 askervein.tif <<< "128.5 128.5".
  const auto frame = geo::LocalFrame::at({57.186130831888, -7.37080852426092, 0}).value();
  RasterTerrainOptions options;
  options.file = file;
  options.area = 1500;
  options.spacing = 20;
  const auto terrain = make_raster_terrain(options, frame, warnings);
  ASSERT_TRUE(terrain.ok()) << terrain.error().text();
  // 1e-7 degrees of the place is 1 cm; slopes here are below 0.5.
  EXPECT_NEAR(terrain.value()->elevation_msl(Vec2::Zero()), 115.362998962402, 0.01);
}

}  // namespace
}  // namespace skein::environment::terrain_test
