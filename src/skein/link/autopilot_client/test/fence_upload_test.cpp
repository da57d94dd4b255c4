// SPDX-License-Identifier: Apache-2.0
// No-fly zones become the fence of a vehicle over good and bad lines.
#include <gtest/gtest.h>

#include "skein/base/math.h"
#include "skein/link/autopilot_client/autopilot_client.h"
#include "skein/link/vehicle_services/test/bad_line.h"
#include "skein/link/vehicle_services/test/station.h"

namespace skein::autopilot_client::fence_upload_test {
namespace {

using vehicle_services::BadLine;
using vehicle_services::Trouble;
using vehicle_services::VehicleServer;

// A client at one end, a vehicle that stores its fence at the other.
struct Pair {
  explicit Pair(const Trouble& trouble, unsigned seed = 1) : line(trouble, seed) {
    line.at_vehicle = [this](const mavlink::Frame& heard) {
      server.receive(heard, 1, clocks(), line.vehicle);
    };
    line.at_station = [this](const mavlink::Frame& heard) {
      client.receive(heard, 1, line.now, line.station);
    };
    server.open(1, clocks());
    client.open(1);
  }
  vehicle_services::Clocks clocks() const { return {line.now, line.now}; }

  void run(double seconds) {
    for (int k = 0; k < 100 * seconds; ++k) {
      line.step();
      if (k % 2 != 0) continue;
      vehicle_services::VehicleSnapshot snapshot = vehicle_services::flying();
      snapshot.motion.time = line.now;
      server.update(snapshot);
      server.step(clocks(), line.vehicle);
      client.step(line.now, line.station);
      for (VehicleReport& report : client.take_reports())
        if (const auto* answer = std::get_if<RequestAnswer>(&report))
          answers.push_back(*answer);
    }
  }
  void request(std::uint32_t number, std::vector<Zone> zones) {
    client.request(number, FenceUpload{std::move(zones)}, line.now, line.station);
  }

  geo::LocalFrame frame = vehicle_services::test_frame();
  VehicleServer server{
      vehicle_services::test_options(vehicle_services::Make::kArduPilot, true), frame};
  AutopilotClient client{{.system = 7, .hovers = true}, frame};
  BadLine line;
  std::vector<RequestAnswer> answers;
};

Zone hexagon(const Vec2& centre, double radius) {
  geo::Ring ring;
  for (int k = 0; k < 6; ++k)
    ring.push_back(centre + radius * geo::unit(k * geo::kPi / 3));
  return Zone{.area = made_positive(ring)};
}

TEST(FenceUpload, ZonesBecomeTheFenceOfTheVehicleOverBadLinesToo) {
  unsigned seed = 0;
  for (const Trouble& trouble : vehicle_services::troubles()) {
    Pair pair(trouble, ++seed);
    pair.run(20);
    ASSERT_TRUE(pair.client.up());
    const Zone polygon = hexagon({400, 0}, 50);
    const Zone circle{.area = Disc{{-300, 200}, 80}};
    // Repeated by whoever asks, as FenceKeeper does.
    for (std::uint32_t number = 5; number < 15; ++number) {
      pair.request(number, {polygon, circle});
      pair.run(40);
      ASSERT_FALSE(pair.answers.empty());
      EXPECT_EQ(pair.answers.back().number, number);
      if (pair.answers.back().outcome == RequestAnswer::Outcome::kAccepted) break;
    }
    EXPECT_EQ(pair.answers.back().outcome, RequestAnswer::Outcome::kAccepted);
    const auto& fence = pair.server.fence();
    ASSERT_EQ(fence.exclusion.size(), 2u);
    EXPECT_TRUE(fence.inclusion.empty());
    const auto& ring = std::get<geo::Ring>(fence.exclusion[0].area);
    ASSERT_EQ(ring.size(), 6u);
    for (std::size_t k = 0; k < 6; ++k)  // places have a resolution of a centimetre
      EXPECT_LT((ring[k] - std::get<geo::Ring>(polygon.area)[k]).norm(), 0.02);
    const auto& disc = std::get<Disc>(fence.exclusion[1].area);
    EXPECT_LT((disc.centre - Vec2(-300, 200)).norm(), 0.02);
    EXPECT_DOUBLE_EQ(disc.radius, 80);
    EXPECT_EQ(pair.client.feeds().fences, 1u);
  }
}

TEST(FenceUpload, ReplacesTheFenceAndClearsIt) {
  Pair pair({});
  pair.run(10);
  pair.request(1, {hexagon({400, 0}, 50), hexagon({0, 400}, 50)});
  pair.run(3);
  EXPECT_EQ(pair.server.fence().exclusion.size(), 2u);
  pair.request(2, {hexagon({0, 400}, 50)});
  pair.run(3);
  EXPECT_EQ(pair.server.fence().exclusion.size(), 1u);
  pair.request(3, {});
  pair.run(3);
  EXPECT_TRUE(pair.server.fence().exclusion.empty());
  ASSERT_EQ(pair.answers.size(), 3u);
  for (const RequestAnswer& answer : pair.answers)
    EXPECT_EQ(answer.outcome, RequestAnswer::Outcome::kAccepted) << answer.text;
}

TEST(FenceUpload, CommandsDoNotWaitForIt) {
  Pair pair({.delay = 0.3});
  pair.run(10);
  std::vector<Zone> zones;
  for (int k = 0; k < 10; ++k) zones.push_back(hexagon({400, 200.0 * k}, 50));
  pair.request(1, zones);
  pair.client.request(2, ArmRequest{false, false}, pair.line.now, pair.line.station);
  pair.run(3);  // 60 corners take 36 s
  ASSERT_EQ(pair.answers.size(), 1u);
  EXPECT_EQ(pair.answers[0].number, 2u);
  EXPECT_NE(pair.answers[0].outcome, RequestAnswer::Outcome::kNoAnswer);
  pair.run(60);
  EXPECT_EQ(pair.server.fence().exclusion.size(), 10u);
}

TEST(FenceUpload, WhatTheVehicleFindsWrongIsDenied) {
  Pair pair({});
  pair.run(10);
  pair.request(1, {Zone{.area = geo::Ring{{0, 0}, {100, 100}, {100, 0}, {0, 100}}}});
  pair.run(3);
  ASSERT_EQ(pair.answers.size(), 1u);
  EXPECT_EQ(pair.answers[0].outcome, RequestAnswer::Outcome::kDenied);
  EXPECT_NE(pair.answers[0].text.find("fence: refused"), std::string::npos);
  EXPECT_EQ(pair.client.feeds().fences_refused, 1u);
}

}  // namespace
}  // namespace skein::autopilot_client::fence_upload_test
