// Every aircraft flies every kind of task, whatever its scenario calls it.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "skein/assemble/test/whole_flight.h"

namespace skein::assemble {
namespace {

// Ordered by an operator, one after the other.
std::string scenario_of(const char* plant, const char* agent) {
  return fmt::format(R"(
seed: 5
duration_s: 760
environment: {{terrain: flat, fire: none, wind: {{kind: uniform, speed_mps: 4, from_deg: 130}}}}
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
      EXPECT_EQ(log.find("task-refused"), nullptr) << log.story();
      EXPECT_EQ(log.find("command-refused"), nullptr) << log.story();
      for (const char* kind : {"fly_to", "fly_route", "fly_tour", "follow_line",
                               "fly_course", "follow_edge", "loiter"})
        EXPECT_TRUE(std::any_of(
            log.events.begin(), log.events.end(),
            [&](const Event& e) { return e.kind == "task" && e.text.ends_with(kind); }))
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

TEST(AnyTask, ThatCannotBeFlownIsRefused) {
  const FlightLog log = fly(R"(
duration_s: 20
environment: {terrain: flat, fire: none}
missions: []
aircraft: [{name: a, agent: scout}]
commands:
  - {at_s: 5, do: '{"kind": "task", "aircraft": "a-1", "what": {"kind": "follow_leader", "leader_id": 1}}'}
)");
  ASSERT_NE(log.find("task-refused"), nullptr) << log.story();
}

}  // namespace
}  // namespace skein::assemble
