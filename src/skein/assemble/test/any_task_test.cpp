// SPDX-License-Identifier: Apache-2.0
// Every aircraft flies every kind of task, whatever its scenario calls it.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <fstream>

#include "skein/assemble/test/whole_flight.h"
#include "skein/exchange/plan/plan_reading.h"
#include "skein/exchange/table/formats.h"
#include "skein/model/connection/airplane.h"
#include "skein/model/path/flight_plan.h"

namespace skein::assemble::any_task_test {
namespace {

// Ordered by an operator, one after the other.
std::string scenario_of(const char* plant, const char* agent) {
  return fmt::format(R"(
seed: 5
duration_s: 760
environment: {{terrain: flat, phenomena: [], wind: {{kind: uniform, speed_mps: 4, from_deg: 130}}}}
missions: []
aircraft:
  - name: a
    plant: {}
    agent: {}
    altitude_agl_m: 80
    start: {{placement: list, positions_m: [[0, 0]], heading_deg: 90}}
commands:
  - {{at_s: 10, do: "task a-1 fly_to 500,300"}}
  - {{at_s: 110, do: "task a-1 route -300,0 -300,-300 laps 1"}}
  - {{at_s: 260, do: "task a-1 tour 0,200 400,0 laps 1"}}
  - {{at_s: 420, do: "task a-1 line -200,-200 -200,200 100,200"}}
  - {{at_s: 560, do: "task a-1 course 45"}}
  - {{at_s: 600, do: "task a-1 follow_edge 300,0 clockwise"}}
  - {{at_s: 640, do: "task a-1 loiter 600,0"}}
)",
                     plant, agent);
}

// How near an aircraft came to a place within a time [m].
double nearest(const FlightLog& log, const Vec2& place, double from, double until) {
  double least = 1e9;
  for (const FlightRow& row : log.rows.at(1))
    if (row.time.seconds() >= from && row.time.seconds() <= until)
      least = std::min(least, (geo::horizontal(row.truth.p_N) - place).norm());
  return least;
}

TEST(AnyTask, IsFlownByEveryAircraftThatTakesOrders) {
  for (const char* plant :
       {"kinematic", "{kind: kinematic, airspeed_mps: 14}",
        "multirotor\n    autopilot: skein\n    sensors: [flight, fire]",
        "{kind: fixed-wing, aircraft: bixler}\n    autopilot: skein\n"
        "    sensors: [flight, fire]"})
    for (const char* agent : {"scout", "wingman"}) {
      SCOPED_TRACE(fmt::format("{} {}", plant, agent));
      const FlightLog log = fly(scenario_of(plant, agent));
      EXPECT_EQ(log.find(EventKind::kTaskRefused), nullptr) << log.story();
      EXPECT_EQ(log.find(EventKind::kCommandRefused), nullptr) << log.story();
      for (const char* kind : {"fly_to", "fly_route", "fly_tour", "follow_line",
                               "fly_course", "follow_edge", "loiter"})
        EXPECT_TRUE(std::any_of(log.events.begin(), log.events.end(),
                                [&](const Event& e) {
                                  return e.kind == EventKind::kTask &&
                                         e.text.ends_with(kind);
                                }))
            << kind << log.story();
      // Of rows a second or less apart, and turns that begin early at corners.
      EXPECT_LT(nearest(log, {500, 300}, 10, 110), 20);
      EXPECT_LT(nearest(log, {-300, -300}, 110, 260), 50);
      EXPECT_LT(nearest(log, {0, 200}, 260, 420), 20);
      EXPECT_LT(nearest(log, {400, 0}, 260, 420), 20);
      EXPECT_LT(nearest(log, {100, 200}, 420, 560), 60);
      EXPECT_LT(nearest(log, {600, 0}, 700, 760), 200);
    }
}

// Every plant, with a camera and a fire sensor.
constexpr const char* kPlants[] = {
    "kinematic\n    sensors: [gnss, air-data, fire, {kind: camera, gimbal: true, "
    "width_deg: 120, length_deg: 120}]",
    "multirotor\n    autopilot: skein\n    sensors: [flight, fire, {kind: camera, "
    "gimbal: true, width_deg: 120, length_deg: 120}]",
    "{kind: fixed-wing, aircraft: bixler}\n    autopilot: skein\n"
    "    sensors: [flight, fire, {kind: camera, gimbal: true, width_deg: 120, "
    "length_deg: 120}]"};

// One task of an aircraft in wind, ordered after half a minute, when it knows the wind.
FlightLog fly_task(const char* plant, const std::string& task, int duration,
                   const std::string& more = "") {
  return fly(fmt::format(R"(
seed: 9
duration_s: {}
environment:
  terrain: flat
  phenomena: []
  wind: {{kind: uniform, speed_mps: 4, from_deg: 250}}
  objects: [{{name: walker, position_m: [200, 150], movement: {{kind: even, velocity_mps: [0.8, -0.6]}}}}]
missions: []
stations: [{{position_m: [0, 600]}}]
aircraft:
  - name: a
    plant: {}
    altitude_agl_m: 80
    start: {{placement: list, positions_m: [[0, 0]], heading_deg: 90}}
commands:
  - {{at_s: 30, do: "task a-1 {}"}}
{})",
                         duration, plant, task, more));
}

bool says(const FlightLog& log, EventKind kind) {
  return log.find(kind) != nullptr;
}

TEST(AnyTask, HoldStaysWhereTheAircraftIs) {
  for (const char* plant : kPlants) {
    SCOPED_TRACE(plant);
    const FlightLog log = fly_task(plant, "hold", 150);
    Vec2 then = Vec2::Zero();
    for (const FlightRow& row : log.rows.at(1)) {
      if (row.time.seconds() <= 30.5) then = geo::horizontal(row.truth.p_N);
      if (row.time.seconds() > 60) {
        EXPECT_LT((geo::horizontal(row.truth.p_N) - then).norm(), 320) << log.story();
      }
    }
  }
}

TEST(AnyTask, SurveySeesAllOfItsArea) {
  for (const char* plant : kPlants) {
    SCOPED_TRACE(plant);
    const FlightLog log = fly_task(
        plant, "survey 100,100 500,100 500,500 100,500 swath 100 overlap 0.1", 900);
    EXPECT_TRUE(says(log, EventKind::kTaskDone)) << log.story();
    // By the truth: every place is within half a swath of the flight.
    for (double north = 105; north < 500; north += 10)
      for (double east = 105; east < 500; east += 10)
        ASSERT_LT(nearest(log, {north, east}, 30, 900), 51) << north << " " << east;
  }
}

TEST(AnyTask, PatrolFliesAlongItsLineAgainAndAgain) {
  for (const char* plant : kPlants) {
    SCOPED_TRACE(plant);
    const FlightLog log = fly_task(plant, "patrol 0,200 600,200 rounds 2", 700);
    EXPECT_TRUE(says(log, EventKind::kTaskDone)) << log.story();
    for (double north = 0; north <= 600; north += 50) {
      int passes = 0;
      bool near = false;
      for (const FlightRow& row : log.rows.at(1)) {
        const double d = (geo::horizontal(row.truth.p_N) - Vec2(north, 200)).norm();
        if (d < 25 && !near) ++passes;
        near = near ? d < 45 : d < 25;
      }
      EXPECT_GE(passes, north == 0 || north == 600 ? 2 : 4) << north;
    }
  }
}

TEST(AnyTask, OrbitStaysWithAPointForItsTime) {
  for (const char* plant : kPlants) {
    SCOPED_TRACE(plant);
    const FlightLog log = fly_task(plant, "orbit 300,-300 radius 120 duration 100", 260);
    EXPECT_TRUE(says(log, EventKind::kTaskDone)) << log.story();
    int there = 0;
    for (const FlightRow& row : log.rows.at(1)) {
      const double d = (geo::horizontal(row.truth.p_N) - Vec2(300, -300)).norm();
      there += std::abs(d - 120) < 12;
    }
    EXPECT_GT(static_cast<double>(there) / static_cast<double>(log.rows.at(1).size()),
              80.0 / 260);
  }
}

TEST(AnyTask, OrbitFollowsAnObjectThatItSees) {
  for (const char* plant : kPlants) {
    SCOPED_TRACE(plant);
    const FlightLog log = fly_task(plant, "orbit 225,130 object 0", 300);
    double worst = 0;
    for (const FlightRow& row : log.rows.at(1)) {
      const double t = row.time.seconds();
      if (t < 120) continue;
      const Vec2 walker = Vec2(200, 150) + t * Vec2(0.8, -0.6);
      worst = std::max(worst, (geo::horizontal(row.truth.p_N) - walker).norm());
    }
    EXPECT_LT(worst, 120) << log.story();
  }
}

TEST(AnyTask, MeasureStaysAndReports) {
  for (const char* plant : kPlants) {
    SCOPED_TRACE(plant);
    const FlightLog log = fly_task(plant, "measure -200,300 stay 30", 220);
    ASSERT_TRUE(says(log, EventKind::kMeasured)) << log.story();
    EXPECT_TRUE(says(log, EventKind::kTaskDone));
    EXPECT_NE(log.find(EventKind::kMeasured)->text.find("fire readings inside"),
              std::string::npos);
  }
}

TEST(AnyTask, RendezvousArrivesInTime) {
  for (const char* plant : kPlants) {
    SCOPED_TRACE(plant);
    const FlightLog log = fly_task(plant, "rendezvous 500,200 time 150", 220);
    ASSERT_TRUE(says(log, EventKind::kArrived)) << log.story();
    EXPECT_LT(nearest(log, {500, 200}, 148, 152), 45) << log.story();
    // Nobody flies 500 m in ten seconds.
    EXPECT_TRUE(
        says(fly_task(plant, "rendezvous 500,200 time 40", 60), EventKind::kLate));
  }
}

TEST(AnyTask, RelayStaysHalfWay) {
  for (const char* plant : kPlants) {
    SCOPED_TRACE(plant);
    const FlightLog log = fly(fmt::format(R"(
duration_s: 240
environment: {{terrain: flat, phenomena: [], wind: {{kind: uniform, speed_mps: 3, from_deg: 0}}}}
missions: []
stations: [{{position_m: [0, 1000]}}]
aircraft:
  - name: a
    plant: {}
    altitude_agl_m: 80
    start: {{placement: list, positions_m: [[0, 0]], heading_deg: 90}}
  - {{name: b, start: {{placement: list, positions_m: [[0, -600]]}}}}
commands:
  - {{at_s: 10, do: "task b-1 hold"}}
  - {{at_s: 10, do: "task a-1 relay station b-1"}}
)",
                                          plant));
    for (const FlightRow& row : log.rows.at(1))
      if (row.time.seconds() > 120) {
        EXPECT_LT((geo::horizontal(row.truth.p_N) - Vec2(0, 200)).norm(), 250)
            << log.story();
      }
  }
}

// Whatever is asked for so near to a zone: it circles where there is room, and stays
// there.
TEST(AnyTask, CirclesBesideAZoneWhereThereIsRoom) {
  for (const char* plant : kPlants)
    for (const char* task : {"loiter 600,60", "fly_to 600,60", "loiter 600,-25"}) {
      SCOPED_TRACE(fmt::format("{} {}", plant, task));
      const FlightLog log = fly(fmt::format(R"(
duration_s: 400
environment:
  terrain: flat
  phenomena: []
  wind: {{kind: uniform, speed_mps: 4, from_deg: 200}}
  zones:
    - {{name: tower, centre_m: [600, 200], radius_m: 100}}
    - {{name: crane, centre_m: [600, -250], radius_m: 100}}
missions: []
aircraft:
  - name: a
    plant: {}
    altitude_agl_m: 80
    start: {{placement: list, positions_m: [[0, 0]], heading_deg: 0}}
commands:
  - {{at_s: 10, do: "task a-1 {}"}}
)",
                                            plant, task));
      for (const FlightRow& row : log.rows.at(1)) {
        const Vec2 p = geo::horizontal(row.truth.p_N);
        ASSERT_GT((p - Vec2(600, 200)).norm(), 110) << log.story();
        ASSERT_GT((p - Vec2(600, -250)).norm(), 110) << log.story();
        if (row.time.seconds() > 150) {
          ASSERT_LT((p - Vec2(600, 20)).norm(), 480);
        }
      }
      EXPECT_LE(std::count_if(log.events.begin(), log.events.end(),
                              [](const Event& e) {
                                return e.kind == EventKind::kZone &&
                                       e.time.seconds() > 150;
                              }),
                0)
          << "it turns away again and again" << log.story();
    }
}

// A zone at its end, too near to mend the plan: until then it is followed, and in time.
TEST(AnyTask, APlanByTheSightOfAZoneIsFollowedWhileThatIsFarAway) {
  const FlightLog log = fly(R"(
duration_s: 200
environment:
  terrain: flat
  phenomena: []
  wind: {kind: uniform, speed_mps: 3, from_deg: 0}
  zones: [{name: mast, centre_m: [1500, 0], radius_m: 150}]
missions: []
aircraft:
  - {name: a, altitude_agl_m: 80, start: {placement: list, positions_m: [[0, 0]], heading_deg: 0}}
commands:
  - {at_s: 10, do: "task a-1 rendezvous 1500,0 time 150"}
)");
  int follows = 0, rows = 0;
  for (const FlightRow& row : log.rows.at(1)) {
    ASSERT_GT((geo::horizontal(row.truth.p_N) - Vec2(1500, 0)).norm(), 150);
    if (row.time.seconds() < 15 || row.time.seconds() > 70) continue;
    ++rows;
    follows += row.status.follows ? 1 : 0;
  }
  EXPECT_GT(follows, 0.9 * rows) << log.story();
}

TEST(AnyTask, APlanFromAFileIsFlownAsItIs) {
  // Scenarios' own: two turns and a straight, as `skein plan connect` wrote it.
  const std::string file = SKEIN_SOURCE_DIR "/scenarios/plans/approach.geojson";
  const auto frame = geo::LocalFrame::at({36.989, -122.0514, 0}).value();
  const FlightPlan plan = exchange::read_plan(file, frame).value();
  const FlightLog log = fly_task(kPlants[0], "plan file " + file, 200);
  EXPECT_TRUE(says(log, EventKind::kTaskDone)) << log.story();
  double worst = 0;
  for (double t = model::start_of(plan); t < model::end_time_of(plan); t += 1) {
    const Vec2 place = geo::horizontal(model::moment_at(plan, t).p_N);
    worst = std::max(worst, nearest(log, place, 30, 200));
  }
  EXPECT_LT(worst, 15);  // rows are a tenth of a second apart, and the wind is another
}

// How far a foam glider is above or below the plan of a climb at worst, as it believes.
double worst_height(double climb_acceleration) {
  const Vec2 wind = -4 * geo::unit(geo::radians(250));
  const model::SpaceConnection climb =
      model::connect({{800, 0, -80}, 0}, {{1160, 60, -120}, 0.3}, {15, 60, wind},
                     {2.5, 2.5, climb_acceleration});
  exchange::Document document;
  document.plans = {{"climb", "", model::starting_at(climb.plan, 90)}};
  document.frame = geo::LocalFrame::at({36.989, -122.0514, 0}).value();
  document.has_altitude = true;
  const std::string file = testing::TempDir() + "skein-climb.geojson";
  std::ofstream(file)
      << exchange::to_text(document, exchange::Format::kGeojson, {}).value();
  const FlightLog log = fly_task(kPlants[2], "plan no-any_time file " + file, 130);
  EXPECT_TRUE(says(log, EventKind::kTaskDone)) << log.story();
  const FlightPlan& plan = document.plans.front().plan;
  double worst = 0;
  for (const FlightRow& row : log.rows.at(1)) {
    const double t = row.nav.time.seconds();
    if (t < 90 || t > model::end_time_of(plan)) continue;
    const double off = row.nav.p_N.z() - model::moment_at(plan, t).p_N.z();
    worst = std::max(worst, std::abs(off));
  }
  return worst;
}

TEST(AnyTask, APlanWithVerticalTurnsIsFollowedMoreClosely) {
  const double at_once = worst_height(0), by_turns = worst_height(1);
  EXPECT_GT(at_once, 0.6);
  EXPECT_LT(by_turns, 0.7 * at_once);
}

TEST(AnyTask, ReturnStaysAboveHomeAndLandStands) {
  for (const char* plant : kPlants) {
    SCOPED_TRACE(plant);
    const FlightLog home = fly_task(plant, "fly_to 600,300", 300,
                                    "  - {at_s: 110, do: \"task a-1 return\"}\n");
    EXPECT_LT(nearest(home, {600, 300}, 30, 110), 30) << home.story();
    for (const FlightRow& row : home.rows.at(1))
      if (row.time.seconds() > 240) {
        EXPECT_LT(geo::horizontal(row.truth.p_N).norm(), 250) << home.story();
      }
  }
  for (const char* plant : {kPlants[1], kPlants[2]}) {
    SCOPED_TRACE(plant);
    const FlightLog down = fly_task(plant, "land -100,100", 300,
                                    "  - {at_s: 270, do: \"task a-1 fly_to 300,0\"}\n");
    EXPECT_TRUE(says(down, EventKind::kLanded)) << down.story();
    EXPECT_TRUE(says(down, EventKind::kTaskDone)) << down.story();
    EXPECT_TRUE(says(down, EventKind::kTookOff)) << "for the next task" << down.story();
  }
}

TEST(AnyTask, IsPausedResumedCancelledAndHandedOver) {
  for (const char* plant : kPlants) {
    SCOPED_TRACE(plant);
    const FlightLog log = fly_task(
        plant, "survey 100,100 500,100 500,500 100,500 swath 100 overlap 0.1", 1100,
        "  - {at_s: 100, do: \"task a-1 pause\"}\n"
        "  - {at_s: 160, do: \"task a-1 resume\"}\n");
    EXPECT_TRUE(says(log, EventKind::kTaskPaused)) << log.story();
    EXPECT_TRUE(says(log, EventKind::kTaskResumed));
    EXPECT_TRUE(says(log, EventKind::kTaskDone)) << log.story();
    for (double north = 105; north < 500; north += 10)
      for (double east = 105; east < 500; east += 10)
        ASSERT_LT(nearest(log, {north, east}, 30, 1100), 51) << north << " " << east;
  }
}

// Of the flight between two times: above the flat ground, and through the air.
double mean_height(const FlightLog& log, double from, double until) {
  double sum = 0, count = 0;
  for (const FlightRow& row : log.rows.at(1))
    if (row.time.seconds() >= from && row.time.seconds() <= until) {
      sum -= row.truth.p_N.z();
      ++count;
    }
  return sum / count;
}
// What an aircraft that hovers is told is its speed over ground.
double mean_speed(const FlightLog& log, bool hovers, double from, double until) {
  const Vec2 wind = (hovers ? 0 : -4) * geo::unit(geo::radians(250));
  double sum = 0, count = 0;
  for (const FlightRow& row : log.rows.at(1))
    if (row.time.seconds() >= from && row.time.seconds() <= until) {
      sum += (geo::horizontal(row.truth.v_N) - wind).norm();
      ++count;
    }
  return sum / count;
}

TEST(AnyTask, IsFlownHigherAndFasterWhenTheOperatorSaysSo) {
  for (const char* plant : kPlants) {
    const bool hovers = std::string_view(plant).find("multirotor") == 0;
    for (const char* task :
         {"survey 100,100 500,100 500,500 100,500 swath 100 overlap 0.1",
          "fly_to 5000,3000 altitude_msl 90", "patrol -600,0 600,0 0,700 closed",
          "course 60"}) {
      SCOPED_TRACE(fmt::format("{} {}", plant, task));
      const double speed = hovers ? 9 : 17;
      const FlightLog log = fly_task(
          plant, task, 260,
          fmt::format("  - {{at_s: 120, do: \"flight a-1 height 140 speed {}\"}}\n",
                      speed));
      EXPECT_TRUE(says(log, EventKind::kFlightChanged)) << log.story();
      EXPECT_FALSE(says(log, EventKind::kTaskRefused)) << log.story();
      EXPECT_NEAR(mean_height(log, 90, 118), 85, 9) << log.story();
      EXPECT_NEAR(mean_height(log, 200, 260), 140, 9) << log.story();
      EXPECT_GT(std::abs(mean_speed(log, hovers, 90, 118) - speed), 0.8);
      EXPECT_NEAR(mean_speed(log, hovers, 200, 260), speed, 1) << log.story();
    }
  }
}

TEST(AnyTask, SpeedsThatAreNotFlownAreRefused) {
  const FlightLog log = fly_task(kPlants[2], "hold", 100,
                                 "  - {at_s: 50, do: \"flight a-1 speed 200\"}\n"
                                 "  - {at_s: 60, do: \"flight nobody height 30\"}\n");
  EXPECT_TRUE(says(log, EventKind::kFlightRefused)) << log.story();
  EXPECT_TRUE(says(log, EventKind::kCommandRefused)) << log.story();
  EXPECT_FALSE(says(log, EventKind::kFlightChanged)) << log.story();
}

TEST(AnyTask, ThatAnotherHasBegunIsFinishedNotRepeated) {
  const FlightLog log = fly(R"(
duration_s: 900
environment: {terrain: flat, phenomena: [], wind: {kind: uniform, speed_mps: 3, from_deg: 0}}
missions: []
aircraft:
  - {name: a, altitude_agl_m: 80, start: {placement: list, positions_m: [[0, 0]]}}
  - {name: b, altitude_agl_m: 80, start: {placement: list, positions_m: [[-300, 0]]}}
commands:
  - {at_s: 10, do: "task a-1 survey 100,100 900,100 900,900 100,900 swath 100 overlap 0.1"}
  - {at_s: 300, do: "task a-1 give b-1"}
)");
  double by_first = 0, by_both = 0, again = 0, cells = 0;
  const auto seen = [&](std::uint32_t who, const Vec2& p, double from, double until) {
    for (const FlightRow& row : log.rows.at(who))
      if (row.time.seconds() > from && row.time.seconds() < until &&
          (geo::horizontal(row.truth.p_N) - p).norm() < 51)
        return true;
    return false;
  };
  for (double north = 105; north < 900; north += 10)
    for (double east = 105; east < 900; east += 10) {
      const bool first = seen(1, {north, east}, 10, 300);
      const bool second = seen(2, {north, east}, 300, 900);
      ++cells;
      by_first += first;
      by_both += first || second;
      again += first && second;
    }
  EXPECT_EQ(by_both, cells) << log.story();
  EXPECT_GT(by_first / cells, 0.25);
  // Turns at the ends of lines reach over what has been seen.
  EXPECT_LT(again / by_first, 0.35);
}

TEST(AnyTask, ThatCannotBeFlownIsRefused) {
  const FlightLog log = fly(R"(
duration_s: 20
environment: {terrain: flat, phenomena: []}
missions: []
aircraft: [{name: a, agent: scout}]
commands:
  - {at_s: 5, do: '{"kind": "task", "aircraft": "a-1", "what": {"kind": "follow_leader", "leader_id": 1}}'}
)");
  ASSERT_NE(log.find(EventKind::kTaskRefused), nullptr) << log.story();
}

}  // namespace
}  // namespace skein::assemble::any_task_test
