// SPDX-License-Identifier: Apache-2.0
// Planners of tasks with values that nobody means well with: each answers with an
// outcome, and what it plans is continuous. None may stop with a Bug or take forever.

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "skein/base/random.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/coverage/coverage.h"
#include "skein/solve/target/orbit.h"
#include "skein/solve/target/rendezvous.h"
#include "skein/solve/touring/patrol.h"

namespace skein::solve::hostile_test {
namespace {

// Mostly usual values, some odd ones.
class Odd {
 public:
  explicit Odd(std::uint64_t seed) : random_(seed, 0, Purpose::kTest) {}

  double value(double usual) {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    const std::array<double, 12> odd = {0,    -1,   1e-9, 1e-3,  1e5,   9e5,
                                        1e18, -1e7, kInf, -kInf, 1e300, std::nan("")};
    if (random_.uniform() < 0.06)
      return odd[static_cast<std::size_t>(random_.uniform() * odd.size())];
    return usual * random_.uniform(0.5, 1.5);
  }
  Vec2 place(double size) {
    // Places coincide now and then.
    const auto axis = [&] {
      return std::floor(random_.uniform(-3, 3)) * value(size) / 3;
    };
    return {axis(), axis()};
  }
  FlightState state() {
    const Vec2 p = place(500);
    return {{p.x(), p.y(), -value(100)}, value(2)};
  }
  FlightLimits limits() {
    return {value(15), value(40), value(3), value(9), value(30), value(3)};
  }
  Vec2 wind() { return value(random_.uniform(0, 14)) * geo::unit(value(3)); }
  int count(int min, int max) {
    return min + static_cast<int>(random_.uniform() * (max - min + 1));
  }

 private:
  RandomStream random_;
};

void expect_continuous(const FlightPlan& plan) {
  for (std::size_t i = 0; i + 1 < plan.size(); ++i) {
    const model::FlightMoment end = model::end_of(plan[i]);
    // What is far away or takes long is rounded more.
    const double size = 1 + end.p_N.norm() + plan[i + 1].start;
    ASSERT_LT((end.p_N - plan[i + 1].p_N).norm(), 1e-6 * size) << i;
    ASSERT_NEAR(geo::wrap_pi(end.heading - plan[i + 1].heading), 0, 1e-6) << i;
  }
}

TEST(Hostile, Coverage) {
  for (std::uint64_t i = 0; i < 100; ++i) {
    Odd odd(i);
    CoverageQuery q;
    for (int k = odd.count(2, 7); k > 0; --k) q.area.push_back(odd.place(600));
    for (int k = odd.count(0, 1); k > 0; --k)
      q.holes.push_back({odd.place(300), odd.place(300), odd.place(300)});
    for (int k = odd.count(0, 1); k > 0; --k)
      q.zones.push_back({Disc{odd.place(400), odd.value(50)}});
    q.swath = odd.value(150);
    q.overlap = odd.value(0.1);
    q.overshoot = odd.value(5);
    q.altitude_msl = odd.value(100);
    q.limits = odd.limits();
    q.wind = odd.wind();
    q.aircraft.assign(static_cast<std::size_t>(odd.count(1, 2)), {odd.state(), {}});
    const CoverageResult r = plan_coverage(q);
    EXPECT_EQ(r.plans.empty(),
              r.reason.size() > 0 && r.outcome != CoverageOutcome::kZoneInTheWay);
    for (const FlightPlan& plan : r.plans) expect_continuous(plan);
  }
}

TEST(Hostile, Orbit) {
  int planned = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    Odd odd(i);
    OrbitQuery q;
    q.kind = odd.count(0, 1) == 0 ? OrbitKind::kCircle : OrbitKind::kWeave;
    q.target.at = {odd.value(10), odd.place(800)};
    q.target.velocity = odd.value(4) * geo::unit(odd.value(2));
    for (int k = odd.count(-2, 3); k > 0; --k)
      q.target.track.push_back({200.0 * (4 - k) + odd.value(50), odd.place(800)});
    q.radius = odd.value(150);
    q.tolerance = odd.value(2);
    q.duration = odd.value(300);
    q.altitude_msl = odd.value(100);
    q.start = odd.state();
    q.limits = odd.limits();
    q.wind = odd.wind();
    const OrbitResult r = plan_orbit(q);
    EXPECT_EQ(r.reason.empty(), r.outcome == OrbitOutcome::kPlanned);
    expect_continuous(r.plan);
    planned += r.outcome == OrbitOutcome::kPlanned ? 1 : 0;
  }
  EXPECT_GT(planned, 50);
}

TEST(Hostile, Patrol) {
  int planned = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    Odd odd(i);
    PatrolQuery q;
    for (int k = odd.count(1, 6); k > 0; --k) q.line.push_back(odd.place(900));
    q.closed = odd.count(0, 1) == 1;
    q.offset = odd.value(30);
    q.corners =
        odd.count(0, 1) == 1 ? PatrolCorners::kRounded : PatrolCorners::kFlownOver;
    q.tolerance = odd.value(20);
    q.rounds = odd.count(0, 4);
    if (odd.count(0, 3) == 0) q.until = odd.value(900);
    q.altitude_msl = odd.value(100);
    q.limits = odd.limits();
    q.wind = odd.wind();
    for (int k = odd.count(0, 3); k > 0; --k) q.starts.push_back(odd.state());
    const PatrolResult r = plan_patrol(q);
    EXPECT_EQ(r.reason.empty(), r.outcome == PatrolOutcome::kPlanned);
    for (const FlightPlan& plan : r.plans) expect_continuous(plan);
    planned += r.outcome == PatrolOutcome::kPlanned ? 1 : 0;
  }
  EXPECT_GT(planned, 50);
}

TEST(Hostile, Rendezvous) {
  int planned = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    Odd odd(i);
    RendezvousQuery q;
    for (int k = odd.count(0, 3); k > 0; --k)
      q.aircraft.push_back({odd.state(), odd.state(), odd.value(10), odd.limits()});
    if (odd.count(0, 1) == 1) q.time = odd.value(150);
    q.spacing = odd.value(10);
    q.wind = odd.wind();
    const RendezvousResult r = plan_rendezvous(q);
    EXPECT_EQ(r.reason.empty(), r.outcome == RendezvousOutcome::kPlanned);
    for (const FlightPlan& plan : r.plans) expect_continuous(plan);
    planned += r.outcome == RendezvousOutcome::kPlanned ? 1 : 0;
  }
  EXPECT_GT(planned, 15);
}

}  // namespace
}  // namespace skein::solve::hostile_test
