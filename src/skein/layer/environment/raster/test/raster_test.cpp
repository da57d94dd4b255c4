// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/raster/raster_file.h"

#include <atomic>
#include <thread>

#include "skein/geo/gdal/gdal_guard.h"
#include "skein/layer/environment/raster/date_time.h"
#include "skein/layer/environment/raster/test/make_raster.h"

namespace skein::environment::raster_test {
namespace {

using geo::LocalFrame;

LocalFrame frame_at(double latitude_deg, double longitude_deg) {
  return LocalFrame::at({latitude_deg, longitude_deg, 0}).value();
}

// Latitude and longitude as pixel values on a 0.001 degree grid: any resampled value then
// says where it came from.
RasterRecipe position_raster() {
  RasterRecipe recipe;
  recipe.columns = 60;
  recipe.rows = 50;
  recipe.epsg = 4326;
  recipe.geo = {-121.03, 0.001, 0, 38.925, 0, -0.001};
  recipe.bands.resize(2);
  for (int r = 0; r < recipe.rows; ++r)
    for (int c = 0; c < recipe.columns; ++c) {
      recipe.bands[0].push_back(38.925 - 0.001 * (r + 0.5));
      recipe.bands[1].push_back(-121.03 + 0.001 * (c + 0.5));
    }
  recipe.names = {"latitude", "longitude"};
  return recipe;
}

const GridShape kSmall{Vec2(-900, -1100), 100, 19, 23};

TEST(UtcTime, ReadsIsoDates) {
  EXPECT_EQ(parse_utc("1970-01-01"), 0.0);
  EXPECT_EQ(parse_utc("2021-09-05T14:04:00-07:00"), parse_utc("2021-09-05 21:04Z"));
  EXPECT_EQ(parse_utc("2017-06-03T18:00:00Z"), 1496512800.0);  // date -u -d ... +%s
  EXPECT_EQ(parse_utc("2017-06-03T18:00:00.25+0530"), 1496512800.25 - 19800);
  for (const char* bad : {"", "2021", "2021-13-01", "2021-02-30", "2021-09-05T25:00",
                          "2021-09-05Tnoon", "yesterday", "2021-09-05T14:04:00 local"})
    EXPECT_FALSE(parse_utc(bad)) << bad;
}

TEST(GridField, IsBilinearAndHoldsItsEdge) {
  const GridShape shape{Vec2(10, 20), 2, 3, 4};
  std::vector<double> values;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) values.push_back(3.0 * r - 5.0 * c + 0.5 * r * c);
  const GridField field(shape, values);
  // 3 r - 5 c + r c / 2 is itself bilinear, so that interpolation is exact.
  const Vec2 p(12.6, 23.4);
  const double r = 1.3, c = 1.7;
  EXPECT_NEAR(field.at(p), 3 * r - 5 * c + 0.5 * r * c, 1e-12);
  EXPECT_NEAR(field.gradient(p).x(), (3 + 0.5 * c) / 2, 1e-12);
  EXPECT_NEAR(field.gradient(p).y(), (-5 + 0.5 * r) / 2, 1e-12);
  EXPECT_EQ(field.at(Vec2(-100, 20)), field.value(0, 0));
  EXPECT_EQ(field.at(Vec2(100, 100)), field.value(2, 3));
  EXPECT_EQ(field.gradient(Vec2(100, 100)), Vec2::Zero());
  EXPECT_TRUE(field.covers(shape.high()));
  EXPECT_FALSE(field.covers(shape.high() + Vec2(1e-9, 0)));
  EXPECT_TRUE(std::isnan(field.at(Vec2(std::nan(""), 21))));
}

TEST(GridCovering, ReachesTheFarCorner) {
  const GridShape shape = grid_covering(Vec2(0, 0), Vec2(10, 25), 10);
  EXPECT_EQ(shape.rows, 2);
  EXPECT_EQ(shape.columns, 4);
  EXPECT_GE(shape.high().y(), 25);
}

TEST(RasterFile, ReprojectsToWithinCentimetres) {
  const std::string path = scratch("position.tif");
  make_raster(path, position_raster());
  const LocalFrame frame = frame_at(38.9, -121.0);
  for (const char* name : {"latitude", "longitude"}) {
    const auto field = read_grid(path, 1, name, frame, kSmall, Missing::kError);
    ASSERT_TRUE(field.ok()) << field.error().text();
    for (int r = 0; r < kSmall.rows; ++r)
      for (int c = 0; c < kSmall.columns; ++c) {
        const geo::Geodetic g = frame.from_plane(kSmall.node(r, c));
        const double want = name[1] == 'a' ? g.latitude_deg : g.longitude_deg;
        // Latitude and longitude are linear in the pixels, so only the coarse lattice
        // errs, by at most 2 mm = 2.3e-8 degrees of longitude.
        EXPECT_NEAR(field.value().value(r, c), want, 2.3e-8);
      }
  }
}

TEST(RasterFile, SamplesTheSameThroughAProjectedSystem) {
  // UTM zone 10 north, 30 m: easting and northing as values, compared with the forward
  // projection of GeographicLib's frame through GDAL's inverse.
  RasterRecipe recipe;
  recipe.columns = recipe.rows = 200;
  recipe.epsg = 32610;
  recipe.geo = {670000, 30, 0, 4312000, 0, -30};
  recipe.bands.resize(2);
  for (int r = 0; r < 200; ++r)
    for (int c = 0; c < 200; ++c) {
      recipe.bands[0].push_back(c + 0.5);
      recipe.bands[1].push_back(r + 0.5);
    }
  const std::string path = scratch("utm.tif");
  make_raster(path, recipe);
  const auto file = RasterFile::open(path);
  ASSERT_TRUE(file.ok()) << file.error().text();
  const geo::Geodetic middle = file.value().geodetic(Vec2(100, 100)).value();
  const LocalFrame frame = LocalFrame::at(middle).value();
  const GridShape shape{Vec2(-1500, -1500), 50, 61, 61};
  const auto columns = read_grid(path, 1, "", frame, shape, Missing::kError);
  const auto rows = read_grid(path, 2, "", frame, shape, Missing::kError);
  ASSERT_TRUE(columns.ok()) << columns.error().text();
  for (int r = 0; r < shape.rows; r += 6)
    for (int c = 0; c < shape.columns; c += 6) {
      const geo::Geodetic g =
          file.value()
              .geodetic(Vec2(columns.value().value(r, c), rows.value().value(r, c)))
              .value();
      // 2 mm of the lattice, as pixels and back.
      EXPECT_LT(
          (frame.to_plane(g.latitude_deg, g.longitude_deg) - shape.node(r, c)).norm(),
          0.003);
    }
  EXPECT_NEAR(file.value().pixel_size(frame).value(), 30,
              0.02);  // UTM scale 0.9996-1.001
}

TEST(PixelMap, KnowsGridNorthAndTrueNorth) {
  const std::string path = scratch("utm.tif");
  RasterRecipe recipe;
  recipe.columns = recipe.rows = 100;
  recipe.epsg = 32610;  // central meridian 123 W
  recipe.geo = {670000, 30, 0, 4312000, 0, -30};
  recipe.bands = {std::vector<double>(10000, 1)};
  make_raster(path, recipe);
  const auto file = RasterFile::open(path).value().geodetic(Vec2(50, 50)).value();
  const LocalFrame frame = LocalFrame::at(file).value();
  const GridShape shape{Vec2(-1000, -1000), 1000, 3, 3};
  const auto map = RasterFile::open(path).value().map(frame, shape).value();
  EXPECT_NEAR(map.true_north(1, 1), 0, 1e-9);
  // Convergence of the Mercator projection: atan(tan(dlon) sin(lat)); grid north lies
  // clockwise of true north by it, east of the central meridian.
  const double convergence = std::atan(std::tan(geo::radians(file.longitude_deg + 123)) *
                                       std::sin(geo::radians(file.latitude_deg)));
  EXPECT_NEAR(map.grid_north(1, 1), convergence, 1e-5);
  // 1 km east the meridian leans west by dlon sin(lat), towards the pole.
  const double lean = 1000 / 6.386e6 * std::tan(geo::radians(file.latitude_deg));
  EXPECT_NEAR(map.true_north(1, 2), -lean, 0.01 * lean);
}

TEST(RasterFile, LongitudesFrom0To360) {
  RasterRecipe recipe = position_raster();
  (*recipe.geo)[0] += 360;
  const std::string path = scratch("turn.tif");
  make_raster(path, recipe);
  const LocalFrame frame = frame_at(38.9, -121.0);
  const auto field = read_grid(path, 2, "", frame, kSmall, Missing::kError);
  ASSERT_TRUE(field.ok()) << field.error().text();
  EXPECT_NEAR(field.value().at(Vec2::Zero()), -121.0, 1e-7);
}

TEST(RasterFile, UnpacksScaleAndOffset) {
  for (const char* driver : {"GTiff", "netCDF"}) {
    RasterRecipe recipe = position_raster();
    recipe.driver = driver;
    recipe.type = GDT_Int16;
    recipe.scale = 0.25;
    recipe.offset = -7;
    recipe.nodata = -32768;
    recipe.bands = {std::vector<double>(3000, 42)};
    recipe.bands[0][0] = -32768;  // far from the area used
    recipe.names.clear();
    const std::string path = scratch(std::string("packed.") + driver);
    make_raster(path, recipe);
    const auto field =
        read_grid(path, 1, "", frame_at(38.9, -121.0), kSmall, Missing::kError);
    ASSERT_TRUE(field.ok()) << driver << field.error().text();
    EXPECT_DOUBLE_EQ(field.value().at(Vec2::Zero()), 0.25 * 42 - 7) << driver;
  }
}

TEST(RasterFile, NoDataIsRefusedFilledOrKept) {
  RasterRecipe recipe = position_raster();
  recipe.nodata = -9999;
  for (int r = 20; r < 30; ++r)
    for (int c = 0; c < 30; ++c)
      recipe.bands[0][static_cast<std::size_t>(60 * r + c)] = -9999;
  const std::string path = scratch("void.tif");
  make_raster(path, recipe);
  const LocalFrame frame = frame_at(38.9, -121.0);
  const auto refused = read_grid(path, 1, "", frame, kSmall, Missing::kError);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().text().find("does not cover the area"), std::string::npos)
      << refused.error().text();
  const auto filled = read_grid(path, 1, "", frame, kSmall, Missing::kNearest);
  ASSERT_TRUE(filled.ok());
  for (const double v : filled.value().values()) {
    EXPECT_GT(v, 38.87);
    EXPECT_LT(v, 38.93);
  }
  const auto kept = read_grid(path, 1, "", frame, kSmall, Missing::kKeep);
  ASSERT_TRUE(kept.ok());
  EXPECT_TRUE(std::isnan(kept.value().at(Vec2(0, -500))));
  EXPECT_FALSE(std::isnan(kept.value().at(Vec2(0, 500))));
}

TEST(RasterFile, AnAreaPartlyOrWhollyOutsideIsRefused) {
  const std::string path = scratch("position.tif");
  make_raster(path, position_raster());
  const GridShape large{Vec2(-4000, -4000), 100, 81, 81};
  const LocalFrame frame = frame_at(38.9, -121.0);
  const auto partly = read_grid(path, 1, "", frame, large, Missing::kError);
  ASSERT_FALSE(partly.ok());
  EXPECT_NE(partly.error().message.find("does not cover"), std::string::npos);
  EXPECT_TRUE(read_grid(path, 1, "", frame, large, Missing::kNearest).ok());
  const auto wholly = read_grid(path, 1, "", frame_at(10, 20), kSmall, Missing::kNearest);
  ASSERT_FALSE(wholly.ok());
  EXPECT_NE(wholly.error().message.find("no data at all"), std::string::npos);
}

TEST(RasterFile, NotANumberInTheAreaIsRefusedWithItsPlace) {
  RasterRecipe recipe = position_raster();
  recipe.bands[0][60 * 25 + 30] = std::nan("");
  const std::string path = scratch("nan.tif");
  make_raster(path, recipe);
  const auto refused =
      read_grid(path, 1, "", frame_at(38.9, -121.0), kSmall, Missing::kKeep);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().text().find("column 30, row 25"), std::string::npos)
      << refused.error().text();
}

TEST(RasterFile, InvalidFilesGiveErrorsAndNothingOnStderr) {
  ::testing::internal::CaptureStderr();
  const auto message = [](const std::string& path, const std::string& name = "") {
    const auto field =
        read_grid(path, 1, name, frame_at(38.9, -121.0), kSmall, Missing::kError);
    return field.ok() ? std::string() : field.error().text();
  };
  EXPECT_NE(message(scratch("none.tif")).find("no such file"), std::string::npos);
  EXPECT_NE(message(::testing::TempDir()).find("folder"), std::string::npos);

  const std::string text = scratch("text.tif");
  std::ofstream(text) << "not a raster at all\n";
  EXPECT_NE(message(text).find("cannot be read as a raster"), std::string::npos);
  const std::string empty = scratch("empty.tif");
  std::ofstream(empty).flush();
  EXPECT_NE(message(empty).find("cannot be read as a raster"), std::string::npos);

  RasterRecipe recipe = position_raster();
  for (const char* driver : {"GTiff", "netCDF"})
    for (const double share : {0.05, 0.3, 0.6}) {
      recipe.driver = driver;
      const std::string path = scratch("cut." + std::string(driver));
      make_raster(path, recipe);
      cut_file(path, share);
      EXPECT_NE(message(path), "") << driver << share;
    }
  recipe.driver = "GTiff";

  recipe.geo.reset();
  const std::string no_place = scratch("no_place.tif");
  make_raster(no_place, recipe);
  EXPECT_NE(message(no_place).find("no georeference"), std::string::npos);
  recipe = position_raster();
  recipe.epsg = 0;
  const std::string no_system = scratch("no_system.tif");
  make_raster(no_system, recipe);
  EXPECT_NE(message(no_system).find("no coordinate reference system"), std::string::npos);

  const std::string good = scratch("good.tif");
  make_raster(good, position_raster());
  EXPECT_NE(message(good, "height").find("latitude, longitude"), std::string::npos);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(RasterFile, ServesManyThreadsEachWithItsOwnObject) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "locks of this allocator that another thread holds stay locked in the "
                  "process that reads";
#endif
  const std::string path = scratch("position.tif");
  make_raster(path, position_raster());
  const LocalFrame frame = frame_at(38.9, -121.0);
  std::atomic<int> good = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 5; ++k)
        good += read_grid(path, 1, "", frame, kSmall, Missing::kError).ok() ? 1 : 0;
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(good, 20);
}

}  // namespace
}  // namespace skein::environment::raster_test
