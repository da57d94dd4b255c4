// SPDX-License-Identifier: Apache-2.0
// An aircraft elsewhere, in a run: what it senses, and what it is sent of the world.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "skein/assemble/world/build.h"
#include "skein/assemble/world/run.h"
#include "skein/link/vehicle_links/test/stand_ins.h"
#include "skein/link/vehicle_links/vehicle_feed.h"
#include "skein/role/operator_console.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::mixed_flight_test {
namespace {

using vehicle_links::StandIns;

// One aircraft elsewhere, which stands still above a growing fire; two that are
// simulated.
std::string mixed_scenario(const std::string& feeds, double duration) {
  return fmt::format(R"(
duration_s: {}
environment:
  terrain: flat
  wind: {{kind: uniform, speed_mps: 0}}
  phenomena: [{{kind: front, rate_mps: 0.1, ignitions: [{{point_m: [0, 0], radius_m: 200}}]}}]
aircraft:
  - name: far
    vehicle: {{kind: mavlink, endpoint: "udpin:0", feeds: {}}}
    plant: {{kind: multirotor, aircraft: quad}}
    autopilot: skein
    sensors: [fire]
    start: {{placement: list, positions_m: [[0, 0]]}}
    altitude_agl_m: 100
    agent: {{kind: route, points_m: [[0, 0], [10, 0], [10, 10]]}}
  - {{name: near, count: 2, start: {{placement: list, positions_m: [[500, 0], [800, 0]]}}}}
)",
                     duration, feeds);
}

scenario::Scenario read(const std::string& text, const KindRegistry& kinds) {
  const auto read =
      scenario::read_scenario_text(text, "mixed", SKEIN_SOURCE_DIR, kinds.table());
  if (!read.ok()) throw std::runtime_error(read.report());
  return *read.scenario;
}

struct Silent final : OperatorConsole {
  void show(const RunProgress&) override {}
  bool stop_requested() const override { return false; }
};

struct Readings final : Recorder {
  void record(const Record& record) override {
    if (const auto* reading = std::get_if<FireReading>(&record)) all.push_back(*reading);
  }
  std::vector<FireReading> all;
};

// What was recorded of a link that is silent from 20 to 30 s.
std::vector<VehicleReportRecord> said(EntityId who) {
  std::vector<VehicleReportRecord> all;
  all.push_back({Time(), who, LinkChange{LinkChange::Kind::kUp, "heard"}});
  for (double t = 0; t < 40; t += 0.1) {
    if (t > 20 && t < 30) continue;
    const Time now = Time::from_seconds(t);
    VehicleMotion motion;
    motion.time = now;
    const double speed = t > 9 && t < 14 ? 15 : 0;
    motion.p_N = {230 - 15 * std::clamp(t - 9, 0.0, 5.0), 0, -100};
    motion.v_N = {-speed, 0, 0};
    VehicleCondition condition;
    condition.on_ground = false;
    condition.position = true;
    all.push_back({now, who, condition});
    all.push_back({now, who, motion});
  }
  return all;
}

TEST(MixedFlight, AFireSensorWorksWhileTheLinkIsGoodAndIsSilentWhenThePositionIsOld) {
  const KindRegistry kinds;
  const auto scenario = read(mixed_scenario("{}", 40), kinds);
  const EntityId far{1};
  auto built = build(scenario, kinds, said(far));
  ASSERT_TRUE(built.ok()) << built.error().text();
  Readings readings;
  simulation::Run run(built.value().world, built.value().options, readings);
  ASSERT_TRUE(run.run_to_end().ok());
  const auto count = [&](double from, double until, bool inside) {
    return std::count_if(
        readings.all.begin(), readings.all.end(), [&](const FireReading& r) {
          const double t = r.time.seconds();
          return r.aircraft == far && t >= from && t < until && r.inside == inside;
        });
  };
  EXPECT_GT(count(1, 9, false), 5);  // beside the fire
  EXPECT_EQ(count(1, 9, true), 0);
  EXPECT_GT(count(11.5, 20, true), 5);  // above it
  EXPECT_EQ(count(11.5, 20, false), 0);
  EXPECT_EQ(count(25.3, 30, true) + count(25.3, 30, false), 0);  // 5 s are allowed
  EXPECT_GT(count(30.2, 40, true), 5);
}

TEST(MixedFlight, PositionsAreThoseOfSimulatedAircraftOnly) {
  const KindRegistry kinds;
  for (const char* group : {"far", "elsewhere"}) {
    const auto scenario =
        read(mixed_scenario(fmt::format("{{gps: {{group: {}}}}}", group), 3), kinds);
    const auto built = build(scenario, kinds);
    ASSERT_FALSE(built.ok());
    const std::string why = built.error().text();
    EXPECT_NE(why.find("vehicle.feeds.gps.group"), std::string::npos) << why;
    EXPECT_NE(why.find(fmt::format("no simulated aircraft")), std::string::npos) << why;
  }
}

// Over sockets, in real time.
TEST(MixedFlight, AnAircraftElsewhereIsSentWhatItsScenarioAsksFor) {
  const KindRegistry kinds;
  const auto scenario =
      read(mixed_scenario(
               "{traffic: {rate_hz: 5}, obstacles: {rate_hz: 5}, gps: {group: near}}", 4),
           kinds);
  auto built = build(scenario, kinds);
  ASSERT_TRUE(built.ok()) << built.error().text();
  ASSERT_NE(built.value().feed, nullptr);
  const auto places = built.value().links->start();
  ASSERT_TRUE(places.ok());
  const auto frame = geo::LocalFrame::at(scenario.origin).value();
  StandIns far(frame, places.value().front());
  far.add(1, {0, 0});
  std::thread thread([&] { far.run(std::chrono::milliseconds(4500)); });
  built.value().options.speed = 1;
  Silent console;
  const auto done = run_linked(built.value(), nullptr, console);
  thread.join();
  ASSERT_TRUE(done.ok());
  EXPECT_GE(far.heard.size(), 16u);  // two aircraft, 5 times a second
  for (const StandIns::Heard& each : far.heard)
    EXPECT_TRUE(each.what.ICAO_address == vehicle_links::icao_address("near-1") ||
                each.what.ICAO_address == vehicle_links::icao_address("near-2"));
  EXPECT_GE(far.fixes, 8u);
  EXPECT_GE(far.obstacles, 5u);
}

}  // namespace
}  // namespace skein::assemble::mixed_flight_test
