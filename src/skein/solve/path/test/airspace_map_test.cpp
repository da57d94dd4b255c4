// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/airspace_map.h"

#include <gtest/gtest.h>

#include "skein/base/random.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/test/oracle.h"

namespace skein::solve::airspace_map_test {
namespace {

using test::depth;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed, 0, Purpose::kTest) {}
  double operator()(double low, double high) { return random_.uniform(low, high); }
  Vec2 place(double half) { return {(*this)(-half, half), (*this)(-half, half)}; }

  FlightElement element(bool windy) {
    FlightElement e;
    const Vec2 p = place(350);
    e.p_N = Vec3(p.x(), p.y(), -(*this)(80, 160));
    e.start = (*this)(0, 60);
    e.duration = (*this)(1, 40);
    e.heading = (*this)(-4, 4);
    e.airspeed = 20;
    if ((*this)(0, 1) < 0.7) e.turn_rate = (*this)(-0.33, 0.33);
    if ((*this)(0, 1) < 0.5) e.climb_rate = (*this)(-3, 3);
    if ((*this)(0, 1) < 0.4)
      e.climb_acceleration = ((*this)(-3, 3) - e.climb_rate) / e.duration;
    if (windy) e.wind = place(10);
    return e;
  }

  Zone zone() {
    Zone z;
    const Vec2 p = place(400);
    if ((*this)(0, 1) < 0.5) {
      z.area = Disc{p, (*this)(20, 150)};
    } else {
      geo::Ring ring;
      const int corners = 3 + static_cast<int>((*this)(0, 9));
      for (int i = 0; i < corners; ++i)
        ring.push_back(p + (*this)(40, 200) * geo::unit(2 * geo::kPi * i / corners));
      z.area = ring;
    }
    if ((*this)(0, 1) < 0.5) z.floor_msl = (*this)(60, 130);
    if ((*this)(0, 1) < 0.5) z.ceiling_msl = z.floor_msl > 0 ? z.floor_msl + 20 : 110;
    if ((*this)(0, 1) < 0.3) z.from = (*this)(0, 60);
    if ((*this)(0, 1) < 0.3) z.until = std::max(z.from, 0.0) + (*this)(0, 30);
    return z;
  }

  MovingObstacle mover() {
    MovingObstacle m;
    m.time = (*this)(-100, 200);
    const Vec2 p = place(400), v = place(15);
    m.p_N = Vec3(p.x(), p.y(), -(*this)(80, 160));
    m.v_N = Vec3(v.x(), v.y(), (*this)(-0.5, 0.5));
    m.p_N.head<2>() += (m.time - 40) * v;
    m.radius = (*this)(20, 120);
    if ((*this)(0, 1) < 0.3) m.until = 40;
    return m;
  }

  PlannedFlight flight() {
    PlannedFlight f;
    for (int i = 0; i < 4; ++i) {
      FlightElement e = element(true);
      e.duration = (*this)(3, 20);
      if (!f.plan.empty()) {
        const model::FlightMoment end = model::end_of(f.plan.back());
        e.start = model::end_time_of(f.plan);
        e.p_N = end.p_N;
        e.heading = end.heading;
      }
      f.plan.push_back(e);
    }
    return f;
  }

 private:
  RandomStream random_;
};

AirspaceMap map_of(const Airspace& airspace) {
  PathQuery query;
  query.airspace = &airspace;
  return AirspaceMap(query);
}

double deepest(const Airspace& airspace, const FlightElement& e, double step = 0.02) {
  return depth(airspace, FlightPlan{e}, step);
}

// What is called free is never deeper than 0.1 m; what is not is at most `slack` m off:
// chords count 0.03 m near, other flights' pieces 0.5 m and 0.05 s of motion in either
// direction, and samples of flights are 0.2 s apart.
void agrees_with_sampling(std::uint64_t seed, double slack,
                          const std::function<void(Draw&, Airspace&)>& fill) {
  Draw draw(seed);
  int free = 0, hit = 0;
  for (int i = 0; i < 300; ++i) {
    Airspace airspace;
    fill(draw, airspace);
    const AirspaceMap map = map_of(airspace);
    const FlightElement e = draw.element(i % 2 == 0);
    const double by = deepest(airspace, e, airspace.flights.empty() ? 0.02 : 0.2);
    if (map.is_free(e)) {
      ++free;
      EXPECT_LE(by, 0.1) << "case " << i;
    } else {
      ++hit;
      EXPECT_GE(by, -slack) << "case " << i;
    }
  }
  EXPECT_GT(free, 40);
  EXPECT_GT(hit, 40);
}

TEST(AirspaceMap, AgreesWithSamplingOfZones) {
  // Samples are 0.4 m apart at most and may miss the deepest place by as much; altitudes
  // and times of zones are missed by one sample.
  agrees_with_sampling(1, 1e10, [](Draw& d, Airspace& a) {
    for (int i = 0; i < 4; ++i) a.zones.push_back(d.zone());
  });
  agrees_with_sampling(2, 0.05, [](Draw& d, Airspace& a) {
    for (int i = 0; i < 4; ++i) {
      a.zones.push_back({d.zone().area});
    }
  });
}

TEST(AirspaceMap, AgreesWithSamplingOfMovers) {
  agrees_with_sampling(3, 1e10, [](Draw& d, Airspace& a) {
    for (int i = 0; i < 9; ++i) a.movers.push_back(d.mover());
  });
  agrees_with_sampling(4, 0.05, [](Draw& d, Airspace& a) {
    for (int i = 0; i < 4; ++i) {
      a.movers.push_back(d.mover());
      a.movers.back().height = 1e6;
      a.movers.back().until = 1e6;
    }
  });
}

TEST(AirspaceMap, AgreesWithSamplingOfFlights) {
  agrees_with_sampling(5, 6, [](Draw& d, Airspace& a) {
    for (int i = 0; i < 3; ++i) {
      a.flights.push_back(d.flight());
      a.flights.back().height = 1e6;
    }
  });
}

// The other side of floors, ceilings and times: what samples find is never called free.
TEST(AirspaceMap, FindsWhatSamplesFind) {
  Draw draw(6);
  int hit = 0;
  for (int i = 0; i < 400; ++i) {
    Airspace airspace;
    airspace.zones.push_back(draw.zone());
    airspace.movers.push_back(draw.mover());
    airspace.flights.push_back(draw.flight());
    const FlightElement e = draw.element(true);
    if (deepest(airspace, e, 0.1) < 0.1) continue;
    ++hit;
    EXPECT_FALSE(map_of(airspace).is_free(e)) << i;
  }
  EXPECT_GT(hit, 40);
}

TEST(AirspaceMap, GivesTheFirstConflictInTimeAndWords) {
  Airspace airspace;
  airspace.zones.push_back({Disc{Vec2(500, 0), 100}});
  airspace.zones.push_back({Disc{Vec2(300, 0), 50}});
  airspace.zones.back().name = "dam";
  const FlightElement e{10, 60, Vec3(0, 0, -100), 0, 20, 0, 0, Vec2(0, 0)};
  const auto c = map_of(airspace).first_conflict({e});
  ASSERT_TRUE(c);
  EXPECT_EQ(c->index, 1u);
  // 250 m at 20 m/s; reported to 0.01 s.
  EXPECT_NEAR(c->time, 22.5, 0.02);
  EXPECT_NE(c->what.find("zone 'dam' at 250."), std::string::npos) << c->what;
  EXPECT_NE(c->what.find("by 40.0 m"), std::string::npos) << c->what;  // 2 s on
}

TEST(AirspaceMap, KnowsTheEdgeOfTheMapInTurns) {
  PathQuery query;
  query.south_west = Vec2(0, -100);
  query.north_east = Vec2(1000, 100);
  const AirspaceMap map(query);
  // A right turn of 60 m reaches 120 m east, from 20 m west it reaches 100 m.
  const FlightElement e{0, 18, Vec3(500, 0, 0), 0, 20, 1.0 / 3, 0, Vec2(0, 0)};
  EXPECT_FALSE(map.is_free(e));
  FlightElement west = e;
  west.p_N.y() = -20;
  EXPECT_TRUE(map.is_free(west));
}

class Ridge final : public Terrain {
 public:
  // A wall of slope 1 along east, 200 m high at 1000 m north.
  double elevation_msl(const Vec2& p) const override {
    return std::max(0.0, 200 - std::abs(p.x() - 1000));
  }
  Vec2 gradient(const Vec2&) const override { return {0, 0}; }
};

TEST(AirspaceMap, KeepsClearOfTheGround) {
  const Ridge ridge;
  PathQuery query;
  query.terrain = &ridge;
  query.ground_clearance = 50;
  const AirspaceMap map(query);
  FlightElement e{0, 100, Vec3(0, 0, -251), 0, 20, 0, 0, Vec2(0, 0)};
  EXPECT_TRUE(map.is_free(e));
  e.p_N.z() = -249;
  EXPECT_FALSE(map.is_free(e));
  const auto c = map.first_conflict({e});
  ASSERT_TRUE(c);
  EXPECT_EQ(c->blocker, Blocker::kGround);
  EXPECT_NEAR(c->p_N.x(), 999, 3);  // looks are 2 m apart
}

// Nothing can be reached sooner than the room says.
TEST(AirspaceMap, RoomIsNeverTooLarge) {
  Draw draw(7);
  for (int i = 0; i < 300; ++i) {
    Airspace airspace;
    airspace.zones.push_back(draw.zone());
    airspace.movers.push_back(draw.mover());
    airspace.flights.push_back(draw.flight());
    const AirspaceMap map = map_of(airspace);
    FlightElement e = draw.element(false);
    const double room = map.room(e.p_N, e.start, {20, 3}, 500);
    EXPECT_GE(room, 0);
    // Not quite: what begins just then may be met.
    e.duration = std::min(e.duration, (1 - 1e-9) * room / 20);
    if (room > 0) {
      EXPECT_LE(deepest(airspace, e, 0.1), 0.1) << i;
    }
  }
}

TEST(AirspaceMap, FlightsMayBeAddedOneByOne) {
  Draw draw(8);
  Airspace all;
  for (int i = 0; i < 60; ++i) all.flights.push_back(draw.flight());
  const Airspace none;
  AirspaceMap grown = map_of(none);
  for (const PlannedFlight& f : all.flights) grown.add(f);
  const AirspaceMap whole = map_of(all);
  for (int i = 0; i < 300; ++i) {
    const FlightElement e = draw.element(true);
    EXPECT_EQ(grown.is_free(e), whole.is_free(e)) << i;
  }
}

TEST(AirspaceMap, NamesTheNearestFreePlaceAndTime) {
  Airspace airspace;
  airspace.zones.push_back({Disc{Vec2(0, 0), 100}});
  airspace.zones.back().until = 50;
  const AirspaceMap map = map_of(airspace);
  const auto p = map.nearest_free(Vec3(90, 0, -100), 0);
  ASSERT_TRUE(p);
  EXPECT_NEAR((*p - Vec3(100, 0, -100)).norm(), 0, 0.1);  // what may be entered
  EXPECT_FALSE(map.conflict_at(*p, 0));
  ASSERT_TRUE(map.free_from(Vec3(0, 0, -100), 10));
  EXPECT_NEAR(*map.free_from(Vec3(0, 0, -100), 10), 50, 0.01);
  airspace.zones.back().until = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(map_of(airspace).free_from(Vec3(0, 0, -100), 10));
}

}  // namespace
}  // namespace skein::solve::airspace_map_test
