// SPDX-License-Identifier: Apache-2.0
// No-fly zones that come and go in flight, through the whole stack: drawn at the ground
// station, reported by radio, kept out of by agents and by the failsafes of autopilots.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "skein/assemble/test/whole_flight.h"
#include "skein/data/airspace/zone.h"

namespace skein::assemble::zone_flight_test {
namespace {

// From the origin to the north and back, at 100 m above the ground at sea level.
std::string scenario_of(const std::string& zones, const std::string& more = "",
                        const std::string& agent =
                            "{kind: route, points_m: [[2000, 0], "
                            "[0, 0]], laps: 1}") {
  return fmt::format(R"(
seed: 5
duration_s: 400
environment:
  terrain: flat
  phenomena: []
  wind: {{kind: uniform, speed_mps: 4, from_deg: 250}}
  zones: [{}]
missions: []
{}
aircraft:
  - name: a
    agent: {}
    altitude_agl_m: 100
    start: {{placement: list, positions_m: [[0, 0]], heading_deg: 0}}
)",
                     zones, more, agent);
}

constexpr double kOn = 30;  // the aircraft is 600 m north then
const Vec2 kCentre(1200, 10);
constexpr double kRadius = 150;

std::string disc(const std::string& more) {
  return fmt::format("{{name: drawn, centre_m: [1200, 10], radius_m: 150, {}}}", more);
}

// How far inside a disc, and how long, an aircraft was at most.
double deepest(const FlightLog& log, const Vec2& centre, double radius, double from,
               double until = 1e9, std::uint32_t who = 1) {
  double depth = -1e9;
  for (const FlightRow& row : log.rows.at(who))
    if (row.time.seconds() >= from && row.time.seconds() <= until)
      depth = std::max(depth, radius - (geo::horizontal(row.truth.p_N) - centre).norm());
  return depth;
}

const Event* event_of(const FlightLog& log, std::uint32_t who, EventKind kind) {
  for (const Event& event : log.events)
    if (event.entity.value == who && event.kind == kind) return &event;
  return nullptr;
}

TEST(ZoneFlight, DrawnOverTheRouteItIsFlownAround) {
  const FlightLog log = fly(scenario_of(disc("active: false, switches: [{at_s: 30}]")));
  const Event* reported = event_of(log, 0, EventKind::kZoneOn);
  const Event* heard = event_of(log, 1, EventKind::kZoneOn);
  ASSERT_TRUE(reported && heard) << log.story();
  EXPECT_EQ(reported->time, Time::from_seconds(kOn));
  // The radio takes 0.1 s, and the agent thinks every 0.5 s.
  EXPECT_LE((heard->time - reported->time).seconds(), 0.5 + 1e-9);
  EXPECT_NE(log.find(EventKind::kZonesKnown), nullptr) << log.story();
  EXPECT_LT(deepest(log, kCentre, kRadius, 0), 0) << log.story();
  EXPECT_NE(log.find(EventKind::kRouteDone), nullptr) << log.story();
  EXPECT_EQ(log.find(EventKind::kZone, "is inside a no-fly zone"), nullptr)
      << log.story();
}

// From the ground, with sensors that err, in gusts; the zone comes onto the route and,
// later, over the place where it shall land.
TEST(ZoneFlight, WholeAircraftFlyAroundAndLandElsewhere) {
  for (const char* plant : {"multirotor", "{kind: fixed-wing, aircraft: bixler}",
                            "{kind: fixed-wing, aircraft: aerosonde-stall}"}) {
    SCOPED_TRACE(plant);
    const FlightLog log = fly(fmt::format(R"(
seed: 3
duration_s: 500
environment:
  terrain: flat
  phenomena: []
  wind: {{kind: uniform, speed_mps: 4, from_deg: 250}}
  turbulence: {{kind: dryden, intensity: light}}
  zones:
    - {{name: route, centre_m: [500, 10], radius_m: 80, active: false, switches: [{{at_s: 14}}]}}
    - {{name: home, centre_m: [-10, 0], radius_m: 60, active: false, switches: [{{at_s: 60}}]}}
missions: []
aircraft:
  - name: a
    plant: {}
    autopilot: skein
    sensors: [{{kind: flight, receiver: differential}}]
    agent: {{kind: route, points_m: [[900, 0], [900, 400], [300, 400]], laps: 1, lands: true}}
    altitude_agl_m: 60
    start: {{placement: list, positions_m: [[0, 0]], heading_deg: 0, on_ground: true}}
)",
                                          plant));
    for (const EventKind kind : {EventKind::kTookOff, EventKind::kReturnMoved,
                                 EventKind::kRouteDone, EventKind::kLanded})
      EXPECT_NE(log.find(kind), nullptr) << row_of(kind).name << "\n" << log.story();
    for (const EventKind kind :
         {EventKind::kAccident, EventKind::kRefused, EventKind::kNoPath})
      EXPECT_EQ(log.find(kind), nullptr) << row_of(kind).name << "\n" << log.story();
    EXPECT_LT(deepest(log, {500, 10}, 80, 14), 0) << log.story();
    // Away by then, and never back.
    EXPECT_LT(deepest(log, {-10, 0}, 60, 60), 0) << log.story();
    EXPECT_TRUE(log.rows.at(1).back().truth.on_ground);
  }
}

// Both autopilots take the same waypoints, sent again, for a repetition.
TEST(ZoneFlight, EveryLapIsFlownWithoutThePointThatIsLeftOut) {
  for (const char* how : {"",
                          "plant: {kind: fixed-wing, aircraft: bixler}\n    "
                          "autopilot: skein\n    sensors: [flight]"}) {
    SCOPED_TRACE(how);
    const FlightLog log = fly(fmt::format(R"(
seed: 5
duration_s: 900
environment:
  terrain: flat
  phenomena: []
  wind: {{kind: uniform, speed_mps: 5, from_deg: 250}}
  zones: [{{name: corner, centre_m: [1500, 0], radius_m: 200, active: false, switches: [{{at_s: 20}}]}}]
missions: []
aircraft:
  - name: a
    {}
    agent: {{kind: route, points_m: [[1500, 0], [1500, 900], [0, 900]], laps: 3}}
    altitude_agl_m: 120
    start: {{placement: list, positions_m: [[0, 0]], heading_deg: 0}}
)",
                                          how));
    int visits = 0;
    bool there = false;
    for (const FlightRow& row : log.rows.at(1)) {
      const double off = (geo::horizontal(row.truth.p_N) - Vec2(1500, 900)).norm();
      const bool was = there;
      there = off < (was ? 400 : 200);
      visits += there && !was;
    }
    EXPECT_EQ(visits, 3) << log.story();
    ASSERT_NE(log.find(EventKind::kRouteDone), nullptr) << log.story();
    EXPECT_EQ(log.find(EventKind::kRouteDone)->text, "the last point has been passed");
    EXPECT_LT(deepest(log, {1500, 0}, 200, 20), 0) << log.story();
  }
}

TEST(ZoneFlight, ALastPointInAZoneIsReportedAsLeftOutOnce) {
  const FlightLog log =
      fly(scenario_of("{name: goal, centre_m: [1500, 0], radius_m: 200, active: false, "
                      "switches: [{at_s: 20}]}",
                      "", "{kind: route, points_m: [[1500, 0]]}"));
  EXPECT_EQ(log.find(EventKind::kNoPath), nullptr) << log.story();
  EXPECT_EQ(
      std::count_if(log.events.begin(), log.events.end(),
                    [](const Event& e) { return e.kind == EventKind::kPointLeftOut; }),
      1)
      << log.story();
  ASSERT_NE(log.find(EventKind::kRouteDone), nullptr) << log.story();
  EXPECT_NE(log.find(EventKind::kRouteDone)->text.find("left out"), std::string::npos)
      << log.story();
}

TEST(ZoneFlight, OnOrOffItStaysOutOnlyWhileItIsInForce) {
  // Taken back before the aircraft comes back: it flies straight through.
  const FlightLog log = fly(
      scenario_of(disc("active: false, switches: [{at_s: 30}, {at_s: 110, on: false}]")));
  ASSERT_NE(event_of(log, 1, EventKind::kZoneOff), nullptr) << log.story();
  EXPECT_LT(deepest(log, kCentre, kRadius, 0, 110), 0) << log.story();
  EXPECT_GT(deepest(log, kCentre, kRadius, 110), 50) << log.story();
}

TEST(ZoneFlight, FlightsBelowTheFloorOrAboveTheCeilingAreNotConcerned) {
  const FlightLog free = fly(scenario_of(""));
  for (const char* limits : {"floor_msl_m: 130", "ceiling_msl_m: 70", "from_s: 399"}) {
    const FlightLog log = fly(scenario_of(
        disc(fmt::format("active: false, switches: [{{at_s: 30}}], {}", limits))));
    ASSERT_NE(event_of(log, 1, EventKind::kZoneOn), nullptr) << log.story();
    const auto &rows = log.rows.at(1), &others = free.rows.at(1);
    ASSERT_EQ(rows.size(), others.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (rows[k].time.seconds() > 330) break;  // zones to come count a minute before
      ASSERT_EQ(rows[k].truth.p_N, others[k].truth.p_N) << limits;
    }
  }
}

TEST(ZoneFlight, AZoneThatComesOverAnAircraftIsLeftByTheShortestPath) {
  for (const char* agent : {"{kind: route, points_m: [[2000, 0], [0, 0]]}", "scout"}) {
    SCOPED_TRACE(agent);
    const FlightLog log = fly(scenario_of(
        "{name: above, centre_m: [600, 60], radius_m: 900, active: false, switches: "
        "[{at_s: 30}]}",
        "", agent));
    EXPECT_NE(log.find(EventKind::kZone, "is inside a no-fly zone"), nullptr)
        << log.story();
    // At 20 m/s in 4 m/s of wind, 960 m at most after a turn of 60 m.
    EXPECT_LT(deepest(log, {600, 60}, 900, 30 + 75), 0) << log.story();
  }
}

constexpr const char* kSkein =
    "\n    plant: {kind: fixed-wing, aircraft: aerosonde-stall}\n    autopilot: skein\n"
    "    sensors: [flight]\n    failures: [{kind: link, at_s: 60}]\n";

// A zone over home, reported before the link fails: the autopilot returns by itself.
TEST(ZoneFlight, AFailsafeDoesNotReturnIntoAZoneThatLiesOverHome) {
  const std::string route = "{kind: route, points_m: [[4000, 0], [4000, 2000]], laps: 9}";
  const std::string zone =
      "{name: home, ring_m: [[-300, -300], [300, -300], [300, 300], [-300, 300]], "
      "active: false, switches: [{at_s: 40}]}";
  const FlightLog log = fly(scenario_of(zone, "", route + kSkein));
  const Event* moved = log.find(EventKind::kReturnMoved);
  ASSERT_NE(moved, nullptr) << log.story();
  EXPECT_LE(moved->time.seconds(), 41);
  ASSERT_NE(log.find(EventKind::kFailsafe, "link: return"), nullptr) << log.story();
  double nearest = 1e9;
  for (const FlightRow& row : log.rows.at(1)) {
    if (row.time.seconds() < 60) continue;
    const Vec2 p = geo::horizontal(row.truth.p_N);
    nearest = std::min(nearest, (p.cwiseAbs() - Vec2(300, 300)).maxCoeff());
  }
  EXPECT_GT(nearest, 0) << log.story();
  // It does come back, and stays near.
  const Vec2 end = geo::horizontal(log.rows.at(1).back().truth.p_N);
  EXPECT_LT(end.norm(), 1200) << log.story();
}

TEST(ZoneFlight, AFailsafeReturnsAroundAZoneOnTheRouteHome) {
  const std::string route = "{kind: route, points_m: [[4000, 0], [4000, 2000]], laps: 9}";
  const std::string zone =
      "{name: between, ring_m: [[300, -500], [800, -500], [800, 500], [300, 500]], "
      "active: false, switches: [{at_s: 55}]}";
  const FlightLog log = fly(scenario_of(zone, "", route + kSkein));
  ASSERT_NE(log.find(EventKind::kFailsafe, "link: return"), nullptr) << log.story();
  double deepest_in = -1e9;
  for (const FlightRow& row : log.rows.at(1)) {
    if (row.time.seconds() < 60) continue;
    const Vec2 p = geo::horizontal(row.truth.p_N);
    deepest_in = std::max(deepest_in,
                          std::min({p.x() - 300, 800 - p.x(), 500 - p.y(), p.y() + 500}));
  }
  EXPECT_LT(deepest_in, 0) << log.story();
  const Vec2 end = geo::horizontal(log.rows.at(1).back().truth.p_N);
  EXPECT_LT(end.norm(), 400) << log.story();
}

TEST(ZoneFlight, LostMessagesAreSentAgainUntilAllKnow) {
  const FlightLog log = fly(scenario_of(disc("active: false, switches: [{at_s: 20}]"),
                                        "radio: {kind: ideal, loss: 0.7}"));
  EXPECT_NE(event_of(log, 1, EventKind::kZoneOn), nullptr) << log.story();
  EXPECT_NE(log.find(EventKind::kZonesKnown), nullptr) << log.story();
}

TEST(ZoneFlight, IsTheSameForAnyNumberOfThreads) {
  std::string hash;
  for (const int threads : {1, 2, 4}) {
    Flown how;
    how.threads = threads;
    const FlightLog log = fly(
        R"(
seed: 5
duration_s: 90
environment:
  phenomena: []
  zones:
    - {name: one, centre_m: [0, 0], radius_m: 300, active: false,
       switches: [{at_s: 10}, {at_s: 60, on: false}]}
    - {name: two, ring_m: [[500, -900], [800, -900], [800, 900], [500, 900]],
       active: false, switches: [{at_s: 20}]}
radio: {kind: ideal, loss: 0.3}
missions: []
aircraft:
  - {name: a, count: 30, agent: {kind: route, points_m: [[0, 0], [1500, 0]], laps: 4}}
  - {name: b, count: 10, agent: scout}
)",
        how);
    EXPECT_NE(log.find(EventKind::kZoneOn), nullptr);
    if (hash.empty()) hash = log.hash();
    EXPECT_EQ(log.hash(), hash) << threads << " threads";
  }
}

}  // namespace
}  // namespace skein::assemble::zone_flight_test
