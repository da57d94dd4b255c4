// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/recorded/recorded_fire.h"

#include <algorithm>
#include <limits>
#include <thread>

#include "skein/base/random.h"
#include "skein/geo/clip.h"
#include "skein/layer/environment/raster/date_time.h"
#include "skein/layer/environment/raster/test/make_raster.h"
#include "skein/layer/environment/recorded/arrival_fire.h"
#include "skein/layer/environment/recorded/perimeter_file.h"
#include "skein/layer/environment/recorded/perimeter_fire.h"

namespace skein::environment::recorded_fire_test {
namespace {

using geo::Region;
using Warnings = std::vector<std::string>;

geo::Ring circle(const Vec2& centre, double radius) {
  geo::Ring ring;
  for (int i = 0; i < 360; ++i)
    ring.push_back(centre + radius * geo::unit(geo::radians(i)));
  return ring;
}

Time seconds(double s) {
  return Time::from_seconds(s);
}

// Two concentric circles: between them the front is a circle whose radius is linear.
TEST(PerimeterFire, MovesLinearlyBetweenCircles) {
  PerimeterFire fire({{0, {circle(Vec2(0, 0), 200)}}, {600, {circle(Vec2(0, 0), 500)}}},
                     {Vec2(-600, -600), 8, 151, 151}, 0);
  for (const double t : {0.0, 150.0, 300.0, 599.0, 600.0, 5000.0}) {
    fire.advance(seconds(t));
    const double radius = 200 + 0.5 * std::min(t, 600.0);
    ASSERT_EQ(fire.region().size(), 1u) << t;
    for (const Vec2& p : fire.region()[0])
      // Linear interpolation of distances (8^2 / 8 / 200 = 0.04 m), chords of 1 degree
      // (0.02 m), and the nearest edge handed on (tenths of 8 m only far away).
      EXPECT_NEAR(p.norm(), radius, 0.1) << t;
    EXPECT_TRUE(fire.inside(Vec2(radius - 0.1, 0)));
    EXPECT_FALSE(fire.inside(Vec2(0, radius + 0.1)));
    EXPECT_FALSE(fire.inside(Vec2(1e7, 0)));
  }
  EXPECT_NEAR(fire.arrival_time(Vec2(0, -350)), 300, 0.3);
  EXPECT_EQ(fire.arrival_time(Vec2(10, 10)), 0);
  EXPECT_EQ(fire.arrival_time(Vec2(501, 0)), std::numeric_limits<double>::infinity());
}

TEST(PerimeterFire, KeepsAStillFlankStill) {
  // The east side does not move between the two: the front must stay within a small part
  // of the spacing there although the arrival time jumps.
  const geo::Ring first{{0, 0}, {0, 303}, {300, 303}, {300, 0}};
  const geo::Ring second{{0, -403}, {0, 303}, {300, 303}, {300, -403}};
  PerimeterFire fire({{0, {first}}, {100, {second}}}, {Vec2(-50, -500), 10, 50, 100}, 0);
  for (const double t : {0.0, 33.0, 66.0, 99.0}) {
    fire.advance(seconds(t));
    EXPECT_TRUE(fire.inside(Vec2(150, 302.9))) << t;
    EXPECT_FALSE(fire.inside(Vec2(150, 303.1))) << t;
  }
  // 100 m from the first boundary, 150 m from the second (its north and south sides).
  EXPECT_NEAR(fire.arrival_time(Vec2(150, -100)), 100 * 100 / 250.0, 1e-6);
}

TEST(PerimeterFire, GrowsMonotonicallyAndAgreesWithItsRegionAndArrivalTimes) {
  // An island appears, a hole closes.
  Region second{circle(Vec2(0, 0), 300), circle(Vec2(500, 500), 60)};
  Region first{circle(Vec2(0, 0), 200), circle(Vec2(20, 20), 60)};
  std::reverse(first[1].begin(), first[1].end());
  PerimeterFire fire({{0, first}, {200, second}}, {Vec2(-400, -400), 7, 150, 150}, 40);
  RandomStream random(11, 0, Purpose::kTest);
  std::vector<Vec2> points;
  for (int i = 0; i < 3000; ++i)
    points.emplace_back(random.uniform(-350, 600), random.uniform(-350, 600));
  std::vector<bool> burnt(points.size(), false);
  int different = 0;
  for (double t = 0; t <= 170; t += 17) {
    fire.advance(seconds(t));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool now = fire.inside(points[i]);
      EXPECT_FALSE(burnt[i] && !now) << points[i].transpose();
      burnt[i] = now;
      different += now != geo::contains(fire.region(), points[i]) ? 1 : 0;
      // Bilinear distances at the node times, not the same order of mixing: only at the
      // edge of a cell with a kink may the two differ, by a small part of the spacing.
      EXPECT_EQ(now, fire.arrival_time(points[i]) < 40 + t) << points[i].transpose();
    }
  }
  // Contour and bilinear value differ by slivers: their share of the area is some 1e-3.
  EXPECT_LT(different, 3000 * 11 * 0.002);
}

TEST(PerimeterFire, RegionMayBeAskedFromManyThreads) {
  PerimeterFire fire({{0, {circle(Vec2(0, 0), 200)}}, {600, {circle(Vec2(0, 0), 500)}}},
                     {Vec2(-600, -600), 10, 121, 121}, 0);
  fire.advance(seconds(77));
  std::vector<double> areas(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < areas.size(); ++i)
    threads.emplace_back([&, i] { areas[i] = geo::area(fire.region()); });
  for (auto& thread : threads) thread.join();
  for (const double a : areas) EXPECT_EQ(a, areas[0]);
  EXPECT_GT(areas[0], 0);
}

TEST(ArrivalFire, ContoursItsField) {
  const GridShape shape{Vec2(-500, -500), 10, 101, 101};
  std::vector<double> times;
  for (int r = 0; r < shape.rows; ++r)
    for (int c = 0; c < shape.columns; ++c) {
      const double distance = shape.node(r, c).norm();
      times.push_back(distance <= 400 ? 2 * distance
                                      : std::numeric_limits<double>::quiet_NaN());
    }
  ArrivalFire fire(GridField(shape, times), 100);
  // Linear interpolation of a cone cuts at most spacing^2 / (8 r) short: along the circle
  // that is 2 pi * 10^2 / 8 = 79 m2, whatever its radius.
  EXPECT_NEAR(geo::area(fire.region()), geo::kPi * 2500, 79);
  fire.advance(seconds(300));
  EXPECT_NEAR(geo::area(fire.region()), geo::kPi * 40000, 79);
  EXPECT_TRUE(fire.inside(Vec2(0, 199.5)));
  EXPECT_FALSE(fire.inside(Vec2(0, 200.5)));
  fire.advance(seconds(1e6));
  // The last edge runs half way between the last burning nodes and the next.
  EXPECT_NEAR(std::sqrt(geo::area(fire.region()) / geo::kPi), 400, 5);
  EXPECT_FALSE(fire.inside(Vec2(450, 0)));
  EXPECT_FALSE(fire.inside(Vec2(5000, 0)));
}

RasterRecipe arrival_raster() {
  RasterRecipe recipe;
  recipe.columns = recipe.rows = 80;
  recipe.epsg = 32610;
  recipe.geo = {670000, 30, 0, 4312000, 0, -30};
  recipe.nodata = -9999;
  recipe.bands.resize(1);
  for (int r = 0; r < 80; ++r)
    for (int c = 0; c < 80; ++c) {
      const double distance = 30 * Vec2(r - 40, c - 30).norm();
      recipe.bands[0].push_back(distance < 600 ? distance / 3600 : -9999);
    }
  return recipe;
}

TEST(RecordedFire, ReadsAnArrivalRasterInHours) {
  RecordedFireOptions options;
  options.path = scratch("arrival.tif");
  options.arrival_unit = 3600;
  make_raster(options.path, arrival_raster());
  std::vector<std::string> notes;
  const auto summary = summarise_recorded_fire(options, notes);
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  EXPECT_NEAR(summary.value().duration, 600, 10);
  EXPECT_NEAR(std::sqrt(summary.value().last_area / geo::kPi), 600, 15);  // half a pixel
  const auto frame = geo::LocalFrame::at(summary.value().origin).value();
  Warnings warnings;
  const auto fire = make_recorded_fire(options, frame, warnings);
  ASSERT_TRUE(fire.ok()) << fire.error().text();
  EXPECT_EQ(warnings, Warnings());
  fire.value()->advance(seconds(300));
  // 1 m/s; the cone's tip is blunted by a pixel, elsewhere bilinear error is below 1 m.
  EXPECT_NEAR(std::sqrt(geo::area(fire.value()->region()) / geo::kPi), 300, 1.5);
  EXPECT_TRUE(fire.value()->inside(Vec2(297, 0)));
  EXPECT_FALSE(fire.value()->inside(Vec2(0, 303)));

  // "Never" as an undeclared -1: understood, with a word.
  RasterRecipe recipe = arrival_raster();
  recipe.nodata.reset();
  for (double& t : recipe.bands[0]) t = std::max(t, -1.0);
  make_raster(options.path, recipe);
  const auto minus = make_recorded_fire(options, frame, warnings);
  ASSERT_TRUE(minus.ok()) << minus.error().text();
  EXPECT_EQ(warnings.size(), 1u);
  minus.value()->advance(seconds(300));
  EXPECT_EQ(minus.value()->region(), fire.value()->region());

  cut_file(options.path, 0.5);
  options.kind = RecordedKind::kArrival;
  EXPECT_FALSE(make_recorded_fire(options, frame, warnings).ok());
  options.start = 601;
  make_raster(options.path, arrival_raster());
  EXPECT_FALSE(make_recorded_fire(options, frame, warnings).ok());
}

std::string fires() {
  return SKEIN_SHARED_DATA "/fires/";
}

TEST(RecordedFire, BridgeMatchesEveryPerimeterOfTheRecord) {
  RecordedFireOptions options;
  options.path = fires() + "bridge_2021";
  if (!std::filesystem::exists(options.path)) GTEST_SKIP() << "no " << options.path;
  std::vector<std::string> notes;
  const auto summary = summarise_recorded_fire(options, notes);
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  EXPECT_EQ(summary.value().perimeters, 6);
  EXPECT_EQ(summary.value().duration, 8340);
  // The table of the data: 7.4 and 97.1 ha in an equal-area projection, rounded.
  EXPECT_NEAR(summary.value().first_area, 7.4e4, 0.06e4);
  EXPECT_NEAR(summary.value().last_area, 97.1e4, 0.06e4);
  EXPECT_FALSE(summary.value().start_utc.has_value());  // the table counts seconds
  EXPECT_NEAR(summary.value().origin.latitude_deg, 38.921, 0.002);
  EXPECT_NEAR(summary.value().origin.longitude_deg, -121.035, 0.005);

  const auto frame = geo::LocalFrame::at(summary.value().origin).value();
  Warnings warnings;
  const auto fire = make_recorded_fire(options, frame, warnings);
  ASSERT_TRUE(fire.ok()) << fire.error().text();
  auto raw = read_perimeters(options.path, {}, warnings).value();
  Region before;
  for (const RawPerimeter& perimeter : raw.perimeters) {
    const Region mapped = repaired(projected(perimeter, frame).value(), {}, warnings);
    fire.value()->advance(seconds(perimeter.time));
    // The contour on a 5 m grid rounds corners by some 0.1 m on average: 0.25 % of the
    // smallest perimeter's union, 0.03 % of the largest's.
    EXPECT_GT(geo::iou(fire.value()->region(), mapped), 0.997) << perimeter.time;
    EXPECT_LT(geo::area(geo::subtract(before, fire.value()->region())), 200);
    before = fire.value()->region();
  }
  // One file with a time attribute gives the same fire as six shapefiles (7 decimals of a
  // degree are 1 cm).
  options.path += "/perimeters_wgs84.geojson";
  const auto same = make_recorded_fire(options, frame, warnings);
  ASSERT_TRUE(same.ok()) << same.error().text();
  same.value()->advance(seconds(6000));
  options.path = fires() + "bridge_2021";
  const auto again = make_recorded_fire(options, frame, warnings);
  again.value()->advance(seconds(6000));
  EXPECT_GT(geo::iou(same.value()->region(), again.value()->region()), 0.999);
}

TEST(RecordedFire, RiverDropsItsRoughFirstBox) {
  RecordedFireOptions options;
  options.path = fires() + "river_2021";
  if (!std::filesystem::exists(options.path)) GTEST_SKIP() << "no " << options.path;
  std::vector<std::string> notes;
  const auto summary = summarise_recorded_fire(options, notes);
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  EXPECT_EQ(summary.value().perimeters, 4);
  EXPECT_EQ(summary.value().duration, 38640 - 420);
  EXPECT_NEAR(summary.value().first_area, 420e4, 2e4);
  const auto frame = geo::LocalFrame::at(summary.value().origin).value();
  Warnings warnings;
  const auto fire = make_recorded_fire(options, frame, warnings);
  ASSERT_TRUE(fire.ok()) << fire.error().text();
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) {
    return w.find("00_138834.shp: left out as an outlier") != std::string::npos;
  })) << ::testing::PrintToString(warnings);
  double area = 0;
  for (double t = 0; t <= 38220; t += 4777.5) {
    fire.value()->advance(seconds(t));
    const double now = geo::area(fire.value()->region());
    EXPECT_GE(now, area);
    area = now;
  }
  EXPECT_NEAR(area, summary.value().last_area, 0.01 * summary.value().last_area);

  options.repair.outliers = Outliers::kRefuse;
  EXPECT_FALSE(make_recorded_fire(options, frame, warnings).ok());
  options.repair.skip = {0};
  EXPECT_TRUE(make_recorded_fire(options, frame, warnings).ok());
}

TEST(RecordedFire, OptionsOutOfRangeAreRefused) {
  RecordedFireOptions good;
  good.path = scratch("one.geojson");
  std::ofstream(good.path)
      << R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"seconds":0},
        "geometry":{"type":"Polygon","coordinates":[[[-121,38.9],[-120.99,38.9],[-121,38.91],[-121,38.9]]]}}]})";
  const auto frame = geo::LocalFrame::at({38.9, -121, 0}).value();
  Warnings warnings;
  EXPECT_TRUE(make_recorded_fire(good, frame, warnings).ok());
  const auto refused = [&](auto change) {
    RecordedFireOptions options = good;
    change(options);
    const auto fire = make_recorded_fire(options, frame, warnings);
    return !fire.ok() && !fire.error().message.empty();
  };
  EXPECT_TRUE(refused([](auto& o) { o.spacing = -1; }));
  EXPECT_TRUE(refused([](auto& o) { o.spacing = std::nan(""); }));
  EXPECT_TRUE(refused([](auto& o) { o.spacing = 1e-3; }));
  EXPECT_TRUE(refused([](auto& o) { o.start = 1; }));
  EXPECT_TRUE(refused([](auto& o) { o.start = -1; }));
  EXPECT_TRUE(refused([](auto& o) { o.path = "/no/such/file"; }));
  EXPECT_TRUE(refused([](auto& o) { o.repair.outlier_share = 0; }));
  const auto far = geo::LocalFrame::at({-38.9, 59, 0}).value();
  const auto fire = make_recorded_fire(good, far, warnings);
  ASSERT_FALSE(fire.ok());
  EXPECT_NE(fire.error().text().find("is the origin right"), std::string::npos);
}

}  // namespace
}  // namespace skein::environment::recorded_fire_test
