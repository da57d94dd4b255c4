// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "skein/layer/sensory/anemometer.h"
#include "skein/layer/sensory/camera.h"
#include "skein/layer/sensory/height_sensor.h"
#include "skein/layer/sensory/rangefinder.h"
#include "skein/layer/sensory/ray_cast.h"
#include "skein/layer/sensory/test/test_world.h"

namespace skein::sensory::looking_sensors_test {
namespace {

class Slope final : public Terrain {
 public:
  explicit Slope(const Vec2& gradient) : gradient_(gradient) {}
  double elevation_msl(const Vec2& p) const override { return gradient_.dot(p); }
  Vec2 gradient(const Vec2&) const override { return gradient_; }

 private:
  Vec2 gradient_;
};

// A spherical cap of the given radius on level ground at 0, its top 60 m high.
class Cap final : public Terrain {
 public:
  explicit Cap(double radius) : radius_(radius) {}
  double depth() const { return radius_ - 60; }  // of the centre
  double elevation_msl(const Vec2& p) const override {
    const double left = radius_ * radius_ - p.squaredNorm();
    return left > 0 ? std::max(std::sqrt(left) - depth(), 0.0) : 0;
  }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }

 private:
  double radius_;
};

// A ridge 50 m high across north = 100 m, nearly as steep as a ray expects.
class Ridge final : public Terrain {
 public:
  static constexpr double kSlope = 1.9;
  double elevation_msl(const Vec2& p) const override {
    return std::max(50 - kSlope * std::abs(p.x() - 100), 0.0);
  }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

TEST(RayCast, MeetsSlopesWhereTheirPlaneIs) {
  for (const Vec2& gradient : {Vec2(0, 0), Vec2(0.5, -0.2), Vec2(-1.2, 0.9)}) {
    const Slope terrain(gradient);
    const Vec3 normal = Vec3(gradient.x(), gradient.y(), 1);  // points into the ground
    const Vec3 from(30, -20, -gradient.dot(Vec2(30, -20)) - 80);
    for (const Vec3& to : {Vec3(0, 0, 1), Vec3(1, 0.5, 0.2), Vec3(-0.3, -2, 0.5)}) {
      const Vec3 ray = to.normalized();
      const double expected = 80 / normal.dot(ray);  // clearance over closing speed
      const auto got = ray_cast(terrain, from, ray, 1000);
      if (expected <= 0 || expected > 1000) {
        EXPECT_FALSE(got.has_value());
        continue;
      }
      ASSERT_TRUE(got.has_value());
      EXPECT_NEAR(*got, expected, 0.001);
    }
  }
}

TEST(RayCast, MeetsASphereWhereItIs) {
  const Cap cap(120);
  const Vec3 centre(0, 0, cap.depth());
  int hits = 0;
  for (int azimuth = -20; azimuth <= 20; ++azimuth) {
    for (int down = 0; down <= 16; ++down) {
      const double a = 0.02 * azimuth, d = 0.02 * down;
      const Vec3 from(-300, 0, -50);
      const Vec3 ray(std::cos(d) * std::cos(a), std::cos(d) * std::sin(a), std::sin(d));
      // |from + s ray - centre| = R; and the level ground around.
      const Vec3 away = from - centre;
      const double b = away.dot(ray), c = away.squaredNorm() - 120 * 120;
      double expected = ray.z() > 0 ? 50 / ray.z() : 1e9;
      if (b * b >= c) {
        const double s = -b - std::sqrt(b * b - c);
        if (-(from + s * ray).z() > 0 && s < expected) expected = s;
      }
      const auto got = ray_cast(cap, from, ray, 600);
      ASSERT_EQ(got.has_value(), expected < 600) << a << " " << d;
      // Rays that graze the sphere find their point less sharply.
      if (got) {
        EXPECT_NEAR(*got, expected, 0.01) << a << " " << d;
      }
      hits += expected < 400 ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 100);
}

TEST(RayCast, StopsAtItsReachAndUnderTheGround) {
  const LevelGround ground(0);
  EXPECT_FALSE(ray_cast(ground, {0, 0, -100}, {0, 0, 1}, 99.9).has_value());
  EXPECT_NEAR(ray_cast(ground, {0, 0, -100}, {0, 0, 1}, 100.1).value(), 100, 0.001);
  EXPECT_EQ(ray_cast(ground, {0, 0, 5}, {0, 0, 1}, 100), 0.0);
  EXPECT_FALSE(ray_cast(ground, {0, 0, -1}, {0, 0, -1}, 1e6).has_value());
}

TEST(RayCast, SeesARidge) {
  const Ridge ridge;
  const auto level = [&](double height) {
    return ray_cast(ridge, {0, 0, -height}, {1, 0, 0}, 500);
  };
  EXPECT_NEAR(level(30).value(), 100 - 20 / Ridge::kSlope, 0.001);
  EXPECT_NEAR(level(49).value(), 100 - 1 / Ridge::kSlope, 0.001);  // 1 m thick there
  EXPECT_FALSE(level(50.1).has_value());
}

TEST(Rangefinder, LooksAlongItsBeam) {
  TestWorld world;  // level ground at 100 m
  world.vehicle.p_N = {0, 0, -140};
  world.vehicle.q_NB = geo::from_euler({0, -0.3, 2});  // nose down
  const RangefinderOptions exact{
      .depression = 0.2, .range = 90, .bias_sd = 0, .noise_sd = 0};
  Rangefinder sensor(exact, 1, {1});
  const auto out = only<RangeSample>(world.run(sensor, ms(100), 1));
  EXPECT_NEAR(out.at(0).range, 40 / std::sin(0.5), 0.001);
  EXPECT_NEAR(out.at(0).beam_B.z(), std::sin(0.2), 1e-15);
  world.vehicle.p_N.z() = -145;  // 94 m along the beam: out of range
  Rangefinder other(exact, 1, {1});
  EXPECT_EQ(only<RangeSample>(world.run(other, ms(100), 1)).at(0).range, 0);
}

TEST(Rangefinder, HasAWanderingBiasAndNoise) {
  TestWorld world;
  world.vehicle.p_N = {0, 0, -150};
  Rangefinder sensor({.bias_sd = 0.4, .bias_time = 1, .noise_sd = 0.2}, 1, {1});
  std::vector<double> y;
  const int n = 100000;
  for (const auto& s : only<RangeSample>(world.run(sensor, ms(100), n)))
    y.push_back(s.range - 50);
  double lag1s = 0;
  for (std::size_t i = 10; i < y.size(); ++i) lag1s += y[i] * y[i - 10] / n;
  // n / 10 correlation times: relative standard error 1.4 %; bound at 4.5 of them.
  EXPECT_NEAR(moments(y).variance, 0.16 + 0.04, 0.2 * 0.064);
  EXPECT_NEAR(lag1s, 0.16 * std::exp(-1), 0.16 * 0.064);
}

TEST(Lidar, FansItsBeamsOut) {
  TestWorld world;
  world.vehicle.p_N = {0, 0, -150};
  const LidarOptions options{.latency = 0,
                             .beams = 5,
                             .field_of_view = 2,
                             .depression = 0.6,
                             .bias_sd = 0,
                             .noise_sd = 0};
  Lidar sensor(options, 1, {1});
  const auto scan = only<RangeSample>(world.run(sensor, ms(200), 1));
  ASSERT_EQ(scan.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const double angle = -1 + 0.5 * static_cast<double>(i);
    const double down = std::cos(angle) * std::sin(0.6);
    EXPECT_NEAR(scan[i].beam_B.y(), std::sin(angle), 1e-15);
    EXPECT_NEAR(scan[i].beam_B.norm(), 1, 1e-15);
    const double expected = 50 / down;
    EXPECT_NEAR(scan[i].range, expected < 150 ? expected : 0, 0.001);
  }
}

TEST(HeightSensor, GivesTheHeightWithinItsRange) {
  TestWorld world;
  world.vehicle.p_N = {0, 0, -140};
  HeightSensor sensor({.noise_sd = 0.3, .relative_sd = 0.01}, 1, {1});
  std::vector<double> h;
  for (const auto& s : only<HeightSample>(world.run(sensor, ms(50), 20000)))
    h.push_back(s.height_agl);
  ASSERT_EQ(h.size(), 20000U);
  // 4.5 standard errors: of the mean 0.5/141, of the variance 1 %.
  EXPECT_NEAR(moments(h).mean, 40, 0.016);
  EXPECT_NEAR(moments(h).variance, 0.09 + 0.16, 0.25 * 0.045);
  world.vehicle.p_N.z() = -150.5;
  HeightSensor high({}, 1, {1});
  EXPECT_TRUE(world.run(high, ms(50), 10).empty());
}

TEST(Anemometer, FeelsTheAirInTheBodyFrame) {
  TestWorld world;
  world.vehicle.q_NB = geo::from_euler({0, 0, geo::kPi / 2});
  world.vehicle.v_N = {0, 20, 0};
  world.air.wind_N = {3, -5, 1};
  Anemometer exact({.bias_sd = 0, .noise_sd = 0}, 1, {1});
  const Vec3 v = only<AnemometerSample>(world.run(exact, ms(100), 1)).at(0).v_AB_B;
  EXPECT_LT((v - Vec3(25, 3, -1)).norm(), 1e-14);
}

TEST(Anemometer, HasAWanderingBiasAndNoise) {
  const TestWorld world;
  Anemometer sensor({.bias_sd = 0.5, .bias_time = 1, .noise_sd = 0.3}, 1, {1});
  std::vector<double> y;
  const int n = 100000;
  for (const auto& s : only<AnemometerSample>(world.run(sensor, ms(100), n)))
    y.push_back(s.v_AB_B.y());
  double lag1s = 0;
  for (std::size_t i = 10; i < y.size(); ++i) lag1s += y[i] * y[i - 10] / n;
  // As for the rangefinder.
  EXPECT_NEAR(moments(y).variance, 0.25 + 0.09, 0.34 * 0.064);
  EXPECT_NEAR(lag1s, 0.25 * std::exp(-1), 0.25 * 0.064);
}

CameraOptions square_camera() {
  return {.latency = 0,
          .width = geo::radians(60),
          .length = geo::radians(40),
          .detection = 1,
          .position_sd = 0,
          .direction_sd = 0};
}

std::array<Vec2, 4> footprint(const TestWorld& world, const Terrain& terrain,
                              const CameraOptions& options) {
  Camera camera(options, 1, {1});
  std::vector<SensorSample> out;
  camera.sample(world.at(Time(), terrain), out);
  return only<FootprintSample>(out).at(0).corners;
}

TEST(Camera, FootprintOnLevelGroundIsTheRectangleBelow) {
  TestWorld world;
  world.vehicle.p_N = {500, -300, -200};  // 100 m above ground
  const double right = 100 * std::tan(geo::radians(30));
  const double front = 100 * std::tan(geo::radians(20));
  const auto level = footprint(world, world.ground, square_camera());
  // The march ends within 1 mm.
  EXPECT_LT((level[0] - Vec2(front, -right)).norm(), 0.002);
  EXPECT_LT((level[1] - Vec2(front, right)).norm(), 0.002);
  EXPECT_LT((level[2] - Vec2(-front, right)).norm(), 0.002);
  EXPECT_LT((level[3] - Vec2(-front, -right)).norm(), 0.002);
  world.vehicle.q_NB = geo::from_euler({0, 0, geo::kPi / 2});  // front is east
  const auto east = footprint(world, world.ground, square_camera());
  EXPECT_LT((east[0] - Vec2(right, front)).norm(), 0.002);
}

TEST(Camera, FootprintMovesWithAttitude) {
  TestWorld world;
  world.vehicle.p_N = {0, 0, -200};
  // Rolled 20 degrees right, the camera looks left: edges at 30 + 20 and 30 - 20 degrees.
  // Along, the corners lie at (distance of the edge's plane) tan(20 degrees).
  world.vehicle.q_NB = geo::from_euler({geo::radians(20), 0, 0});
  const auto rolled = footprint(world, world.ground, square_camera());
  const double far = 100 * std::tan(geo::radians(50));
  const double near = 100 * std::tan(geo::radians(10));
  EXPECT_NEAR(rolled[0].y(), -far, 0.002);
  EXPECT_NEAR(rolled[1].y(), near, 0.002);
  // Depth of the left edge along the camera's axis: slant 100/cos 50 times cos 30.
  const double depth = 100 / std::cos(geo::radians(50)) * std::cos(geo::radians(30));
  EXPECT_NEAR(rolled[0].x(), depth * std::tan(geo::radians(20)), 0.002);
  // Pitched up 20 degrees it looks ahead; the back edge is straight below.
  world.vehicle.q_NB = geo::from_euler({0, geo::radians(20), 0});
  const auto pitched = footprint(world, world.ground, square_camera());
  EXPECT_NEAR(pitched[0].x(), 100 * std::tan(geo::radians(40)), 0.002);
  EXPECT_NEAR(pitched[3].x(), 0, 0.002);
}

std::array<Vec2, 4> gimbal_footprint(const TestWorld& world, const Vec3& gaze_N) {
  CameraOptions options = square_camera();
  options.gimbal = true;
  options.width = options.length = geo::radians(10);
  Camera camera(options, 1, {1});
  SensorView view = world.at(Time(), world.ground);
  view.gaze_N = gaze_N;
  std::vector<SensorSample> out;
  camera.sample(view, out);
  return only<FootprintSample>(out).at(0).corners;
}

// Where the picture's middle is: its diagonals cross there.
Vec2 middle(const std::array<Vec2, 4>& corners) {
  const Vec2 one = corners[2] - corners[0], other = corners[3] - corners[1];
  const double t = geo::cross(corners[1] - corners[0], other) / geo::cross(one, other);
  return corners[0] + t * one;
}

TEST(Camera, AGimbalLooksAtWhatTheAgentWantsToSee) {
  TestWorld world;
  world.vehicle.p_N = {0, 0, -200};  // 100 m above ground
  for (const double yaw : {0.0, 1.0, 4.0})
    for (const Vec2& place : {Vec2(0, 0), Vec2(50, 20), Vec2(-80, 100), Vec2(0, -150)}) {
      world.vehicle.q_NB = geo::from_euler({0.4, -0.2, yaw});
      const auto corners = gimbal_footprint(world, Vec3(place.x(), place.y(), 100));
      EXPECT_LT((middle(corners) - place).norm(), 0.02) << yaw << " " << place;
    }
}

TEST(Camera, AGimbalTiltsNoFurtherThanItCan) {
  TestWorld world;
  world.vehicle.p_N = {0, 0, -200};
  world.vehicle.q_NB = geo::from_euler({0, 0, 0});
  CameraOptions options = square_camera();
  // Towards a place 1 km to the east, 84 degrees from straight down: 60 is what there is.
  const Vec2 east = middle(gimbal_footprint(world, {0, 1000, 100}));
  EXPECT_NEAR(east.y(), 100 * std::tan(options.max_tilt), 0.05);
  EXPECT_NEAR(east.x(), 0, 0.01);
  // Straight up there is nothing to see: it looks down.
  EXPECT_LT(middle(gimbal_footprint(world, {0, 0, -100})).norm(), 0.01);
}

TEST(Camera, FootprintFollowsTheTerrain) {
  TestWorld world;
  world.vehicle.p_N = {0, 0, -100};
  const auto corners = footprint(world, Slope({0.5, 0}), square_camera());
  // Ground rises to the north: 100 - t = 0.5 front t meets the front ray at depth t.
  const double front = std::tan(geo::radians(20));
  EXPECT_NEAR(corners[0].x(), 100 / (1 + 0.5 * front) * front, 0.002);
  EXPECT_NEAR(corners[2].x(), -100 / (1 - 0.5 * front) * front, 0.002);
}

TEST(Camera, RaysThatMeetNothingEndAtTheRange) {
  TestWorld world;
  world.vehicle.p_N = {0, 0, -200};
  world.vehicle.q_NB = geo::from_euler({geo::radians(70), 0, 0});  // left edge: the sky
  const auto corners = footprint(world, world.ground, square_camera());
  const Vec3 ray_B(std::tan(geo::radians(20)), -std::tan(geo::radians(30)), 1);
  const Vec3 end_N = 500 * (world.vehicle.q_NB * ray_B.normalized());
  EXPECT_LT((corners[0] - geo::horizontal(end_N)).norm(), 1e-9);
}

TEST(Camera, FindsWhatIsInItsPicture) {
  TestWorld world;
  world.vehicle.p_N = {0, 0, -200};
  const double right = 100 * std::tan(geo::radians(30));
  const double front = 100 * std::tan(geo::radians(20));
  world.objects = {{.id = 1, .position = {front - 0.1, right - 0.1}},
                   {.id = 2, .position = {front + 0.1, 0}},
                   {.id = 3, .position = {0, -right - 0.1}},
                   {.id = 4, .position = {-5, 7}}};
  Camera camera(square_camera(), 1, {1});
  std::vector<SensorSample> out;
  camera.sample(world.at(Time::from_seconds(10)), out);
  const auto found = only<DetectionSample>(out);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].object, 1U);
  EXPECT_EQ(found[1].object, 4U);
  EXPECT_EQ(found[1].position, Vec2(-5, 7));
  EXPECT_EQ(found[1].time, Time::from_seconds(10));
  // Behind the camera, when it looks up.
  world.vehicle.q_NB = geo::from_euler({geo::kPi, 0, 0});
  Camera up(square_camera(), 1, {1});
  EXPECT_TRUE(only<DetectionSample>(world.run(up, ms(10), 1)).empty());
}

TEST(Camera, TerrainHides) {
  TestWorld world;
  world.vehicle.p_N = {60, 0, -60};
  world.objects = {{.id = 1, .position = {95, 0}},    // on the near slope
                   {.id = 2, .position = {110, 0}}};  // on the far one
  CameraOptions options = square_camera();
  options.length = 2.4;
  Camera camera(options, 1, {1});
  std::vector<SensorSample> out;
  camera.sample(world.at(Time(), Ridge()), out);
  const auto found = only<DetectionSample>(out);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].object, 1U);
  // Without the ridge, both.
  Camera over_plain(options, 1, {1});
  out.clear();
  over_plain.sample(world.at(Time(), LevelGround(0)), out);
  EXPECT_EQ(only<DetectionSample>(out).size(), 2U);
}

TEST(Camera, FindsAtItsRateWithItsErrors) {
  TestWorld world;
  world.vehicle.p_N = {0, 0, -200};
  world.objects = {{.id = 9, .position = {20, 0}}};
  CameraOptions options = square_camera();
  options.detection = 0.7;
  options.position_sd = 1.5;
  options.direction_sd = 0.02;
  Camera camera(options, 1, {1});
  const int n = 20000;
  std::vector<double> north;
  double sd = 0;
  for (const auto& d : only<DetectionSample>(world.run(camera, ms(1000), n))) {
    north.push_back(d.position.x());
    sd = d.position_sd;
  }
  const double distance2 = 100 * 100 + 20 * 20;
  EXPECT_NEAR(sd * sd, 2.25 + 4e-4 * distance2, 1e-9);
  // 4.5 standard errors of a share of n, and of mean and variance of 14,000.
  EXPECT_NEAR(double(north.size()) / n, 0.7, 4.5 * std::sqrt(0.7 * 0.3 / n));
  EXPECT_NEAR(moments(north).mean, 20, 4.5 * sd / std::sqrt(14000));
  EXPECT_NEAR(moments(north).variance, sd * sd, sd * sd * 4.5 * std::sqrt(2.0 / 14000));
}

}  // namespace
}  // namespace skein::sensory::looking_sensors_test
