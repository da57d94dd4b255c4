#include "layer/reasoning/agent/edge_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "base/random.h"
#include "geo/polygon.h"
#include "layer/reasoning/agent/test/test_flight.h"

namespace skein::reasoning {
namespace {

geo::Ring circle_ring(double radius) {
  geo::Ring ring;
  for (int i = 0; i < 360; ++i) ring.push_back(radius * geo::unit(geo::radians(i)));
  return ring;
}

geo::Ring square_ring(double side) {
  const double h = side / 2;
  return {{-h, -h}, {h, -h}, {h, h}, {-h, h}};
}

// Five arms with bays between them: radius 500 to 1100 m.
geo::Ring star_ring() {
  geo::Ring ring;
  for (int i = 0; i < 720; ++i) {
    const double bearing = geo::radians(i * 0.5);
    ring.push_back((800 + 300 * std::cos(5 * bearing)) * geo::unit(bearing));
  }
  return ring;
}

struct Case {
  geo::Ring ring;
  double growth = 0;  // of the fire along its normal [m/s]
  Vec2 wind = Vec2::Zero();
  bool clockwise = true;
  double false_rate = 0;
  double duration = 1800;  // [s]
  bool finder = false;     // an ideal edge finder instead of readings
};

struct Outcome {
  double mean_distance = 0;   // to the true edge [m]
  double worst_distance = 0;  // [m]
  double progress = 0;        // along the edge [m/s]
  double crossings = 0;       // per minute
  double longest_gap = 0;     // between true crossings [s]
};

// Flies around a fire; the first 100 s (the approach) do not count. `rings` of a growing
// fire are those of the start, moved along their normals.
Outcome follow(const Case& c, std::uint64_t seed = 1) {
  const geo::BoundaryIndex edge(geo::Region{c.ring});
  RandomStream random(seed, 0, Purpose::kTest);
  std::vector<double> arc(c.ring.size() + 1, 0);
  for (std::size_t i = 0; i < c.ring.size(); ++i)
    arc[i + 1] = arc[i] + (c.ring[(i + 1) % c.ring.size()] - c.ring[i]).norm();
  const double length = arc.back();

  test::TestAircraft aircraft;
  const Vec2 start = c.ring.front();
  aircraft.p.head<2>() = start + 500 * start.normalized() + Vec2(30, -60);
  aircraft.heading = random.uniform(-geo::kPi, geo::kPi);
  aircraft.wind = c.wind;
  const Vec2 tangent = (c.ring[1] - c.ring.back()).normalized();
  EdgeFollower follower(EdgeFollowerOptions{}, FollowEdge{c.clockwise, start, tangent});

  Outcome out;
  const double dt = 0.05, warm_up = 100;
  double last_s = 0, last_crossing = warm_up, along = 0;
  bool was_inside = false;
  int n = 0, crossings = 0;
  const int steps = static_cast<int>(std::lround(c.duration / dt));
  for (int i = 0; i < steps; ++i) {
    const double t = i * dt;
    const Time now = Time::from_ns(i * 50'000'000LL);
    const Vec2 p = aircraft.position();
    const double signed_distance = edge.signed_distance(p) - c.growth * t;
    const bool inside = signed_distance < 0;
    if (i % 20 == 0) {
      const bool wrong = random.uniform() < c.false_rate;
      if (c.finder) {
        const auto at = edge.nearest(p);
        const auto k = static_cast<std::size_t>(at.edge);
        const Vec2 along_edge =
            (c.ring[(k + 1) % c.ring.size()] - c.ring[k]).normalized();
        const Vec2 to_edge = at.point - p;
        // The moved boundary lies `growth t` further out on the same normal.
        const Vec2 outwards =
            to_edge.norm() > 1e-9
                ? Vec2((edge.contains(p) ? 1 : -1) * to_edge.normalized())
                : geo::outward_normal(along_edge);
        follower.add(EdgeSample{now, to_edge + c.growth * t * outwards, along_edge}, p);
      } else {
        follower.add(FireReading{now, {1}, p, 0, inside != wrong},
                     geo::bearing(aircraft.velocity()));
      }
      aircraft.obey({HoldCourse{follower.course(now, p)}, 220});
    }
    aircraft.step(dt);

    const auto at = edge.nearest(p);
    const double s = arc[static_cast<std::size_t>(at.edge)] +
                     at.along * (arc[static_cast<std::size_t>(at.edge) + 1] -
                                 arc[static_cast<std::size_t>(at.edge)]);
    if (t > warm_up) {
      // A convex ring that moves by d grows by 2 pi d.
      const double stretch = (length + 2 * geo::kPi * c.growth * t) / length;
      along += std::remainder(s - last_s, length) * stretch * (c.clockwise ? 1 : -1);
      out.mean_distance += std::abs(signed_distance);
      out.worst_distance = std::max(out.worst_distance, std::abs(signed_distance));
      ++n;
      if (inside != was_inside) {
        ++crossings;
        out.longest_gap = std::max(out.longest_gap, t - last_crossing);
        last_crossing = t;
      }
    }
    last_s = s;
    was_inside = inside;
  }
  out.longest_gap = std::max(out.longest_gap, c.duration - last_crossing);
  out.mean_distance /= n;
  out.progress = along / (c.duration - warm_up);
  out.crossings = crossings * 60 / (c.duration - warm_up);
  return out;
}

void print(const std::string& name, const Outcome& o) {
  std::printf(
      "%-34s mean %5.1f m  worst %5.0f m  progress %5.1f m/s  %4.1f cross/min  gap %4.0f "
      "s\n",
      name.c_str(), o.mean_distance, o.worst_distance, o.progress, o.crossings,
      o.longest_gap);
}

TEST(EdgeFollower, KeepsToASmoothEdge) {
  for (const bool clockwise : {true, false}) {
    for (const double growth : {0.0, 0.2, 1.0, 3.0}) {
      for (const double wind : {0.0, 4.0, 8.0}) {
        const Outcome o = follow({circle_ring(500), growth, {wind, 0}, clockwise});
        print("circle growth " + std::to_string(growth).substr(0, 3) + " wind " +
                  std::to_string(wind).substr(0, 3) + (clockwise ? " cw" : " ccw"),
              o);
        EXPECT_LT(o.mean_distance, 40);
        EXPECT_GT(o.progress, 13);
        EXPECT_LT(o.longest_gap, 60);
      }
    }
  }
}

TEST(EdgeFollower, TurnsCornersAndBays) {
  for (const bool clockwise : {true, false}) {
    for (const double growth : {0.0, 0.5, 2.0}) {
      for (const double wind : {0.0, 8.0}) {
        const std::string how = " growth " + std::to_string(growth).substr(0, 3) +
                                " wind " + std::to_string(wind).substr(0, 3) +
                                (clockwise ? " cw" : " ccw");
        const Outcome square = follow({square_ring(2000), growth, {0, wind}, clockwise});
        print("square" + how, square);
        EXPECT_LT(square.longest_gap, 60);
        EXPECT_LT(square.mean_distance, 40);
        const Outcome star = follow({star_ring(), growth, {wind, 0}, clockwise});
        print("star" + how, star);
        EXPECT_LT(star.longest_gap, 60);
        EXPECT_LT(star.mean_distance, 60);
      }
    }
  }
}

TEST(EdgeFollower, BearsFalseReadings) {
  for (const double rate : {0.02, 0.05}) {
    const Outcome o = follow({circle_ring(500), 0.5, {4, 0}, true, rate});
    print("false " + std::to_string(rate).substr(0, 4), o);
    EXPECT_LT(o.mean_distance, 40);
    EXPECT_LT(o.longest_gap, 60);
  }
}

TEST(EdgeFollower, AnIdealFinderKeepsItsOffset) {
  for (const bool clockwise : {true, false}) {
    const Outcome o = follow({circle_ring(500), 0.5, {8, 0}, clockwise, 0, 1800, true});
    print("finder", o);
    EXPECT_NEAR(o.mean_distance, EdgeFollowerOptions{}.offset, 8);
    EXPECT_GT(o.progress, 15);
  }
}

}  // namespace
}  // namespace skein::reasoning
