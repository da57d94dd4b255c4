// SPDX-License-Identifier: Apache-2.0
// What aircraft see of the physical world, and what the server knows of it.
#include <gtest/gtest.h>

#include "skein/assemble/test/whole_flight.h"

namespace skein::assemble::memory_flight_test {
namespace {

// A physical and a virtual object beside the line north; aircraft of four kinds fly it
// one after the other, the physical ones in the middle. The physical object moves east.
const std::string kLine = R"(
duration_s: 90
seed: 3
environment:
  terrain: flat
  wind: {kind: uniform, speed_mps: 0}
  phenomena: []
  objects:
    - {name: real, physical: true, position_m: [600, -30], movement: {kind: even, velocity_mps: [0, 1]}}
    - {name: unreal, position_m: [500, 20]}
missions: []
aircraft:
)";

std::string group(const std::string& name, double north, const std::string& more,
                  int count = 1) {
  std::string positions;
  for (int k = 0; k < count; ++k)
    positions += (k == 0 ? "[" : ", [") + std::to_string(north - 0.1 * k) + ", 0]";
  return "  - name: " + name + "\n    count: " + std::to_string(count) +
         "\n    agent: {kind: route, points_m: [[4000, 0]]}\n"
         "    sensors: [gnss, air-data, {kind: camera, gimbal: true, detection: 1}]\n"
         "    start: {placement: list, positions_m: [" +
         positions + "], heading_deg: 0}\n" + more;
}

// Detections of an object by an entity.
std::vector<Detection> found(const FlightLog& log, std::uint32_t entity,
                             std::uint32_t object) {
  std::vector<Detection> all;
  for (const Detection& each : log.detections)
    if (each.aircraft.value == entity && each.object == object) all.push_back(each);
  return all;
}

TEST(MemoryFlight, EachClassSeesItsWorld) {
  const FlightLog log =
      fly(kLine + group("early", 400, "    observes: both\n") +
          group("scout", 0, "    physical: true\n") +
          group("joint", 0, "    physical: true\n    observes: both\n") +
          group("late", -800, "    observes: both\n") + group("pure", -800, ""));
  constexpr std::uint32_t kEarly = 1, kScout = 2, kJoint = 3, kLate = 4, kPure = 5;
  EXPECT_TRUE(found(log, kEarly, 0).empty()) << "nobody had seen it by then";
  EXPECT_FALSE(found(log, kEarly, 1).empty());
  EXPECT_FALSE(found(log, kScout, 0).empty());
  EXPECT_TRUE(found(log, kScout, 1).empty()) << "it is not there";
  EXPECT_FALSE(found(log, kJoint, 0).empty());
  EXPECT_FALSE(found(log, kJoint, 1).empty());
  EXPECT_TRUE(found(log, kPure, 0).empty());
  EXPECT_FALSE(found(log, kPure, 1).empty());

  // The late one sees it where it was last seen, not where it is by then.
  const Detection* last = nullptr;
  for (const Detection& each : log.detections)
    if (each.object == 0 &&
        (each.aircraft.value == kScout || each.aircraft.value == kJoint))
      if (!last || each.time >= last->time) last = &each;
  ASSERT_TRUE(last);
  const auto late = found(log, kLate, 0);
  ASSERT_FALSE(late.empty());
  for (const Detection& each : late) {
    EXPECT_LT((each.point - last->point).norm(), 5.5 * each.point_sd);
    const Vec2 truth(600, -30 + each.time.seconds());
    EXPECT_GT((each.point - truth).norm(), 20);
  }
  EXPECT_EQ(log.figure("aircraft_pure_real"), 1);
  EXPECT_EQ(log.figure("aircraft_real_mixed"), 1);
  EXPECT_EQ(log.figure("aircraft_simulated_mixed"), 2);
  EXPECT_EQ(log.figure("aircraft_pure_simulated"), 1);
  EXPECT_EQ(log.figure("memory_refused"), static_cast<double>(late.size()));
  EXPECT_EQ(
      log.figure("memory_observations") + log.figure("memory_late"),
      static_cast<double>(found(log, kScout, 0).size() + found(log, kJoint, 0).size()));
  int refusals = 0;
  for (const Event& each : log.events) refusals += each.kind == EventKind::kUpdateRefused;
  EXPECT_EQ(refusals, 1);
}

TEST(MemoryFlight, PhysicalObjectsNoticeNobodyVirtual) {
  const auto motions = [](const std::string& body) {
    return fly(R"(
duration_s: 60
environment:
  phenomena: []
  objects: [{name: hare, physical: true, position_m: [200, 0], movement: {kind: evading, notice_m: 400}}]
missions: []
aircraft:
)" + group("scout", 0, body))
        .motions;
  };
  const auto of_nobody = motions("    join_s: 60\n"), of_virtual = motions(""),
             of_physical = motions("    physical: true\n");
  ASSERT_EQ(of_virtual.size(), of_nobody.size());
  for (std::size_t k = 0; k < of_nobody.size(); ++k)
    EXPECT_EQ(of_virtual[k].position, of_nobody[k].position);
  const auto ends = [](const auto& all) { return all.back().at(Time::from_seconds(60)); };
  EXPECT_GT((ends(of_physical) - ends(of_nobody)).norm(), 20) << "it ran";
}

TEST(MemoryFlight, IsTheSameForAnyNumberOfThreads) {
  const std::string scenario = kLine + group("scout", 0, "    physical: true\n", 20) +
                               group("late", -500, "    observes: both\n", 20);
  const FlightLog one = fly(scenario), three = fly(scenario, {{}, 3});
  EXPECT_GT(one.figure("memory_observations"), 20);
  EXPECT_GT(one.figure("memory_refused"), 20);
  EXPECT_EQ(one.hash(), three.hash());
}

TEST(MemoryFlight, WithoutPhysicalObjectsThereIsNoMemory) {
  const FlightLog log =
      fly("duration_s: 20\nenvironment: {objects: [{position_m: [300, 0]}]}\n"
          "missions: []\naircraft:\n" +
          group("scout", 0, ""));
  EXPECT_TRUE(std::isnan(log.figure("physical_objects")));
  EXPECT_TRUE(std::isnan(log.figure("aircraft_pure_simulated")));
  EXPECT_FALSE(log.detections.empty());
}

}  // namespace
}  // namespace skein::assemble::memory_flight_test
