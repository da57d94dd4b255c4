// SPDX-License-Identifier: Apache-2.0
// What runs say of the flights ahead of their aircraft, and of why they have their tasks.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/world/run.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::flight_path_run_test {
namespace {

class Ahead final : public Recorder {
 public:
  void record(const Record& record) override {
    if (const auto* path = std::get_if<FlightPathRecord>(&record))
      paths[path->id].push_back(*path);
    else if (const auto* reason = std::get_if<TaskReasonRecord>(&record))
      reasons.push_back(*reason);
    else if (const auto* truth = std::get_if<TruthRecord>(&record))
      flown[truth->id].emplace_back(truth->time, geo::horizontal(truth->state.p_N));
  }
  Result<void> step_done(Time) override { return {}; }

  std::map<EntityId, std::vector<FlightPathRecord>> paths;
  std::map<EntityId, std::vector<std::pair<Time, Vec2>>> flown;
  std::vector<TaskReasonRecord> reasons;
};

Ahead run(const std::string& text) {
  auto read = scenario::read_scenario_text(text, "test", ".", kind_table());
  EXPECT_TRUE(read.scenario) << text;
  Ahead ahead;
  QuietRun how;
  how.listener = &ahead;
  const auto summary = run_quietly(*read.scenario, KindRegistry(), how);
  EXPECT_TRUE(summary) << summary.error().text();
  return ahead;
}

double distance(const Vec2& p, const FlightPath& path) {
  double least = 1e9;
  for (std::size_t k = 0; k < path.points.size(); ++k) {
    const auto at = [&](std::size_t i) {
      return Vec2(path.points[i].north, path.points[i].east);
    };
    const Vec2 a = at(k), leg = at(std::min(k + 1, path.points.size() - 1)) - a;
    const double share =
        std::clamp((p - a).dot(leg) / std::max(leg.squaredNorm(), 1e-9), 0.0, 1.0);
    least = std::min(least, (p - a - share * leg).norm());
  }
  return least;
}

// What share of a flight is further than 80 m off the path that was said last: turns
// between legs are not part of paths.
double share_off(const Ahead& ahead, EntityId aircraft) {
  double off = 0, all = 0;
  const auto& paths = ahead.paths.at(aircraft);
  for (const auto& [time, place] : ahead.flown.at(aircraft)) {
    const auto next =
        std::find_if(paths.begin(), paths.end(),
                     [time = time](const auto& each) { return each.time > time; });
    if (next == paths.begin()) continue;
    off += distance(place, std::prev(next)->value) > 80;
    ++all;
  }
  return off / all;
}

TEST(FlightPaths, AreWhereAircraftOfAllKindsFly) {
  const char* plants[] = {"kinematic",
                          "multirotor\n    autopilot: skein\n    sensors: [flight, fire]",
                          "{kind: fixed-wing, aircraft: bixler}\n    autopilot: skein\n"
                          "    sensors: [flight, fire]"};
  int from_deg = 20;
  for (const char* plant : plants) {
    SCOPED_TRACE(plant);
    const Ahead ahead = run(fmt::format(R"(
seed: 3
duration_s: 800
environment: {{terrain: flat, phenomena: [], wind: {{kind: uniform, speed_mps: 4, from_deg: {}}}}}
missions: []
aircraft:
  - name: a
    plant: {}
    altitude_agl_m: 80
    start: {{placement: list, positions_m: [[0, 0]], heading_deg: 90}}
commands:
  - {{at_s: 20, do: "task a-1 fly_to 900,300"}}
  - {{at_s: 40, do: "zone on wood circle 500,150 120"}}
  - {{at_s: 150, do: "task a-1 survey 100,100 500,100 500,500 100,500 swath 100"}}
  - {{at_s: 400, do: "task a-1 patrol -300,0 -300,-300 0,-300 closed"}}
  - {{at_s: 550, do: "task a-1 course 45"}}
  - {{at_s: 620, do: "task a-1 hold"}}
  - {{at_s: 700, do: "task a-1 route -100,0 -300,0 laps 1"}}
)",
                                        from_deg, plant));
    from_deg += 130;
    const EntityId aircraft{1};
    ASSERT_GT(ahead.paths.at(aircraft).size(), 7u);
    EXPECT_LT(share_off(ahead, aircraft), 0.05);
    for (const FlightPathRecord& each : ahead.paths.at(aircraft)) {
      ASSERT_FALSE(each.value.points.empty());
      EXPECT_TRUE(std::is_sorted(
          each.value.points.begin(), each.value.points.end(),
          [](const PathPoint& a, const PathPoint& b) { return a.ahead < b.ahead; }));
    }
  }
}

TEST(TaskReasons, ArePartOfWhatEachStrategyOrders) {
  for (const char* strategy :
       {"gus", "gus-rate", "ellipse", "tracking", "partition", "sweep"}) {
    SCOPED_TRACE(strategy);
    const Ahead ahead = run(fmt::format(R"(
seed: 4
duration_s: 700
aircraft: [{{name: scout, count: 2}}]
missions: [{{kind: perimeter, name: fire, strategy: {}}}]
)",
                                        strategy));
    ASSERT_FALSE(ahead.reasons.empty());
    for (const TaskReasonRecord& each : ahead.reasons) {
      EXPECT_EQ(each.id, EntityId{0});  // the station
      EXPECT_TRUE(each.value.aircraft == EntityId{1} ||
                  each.value.aircraft == EntityId{2});
      ASSERT_FALSE(each.value.terms.empty());
      for (const NamedValue& term : each.value.terms)
        EXPECT_TRUE(std::isfinite(term.value)) << term.name;
    }
  }
}

}  // namespace
}  // namespace skein::assemble::flight_path_run_test
