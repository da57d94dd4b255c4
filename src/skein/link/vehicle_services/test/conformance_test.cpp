// SPDX-License-Identifier: Apache-2.0
// A whole flight as ground stations command it, over lines from good to hardly usable.
#include <gtest/gtest.h>

#include <limits>

#include "skein/link/mavlink/flight_modes.h"
#include "skein/link/vehicle_services/mode_table.h"
#include "skein/link/vehicle_services/test/ground_station.h"

namespace skein::vehicle_services::conformance_test {
namespace {

using mavlink::CommandId;
using mavlink::CoordinateFrame;
using mavlink::MissionType;
using Item = GroundStation::Item;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Identity {
  Make make;
  bool hovers;
  bool px4() const { return make == Make::kPx4; }
};
constexpr Identity kIdentities[] = {{Make::kArduPilot, false},
                                    {Make::kArduPilot, true},
                                    {Make::kPx4, false},
                                    {Make::kPx4, true}};

Item waypoint(double north, double east, float height) {
  const geo::Geodetic place = test_frame().from_plane({north, east});
  Item item;
  item.command = 16;
  item.frame = static_cast<std::uint8_t>(CoordinateFrame::kGlobalRelativeInt);
  item.autocontinue = 1;
  item.x = degrees_e7(place.latitude_deg);
  item.y = degrees_e7(place.longitude_deg);
  item.z = height;
  return item;
}

std::vector<Item> mission_for(const Identity& identity) {
  std::vector<Item> items;
  if (!identity.px4()) items.emplace_back();  // home
  for (int k = 0; k < 12; ++k)
    items.push_back(waypoint(100 + 60 * k, 200 - 40 * k, 60.F + static_cast<float>(k)));
  return items;
}

std::vector<float> mode(const Identity& identity, VehicleMode mode) {
  const ModeRow& row = row_of(mode, identity.make, identity.hovers);
  if (!identity.px4()) return {1, static_cast<float>(row.number)};
  return {1, static_cast<float>(row.number >> 16 & 0xff),
          static_cast<float>(row.number >> 24)};
}

// What a ground station does after the first heartbeat.
void connect(GroundStation& g, const Identity& identity) {
  ASSERT_TRUE(g.wait(30, [&] { return g.counts[0] > 0; })) << "no heartbeat";
  const auto version = g.request<mavlink::AutopilotVersion>();
  ASSERT_TRUE(version);
  EXPECT_NE(version->uid, 0U);
  const auto first = g.request<mavlink::AvailableModes>(1);
  ASSERT_TRUE(first);
  for (float k = 2; k <= static_cast<float>(first->number_modes); ++k)
    EXPECT_TRUE(g.request<mavlink::AvailableModes>(k));
  EXPECT_EQ(g.command(CommandId::kRequestMessage, {397}), 3) << "no metadata";
  ASSERT_TRUE(g.load_parameters());
  const auto mission = g.download(MissionType::kMission);
  ASSERT_TRUE(mission);
  EXPECT_EQ(mission->size(), identity.px4() ? 0U : 1U);
  for (const MissionType type : {MissionType::kFence, MissionType::kRally}) {
    const auto list = g.download(type);
    ASSERT_TRUE(list);
    EXPECT_TRUE(list->empty());
  }
  ASSERT_TRUE(g.wait(30, [&] { return g.counts[33] > 0 && g.counts[1] > 0; }));
}

void load_up_and_down(GroundStation& g, const Identity& identity) {
  const auto items = mission_for(identity);
  ASSERT_EQ(g.upload(items, MissionType::kMission), 0);
  ASSERT_TRUE(g.wait(5, [&] { return g.paper.mission.size() == 12; }));
  EXPECT_EQ(g.paper.obeyed["upload"], 1);
  const auto back = g.download(MissionType::kMission);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->size(), items.size());
  for (std::size_t k = identity.px4() ? 0 : 1; k < items.size(); ++k) {
    EXPECT_EQ((*back)[k].x, items[k].x);
    EXPECT_EQ((*back)[k].z, items[k].z);
  }
  std::vector<Item> fence;
  for (const auto& [north, east] : {std::pair{-3e3, -3e3}, {-3e3, 3e3}, {3e3, 3e3}}) {
    fence.push_back(waypoint(north, east, 0));
    fence.back().command = 5001;
    fence.back().param1 = 3;
  }
  ASSERT_EQ(g.upload(fence, MissionType::kFence), 0);
  EXPECT_EQ(g.server.fence().inclusion.size(), 1U);
}

void take_off(GroundStation& g, const Identity& identity) {
  if (!identity.px4()) {
    ASSERT_EQ(g.command(CommandId::kSetMode, mode(identity, VehicleMode::kGuided)), 0);
  }
  g.paper.airspeed = 5;
  ASSERT_EQ(g.command(CommandId::kArm, {1}), 0);
  const float altitude = identity.px4() ? 460.F : 60.F;
  ASSERT_EQ(g.command(CommandId::kTakeOff, {0, 0, 0, kNan, kNan, kNan, altitude}), 0);
  EXPECT_EQ(g.paper.obeyed["arm"], 1);
  EXPECT_EQ(g.paper.obeyed["take-off"], 1);
  EXPECT_GE(g.paper.snapshot.motion.p_N.z(), -460);
  EXPECT_LE(g.paper.snapshot.motion.p_N.z(), -457);
  EXPECT_GE(g.progress.size(), 3U) << "it took 12 s";
  g.paper.airspeed = 20;
}

void go_places(GroundStation& g, const Identity& identity) {
  const Item there = waypoint(700, 500, 80);
  mavlink::CommandInt reposition;
  reposition.command = static_cast<std::uint16_t>(CommandId::kReposition);
  reposition.frame = there.frame;
  reposition.param1 = -1;
  reposition.param2 = 1;
  reposition.param4 = kNan;
  reposition.x = there.x;
  reposition.y = there.y;
  reposition.z = there.z;
  ASSERT_EQ(g.command(reposition), 0);
  const auto near = [&](const Vec3& p) {
    return [&g, p] { return (g.paper.snapshot.motion.p_N - p).norm() < 1; };
  };
  EXPECT_TRUE(g.wait(60, near({700, 500, -480})));
  EXPECT_EQ(g.paper.obeyed["fly-to"], 1);
  // A stream of setpoints, ten a second; PX4 wants it before the mode.
  const auto stream = [&](double seconds) {
    for (int k = 0; k < static_cast<int>(seconds * 10); ++k) {
      mavlink::SetPositionTargetLocalNed m;
      m.coordinate_frame = static_cast<std::uint8_t>(CoordinateFrame::kLocalNed);
      m.type_mask = 0x0fc0;
      m.x = 500;
      m.z = -90;  // from where home is
      m.vx = 10;
      g.send(m);
      g.wait(0.1, [] { return false; });
    }
  };
  if (identity.px4()) {
    for (int k = 0; k < 20 && g.last<mavlink::Heartbeat>().custom_mode != kPx4Offboard;
         ++k) {
      stream(1.5);
      // A single try: a stream that is not kept up ends.
      mavlink::CommandLong m;
      m.command = static_cast<std::uint16_t>(CommandId::kSetMode);
      m.param1 = 1;
      m.param2 = 6;
      g.send(m);
      stream(1.5);
    }
    ASSERT_EQ(g.last<mavlink::Heartbeat>().custom_mode, kPx4Offboard);
  }
  stream(30);
  EXPECT_TRUE(g.wait(1, near({600, 200, -490})));
  EXPECT_GT(g.paper.obeyed["track"], 100);
}

void fly_the_mission(GroundStation& g, const Identity&) {
  g.counts[46] = 0;
  ASSERT_EQ(g.command(CommandId::kMissionStart), 0);
  EXPECT_TRUE(g.wait(200, [&] {
    return g.counts[42] > 0 && g.last<mavlink::MissionCurrent>().mission_state == 5;
  }));
  EXPECT_EQ(g.paper.obeyed["start"], 1);
  EXPECT_LE(g.counts[46], 2 * 12) << "once each, but for frames that come twice";
  EXPECT_GE(g.counts[46], 4);
}

void come_home(GroundStation& g, const Identity& identity) {
  ASSERT_EQ(g.command(CommandId::kSetMode, mode(identity, VehicleMode::kReturn)), 0);
  EXPECT_TRUE(g.wait(200, [&] {
    const auto heartbeat = g.last<mavlink::Heartbeat>();
    return (heartbeat.base_mode & mavlink::kModeArmed) == 0 &&
           heartbeat.system_status == 3;
  }));
  EXPECT_TRUE(
      g.wait(20, [&] { return g.last<mavlink::ExtendedSysState>().landed_state == 1; }));
}

void fly(GroundStation& g, const Identity& identity) {
  for (const auto& part :
       {connect, load_up_and_down, take_off, go_places, fly_the_mission, come_home}) {
    part(g, identity);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Conformance, AGroundStationFliesEveryVehicleOverEveryLine) {
  for (const Identity& identity : kIdentities)
    for (const Trouble& trouble : troubles())
      for (unsigned seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(testing::Message()
                     << (identity.px4() ? "PX4" : "ArduPilot")
                     << (identity.hovers ? " multirotor" : " fixed wing") << ", loss "
                     << trouble.loss << ", delay " << trouble.delay << ", seed " << seed);
        GroundStation g(test_options(identity.make, identity.hovers), trouble, seed);
        fly(g, identity);
        if (trouble.loss == 0) {
          EXPECT_EQ(g.lost.lost(), 0U) << "its count runs on";
        }
        if (testing::Test::HasFailure()) return;
      }
}

TEST(Conformance, TheSameOverSignedLines) {
  constexpr std::int64_t kUnixNow = 1'767'225'600'000'000'000;
  for (Trouble trouble : troubles()) {
    SCOPED_TRACE(testing::Message()
                 << "loss " << trouble.loss << ", delay " << trouble.delay);
    trouble.jitter = 0;  // a frame that is overtaken does not count any more
    mavlink::LinkSecurity ours(mavlink::key_of("ours")), theirs(mavlink::key_of("ours"));
    for (mavlink::LinkSecurity* security : {&ours, &theirs}) {
      security->set_time(kUnixNow);
      security->secure(GroundStation::kLink, security == &ours ? 1 : 2);
    }
    const Identity identity{Make::kArduPilot, false};
    GroundStation g(test_options(identity.make, identity.hovers), trouble, 5, &ours,
                    &theirs);
    fly(g, identity);
    if (trouble.duplicates == 0) {
      EXPECT_EQ(ours.refused(), 0U);
    }
  }
}

TEST(Conformance, NothingUnsignedOrOfAnotherKeyCounts) {
  for (const bool has_key : {false, true}) {
    mavlink::LinkSecurity ours(mavlink::key_of("ours")),
        theirs(mavlink::key_of("another"));
    ours.set_time(1'767'225'600'000'000'000);
    theirs.set_time(1'767'225'600'000'000'000);
    ours.secure(GroundStation::kLink, 1);
    if (has_key) theirs.secure(GroundStation::kLink, 2);
    GroundStation g(test_options(Make::kArduPilot, false), {}, 5, &ours, nullptr);
    Outbox intruder(
        255, 190,
        [&](Channel, std::span<const std::byte> bytes) {
          mavlink::FrameParser().read(
              bytes, [&](const mavlink::Frame& frame) { g.line.at_vehicle(frame); });
        },
        &theirs);
    ASSERT_TRUE(g.wait(5, [&] { return g.counts[0] > 0; })) << "it can be seen";
    mavlink::CommandLong arm;
    arm.target_system = 7;
    arm.command = static_cast<std::uint16_t>(CommandId::kArm);
    arm.param1 = 1;
    intruder.send(GroundStation::kLink, arm);
    mavlink::MissionCount count;
    count.target_system = 7;
    count.count = 0;
    intruder.send(GroundStation::kLink, count);
    g.wait(2, [] { return false; });
    EXPECT_FALSE(g.paper.snapshot.condition.armed);
    EXPECT_EQ(g.counts[77] + g.counts[47], 0);
    EXPECT_GE(ours.refused(), 2U);
  }
}

TEST(Conformance, ARunThatStandsStillIsStillThere) {
  GroundStation g(test_options(Make::kArduPilot, true), {0.05, 0.02, 0.05, 0.05}, 1);
  ASSERT_TRUE(g.wait(10, [&] { return g.counts[33] > 0; }));
  g.paper.snapshot.paused = true;
  Time last = g.line.now;
  int beats = g.counts[0];
  Time longest;
  g.wait(60, [&] {
    if (g.counts[0] != beats) {
      longest = std::max(longest, g.line.now - last);
      last = g.line.now;
      beats = g.counts[0];
    }
    return false;
  });
  EXPECT_LT(longest.seconds(), 3.5) << "after which ground stations give it up";
}

}  // namespace
}  // namespace skein::vehicle_services::conformance_test
