// SPDX-License-Identifier: Apache-2.0
// Several aircraft at once: the same bytes whatever the threads and the speed, and
// followers that keep their places.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "skein/assemble/test/whole_flight.h"

namespace skein::assemble::formation_flight_test {
namespace {

// Forty aircraft of three kinds, with all sensors, gusts, errors of their parameters and
// parts that fail by chance: enough for threads to share the work.
std::string crowd() {
  const auto group = [](const char* name, const char* plant, int bearing) {
    return fmt::format(R"(
  - name: {}
    count: 14
    plant: {}
    parameter_spread: 0.1
    autopilot: skein
    sensors: [flight]
    agent: route
    start: {{placement: ring, distance_m: 400, first_bearing_deg: {}}}
    random_failures:
      - {{kind: link, mean_between_s: 30, length_s: 10}}
      - {{kind: sensor, part: gnss-receiver, mean_between_s: 40, length_s: 5}}
      - {{kind: motor, mean_between_s: 100}})",
                       name, plant, bearing);
  };
  return "seed: 7\nduration_s: 40\nenvironment:\n"
         "  wind: {kind: uniform, speed_mps: 4, from_deg: 200}\n"
         "  turbulence: {kind: dryden, intensity: severe}\n"
         "  phenomena: []\nmissions: []\naircraft:" +
         group("wing", "fixed-wing", 0) +
         group("glider", "{kind: fixed-wing, aircraft: bixler}", 9) +
         group("quad", "multirotor", 17) + "\n";
}

TEST(WholeFleet, GivesTheSameBytesWithAnyNumberOfThreadsAndOfStepsAtOnce) {
  const FlightLog one = fly(crowd());
  EXPECT_NE(one.find(EventKind::kFailure), nullptr);
  EXPECT_NE(one.find(EventKind::kFailsafe), nullptr);
  for (const int threads : {2, 4})
    EXPECT_EQ(fly(crowd(), {{}, threads}).hash(), one.hash()) << threads;
  EXPECT_EQ(fly(crowd(), {{}, 2, 7}).hash(), one.hash());
}

std::string file(const std::string& name) {
  std::ifstream in(SKEIN_SOURCE_DIR "/scenarios/" + name);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// Where a slot is, beside the true leader.
Vec2 slot_of(const FlightRow& leader, const Vec2& offset) {
  const Vec2 forward = geo::horizontal(leader.truth.v_N).normalized();
  return geo::horizontal(leader.truth.p_N) + offset.x() * forward +
         offset.y() * geo::turned_right(forward);
}

// Root mean square distance of a follower to its slot in a span of time [m].
double off_slot(const FlightLog& log, std::uint32_t leader, std::uint32_t follower,
                const Vec2& offset, double from, double until) {
  const auto& leads = log.rows.at(leader);
  const auto& follows = log.rows.at(follower);
  Spread off;
  for (std::size_t k = 0; k < leads.size(); ++k) {
    const double t = leads[k].time.seconds();
    if (t < from || t >= until) continue;
    const Vec2 slot = slot_of(leads[k], offset);
    off.add((geo::horizontal(follows[k].truth.p_N) - slot).norm());
  }
  return off.rms();
}

TEST(WholeFormation, FollowersKeepTheirSlotsAndTheLeaderIsSwapped) {
  const std::string station = file("formation.yaml");
  ASSERT_FALSE(station.empty());
  std::string direct = station;
  const std::string key = "direct: false";
  ASSERT_NE(direct.find(key), std::string::npos);
  direct.replace(direct.find(key), key.size(), "direct: true");
  const Vec2 left(-40, -30), right(-40, 30);
  for (const std::string& text : {station, direct}) {
    SCOPED_TRACE(text == direct ? "direct" : "through the station");
    const FlightLog log = fly(text);
    EXPECT_EQ(log.find(EventKind::kAccident), nullptr) << log.story();
    const double a = off_slot(log, 1, 2, left, 100, 300),
                 b = off_slot(log, 1, 3, right, 100, 300);
    const double c = off_slot(log, 2, 1, left, 400, 600),
                 d = off_slot(log, 2, 3, right, 400, 600);
    // On straights some metres; in each turn, where the slot outside is faster than the
    // aircraft may fly, it falls behind and catches up: measured 10 to 30 m, receivers of
    // 0.6 m and a position a second old included.
    for (const double off : {a, b, c, d}) EXPECT_LT(off, 35);
    // Plans that cannot be flown are exceptions: the leader in a gust of its own.
    const auto refused =
        std::count_if(log.events.begin(), log.events.end(),
                      [](const Event& e) { return e.kind == EventKind::kRefused; });
    EXPECT_LE(refused, 5) << log.story();
  }
}

}  // namespace
}  // namespace skein::assemble::formation_flight_test
