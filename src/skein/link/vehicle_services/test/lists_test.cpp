// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "skein/link/vehicle_services/mission_items.h"
#include "skein/link/vehicle_services/test/station.h"

namespace skein::vehicle_services::lists_test {
namespace {

using mavlink::CommandId;
using mavlink::CoordinateFrame;
using mavlink::MissionResult;
using mavlink::MissionType;
using Kind = MissionItem::Kind;
using Item = mavlink::MissionItemInt;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct At {
  double north = 0, east = 0;
};

Item item(CommandId command, At at, float z,
          CoordinateFrame frame = CoordinateFrame::kGlobalRelativeInt,
          std::vector<float> p = {}) {
  p.resize(4);
  const geo::Geodetic place = test_frame().from_plane({at.north, at.east});
  Item made;
  made.command = static_cast<std::uint16_t>(command);
  made.frame = static_cast<std::uint8_t>(frame);
  made.x = degrees_e7(place.latitude_deg);
  made.y = degrees_e7(place.longitude_deg);
  made.z = z;
  made.param1 = p[0];
  made.param2 = p[1];
  made.param3 = p[2];
  made.param4 = p[3];
  return made;
}

Item without_place(CommandId command, std::vector<float> p = {}) {
  Item made = item(command, {}, 0, CoordinateFrame::kMission, std::move(p));
  made.x = made.y = 0;
  return made;
}

// The vehicle asks for each item, until it gives its verdict.
int upload(Station& s, std::vector<Item> items, MissionType type = MissionType::kMission,
           bool home_first = true) {
  if (home_first && type == MissionType::kMission)
    items.insert(items.begin(), Item());  // which nobody reads
  s.clear();
  mavlink::MissionCount count;
  count.target_system = 7;
  count.count = static_cast<std::uint16_t>(items.size());
  count.mission_type = static_cast<std::uint8_t>(type);
  s.send(count);
  for (std::size_t k = 0; k < items.size(); ++k) {
    const auto request = s.last<mavlink::MissionRequestInt>();
    EXPECT_EQ(request.seq, k);
    EXPECT_EQ(request.mission_type, count.mission_type);
    items[k].seq = static_cast<std::uint16_t>(k);
    items[k].target_system = 7;
    items[k].mission_type = count.mission_type;
    s.send(items[k]);
  }
  const auto ack = s.last<mavlink::MissionAck>();
  EXPECT_EQ(ack.mission_type, count.mission_type);
  EXPECT_EQ(ack.target_system, 255);
  return ack.type;
}

MissionUpload upload_and_take(Station& s, const std::vector<Item>& items) {
  EXPECT_EQ(upload(s, items), 0);
  return s.only_request<MissionUpload>();
}

TEST(Mission, IsReadItemByItem) {
  Station s;
  s.show(standing());
  using enum CommandId;
  using enum CoordinateFrame;
  const auto mission = upload_and_take(
      s, {item(kTakeOff, {300, 0}, 50), without_place(kChangeSpeed, {0, 18}),
          item(kWaypoint, {1000, 500}, 120, kGlobalRelative, {10}),
          item(kWaypoint, {1500, 500}, 600, kGlobalInt),
          item(kLoiterTime, {2000, 500}, 610, kGlobal, {45}),
          item(kLoiterTurns, {2000, 0}, 100, kGlobalRelative, {2, 0, 80}),
          without_place(kJump, {3, 5}), item(kLoiter, {0, 0}, 90), without_place(kReturn),
          item(kLand, {100, 200}, 0)});
  ASSERT_EQ(mission.items.size(), 10U);
  const auto kinds = {Kind::kTakeOff, Kind::kSpeed, Kind::kWaypoint, Kind::kWaypoint,
                      Kind::kHold,    Kind::kHold,  Kind::kJump,     Kind::kHold,
                      Kind::kReturn,  Kind::kLand};
  std::size_t k = 0;
  for (const Kind kind : kinds) EXPECT_EQ(mission.items[k++].kind, kind) << k;
  EXPECT_EQ(mission.items[0].p_N.z(), -450);
  EXPECT_EQ(mission.items[1].airspeed, 18);
  EXPECT_NEAR((mission.items[2].p_N - Vec3(1000, 500, -520)).norm(), 0, 0.02);
  EXPECT_EQ(mission.items[3].p_N.z(), -600);
  EXPECT_EQ(mission.items[4].hold, 45);
  EXPECT_NEAR(mission.items[5].hold, 2 * 2 * geo::kPi * 80 / 20, 1e-9);
  EXPECT_EQ(mission.items[6].to, 2) << "home is item 0";
  EXPECT_EQ(mission.items[6].repeats, 5);
  EXPECT_EQ(mission.items[7].hold, 0) << "for good";
  EXPECT_EQ(mission.items[9].p_N.z(), -400);
}

TEST(Mission, APlaceThatIsLeftOutIsThatOfTheItemBefore) {
  Station s;
  s.show(standing());
  Item take_off = item(CommandId::kTakeOff, {}, 50);
  take_off.x = take_off.y = 0;
  Item climb = item(CommandId::kWaypoint, {}, 90);
  climb.x = climb.y = 0x7fffffff;
  const auto mission =
      upload_and_take(s, {take_off, item(CommandId::kWaypoint, {900, 0}, 50), climb});
  EXPECT_EQ(mission.items[0].p_N, Vec3(100, 200, -450)) << "home";
  EXPECT_NEAR((mission.items[2].p_N - Vec3(900, 0, -490)).norm(), 0, 0.02);
}

TEST(Mission, MultirotorsWaitAtWaypoints) {
  Station s(Make::kPx4, true);
  s.show(standing());
  EXPECT_EQ(upload(s,
                   {item(CommandId::kWaypoint, {50, 0}, 20,
                         CoordinateFrame::kGlobalRelative, {7}),
                    without_place(CommandId::kJump, {0, -1})},
                   MissionType::kMission, false),
            0);
  const auto mission = s.only_request<MissionUpload>();
  EXPECT_EQ(mission.items[0].kind, Kind::kHold);
  EXPECT_EQ(mission.items[0].hold, 7);
  EXPECT_EQ(mission.items[1].to, 0);
  EXPECT_EQ(mission.items[1].repeats, 65'535);
}

TEST(Mission, WhatCannotBeFlownIsRefusedWithAReason) {
  struct Case {
    Item item;
    MissionResult result;
    const char* text;
  };
  Station s;
  s.show(standing());
  using enum CommandId;
  using enum CoordinateFrame;
  EXPECT_EQ(upload(s, {item(kWaypoint, {900, 0}, 50)}), 0);
  s.server.take_requests();
  Item far = item(kWaypoint, {0, 0}, 50);
  far.x = -far.x;
  for (const auto& [bad, result, text] : {
           Case{item(static_cast<CommandId>(206), {}, 0), MissionResult::kUnsupported,
                "Item 2: command 206 is not supported"},
           {item(kWaypoint, {}, 50, kGlobalTerrain), MissionResult::kUnsupportedFrame,
            "Item 2: its frame is not supported"},
           {item(kWaypoint, {}, kNan), MissionResult::kInvalidZ,
            "Item 2: its altitude is none"},
           {far, MissionResult::kInvalidX, "Item 2: its place is too far away"},
           {item(kTakeOff, {}, 0), MissionResult::kInvalidZ,
            "Item 2: it is not above home"},
           {without_place(kChangeSpeed, {0, 40}), MissionResult::kInvalidParam2,
            "Item 2: it does not fly at that speed"},
           {without_place(kChangeSpeed, {1, 20}), MissionResult::kInvalidParam1,
            "Item 2: only airspeeds are supported"},
           {without_place(kJump, {3, 1}), MissionResult::kInvalidParam1,
            "Item 2: it jumps to nowhere"},
           {without_place(kJump, {0, 1}), MissionResult::kInvalidParam1,
            "Item 2: it jumps to nowhere"},
       }) {
    EXPECT_EQ(upload(s, {item(kWaypoint, {500, 0}, 50), bad}), int(result)) << text;
    EXPECT_EQ(s.texts(), (std::vector<std::string>{text}));
    EXPECT_TRUE(s.server.take_requests().empty());
  }
  // The old one is still there.
  mavlink::MissionRequestInt request;
  request.target_system = 7;
  request.seq = 1;
  s.send(request);
  const auto kept = s.last<Item>();
  EXPECT_NEAR((test_frame().to_plane(kept.x * 1e-7, kept.y * 1e-7) - Vec2(900, 0)).norm(),
              0, 0.02);
}

TEST(Mission, BeginsWithHomeWhereTheMakeDoes) {
  Station s;
  s.show(standing());
  EXPECT_EQ(upload(s, {item(CommandId::kWaypoint, {900, 0}, 50)}), 0);
  mavlink::MissionRequestInt request;
  request.target_system = 7;
  s.send(request);
  const auto home = s.last<Item>();
  EXPECT_EQ(home.frame, 0);
  EXPECT_FLOAT_EQ(home.z, 400);
  EXPECT_NEAR(
      (test_frame().to_plane(home.x * 1e-7, home.y * 1e-7) - Vec2(100, 200)).norm(), 0,
      0.02);
}

TEST(Mission, ItsProgressIsReported) {
  for (const bool px4 : {false, true}) {
    const int first = px4 ? 0 : 1;
    Station s(px4 ? Make::kPx4 : Make::kArduPilot, false);
    VehicleSnapshot snapshot = flying();
    s.show(snapshot);
    EXPECT_EQ(s.last<mavlink::MissionCurrent>().mission_state, 1) << "none";
    EXPECT_EQ(s.last<mavlink::MissionCurrent>().total, 65'535);
    EXPECT_EQ(upload(s,
                     {item(CommandId::kWaypoint, {900, 0}, 50),
                      without_place(CommandId::kChangeSpeed, {0, 18}),
                      item(CommandId::kWaypoint, {900, 900}, 50)},
                     MissionType::kMission, !px4),
              0);
    s.step();
    EXPECT_EQ(s.last<mavlink::MissionCurrent>().mission_state, 2) << "not started";
    EXPECT_EQ(s.last<mavlink::MissionCurrent>().seq, first);
    EXPECT_EQ(s.last<mavlink::MissionCurrent>().total, 3);
    EXPECT_EQ(s.result(CommandId::kMissionStart), 0);
    auto requests = s.server.take_requests();
    EXPECT_EQ(std::get<MissionStart>(requests.back()).item, 0);
    snapshot.condition.mode = VehicleMode::kMission;
    s.show(snapshot);
    EXPECT_EQ(s.last<mavlink::MissionCurrent>().mission_state, 3) << "active";
    s.clear();
    for (const std::uint16_t current :
         std::initializer_list<std::uint16_t>{0, 0, 1, 2, 2}) {
      snapshot.progress.current = current;
      s.show(snapshot);
    }
    ASSERT_EQ(s.heard<mavlink::MissionItemReached>().size(), 1U) << "a speed is no place";
    EXPECT_EQ(s.last<mavlink::MissionItemReached>().seq, first);
    EXPECT_EQ(s.last<mavlink::MissionCurrent>().seq, first + 2);
    snapshot.progress.finished = true;
    s.show(snapshot);
    EXPECT_EQ(s.last<mavlink::MissionItemReached>().seq, first + 2);
    EXPECT_EQ(s.last<mavlink::MissionCurrent>().mission_state, 5) << "complete";
    s.clear();
    s.run(10);
    EXPECT_NEAR(static_cast<double>(s.heard<mavlink::MissionCurrent>().size()), 10, 1);
    EXPECT_TRUE(s.heard<mavlink::MissionItemReached>().empty()) << "once";
  }
}

TEST(Mission, AnItemIsMadeThePresentOne) {
  Station s;
  VehicleSnapshot snapshot = flying();
  s.show(snapshot);
  std::vector<Item> items;
  for (int k = 0; k < 5; ++k)
    items.push_back(item(CommandId::kWaypoint, {100. * k, 0}, 50));
  EXPECT_EQ(upload(s, items), 0);
  s.server.take_requests();
  // Not flown: it begins there later.
  EXPECT_EQ(s.result(CommandId::kSetMissionCurrent, {3}), 0);
  EXPECT_TRUE(s.server.take_requests().empty());
  s.step();
  EXPECT_EQ(s.last<mavlink::MissionCurrent>().seq, 3);
  EXPECT_EQ(s.result(CommandId::kSetMode, {1, 10}), 0);
  EXPECT_EQ(s.only_request<MissionStart>().item, 2);
  snapshot.condition.mode = VehicleMode::kMission;
  snapshot.progress.current = 2;
  s.show(snapshot);
  // Flown: it goes there at once, and no item is reached by that.
  s.clear();
  mavlink::MissionSetCurrent message;
  message.target_system = 7;
  message.seq = 5;
  s.send(message);
  EXPECT_EQ(s.only_request<MissionStart>().item, 4);
  EXPECT_EQ(s.last<mavlink::MissionCurrent>().seq, 5);
  snapshot.progress.current = 4;
  s.show(snapshot);
  EXPECT_TRUE(s.heard<mavlink::MissionItemReached>().empty());
  for (const float none : {0.F, 6.F, -2.F, kNan})
    EXPECT_EQ(s.result(CommandId::kSetMissionCurrent, {none}),
              number(mavlink::CommandResult::kDenied))
        << none;
  EXPECT_EQ(s.result(CommandId::kSetMissionCurrent, {-1}), 0) << "as it is";
}

TEST(Mission, IsPausedAndContinued) {
  Station s;
  VehicleSnapshot snapshot = flying();
  snapshot.condition.mode = VehicleMode::kMission;
  s.show(snapshot);
  EXPECT_EQ(upload(s, {item(CommandId::kWaypoint, {900, 0}, 50)}), 0);
  s.server.take_requests();
  EXPECT_EQ(s.result(CommandId::kPauseContinue, {0}), 0);
  EXPECT_EQ(s.only_request<ModeRequest>().mode, VehicleMode::kHold);
  snapshot.condition.mode = VehicleMode::kHold;
  s.show(snapshot);
  EXPECT_EQ(s.result(CommandId::kPauseContinue, {0}),
            number(mavlink::CommandResult::kTemporarilyRejected));
  EXPECT_EQ(s.result(CommandId::kPauseContinue, {1}), 0);
  EXPECT_EQ(s.only_request<ModeRequest>().mode, VehicleMode::kMission);
}

Item corner(CommandId command, At at, float corners) {
  return item(command, at, 0, CoordinateFrame::kGlobal, {corners});
}

TEST(Fence, IsKeptAndGivenAsZones) {
  Station s;
  s.show(standing());
  using enum CommandId;
  const std::vector<Item> fence = {corner(kFenceInclusionVertex, {-1000, -1000}, 4),
                                   corner(kFenceInclusionVertex, {-1000, 1000}, 4),
                                   corner(kFenceInclusionVertex, {1000, 1000}, 4),
                                   corner(kFenceInclusionVertex, {1000, -1000}, 4),
                                   corner(kFenceExclusionCircle, {300, 300}, 80),
                                   corner(kFenceReturnPoint, {0, 0}, 0),
                                   corner(kFenceExclusionVertex, {0, 0}, 3),
                                   corner(kFenceExclusionVertex, {100, 0}, 3),
                                   corner(kFenceExclusionVertex, {0, 100}, 3),
                                   corner(kFenceInclusionCircle, {0, 0}, 500)};
  EXPECT_EQ(upload(s, fence, MissionType::kFence), 0);
  EXPECT_TRUE(s.server.take_requests().empty()) << "no mission";
  const Fence& kept = s.server.fence();
  ASSERT_EQ(kept.inclusion.size(), 2U);
  ASSERT_EQ(kept.exclusion.size(), 2U);
  EXPECT_TRUE(covers(kept.inclusion[0], {900, -900}));
  EXPECT_FALSE(covers(kept.inclusion[0], {1100, 0}));
  EXPECT_GT(geo::signed_area(std::get<geo::Ring>(kept.inclusion[0].area)), 0);
  EXPECT_TRUE(covers(kept.exclusion[0], {370, 300}));
  EXPECT_FALSE(covers(kept.exclusion[0], {390, 300}));
  EXPECT_TRUE(covers(kept.exclusion[1], {20, 20}));
  // It is switched on by the parameter or the command.
  EXPECT_FALSE(kept.enabled);
  const auto version = kept.version;
  EXPECT_EQ(s.result(kFenceEnable, {1}), 0);
  EXPECT_TRUE(kept.enabled);
  EXPECT_GT(kept.version, version);
  EXPECT_EQ(s.server.parameter("FENCE_ENABLE")->value, 1);
  s.run(2);
  EXPECT_NE(s.last<mavlink::SysStatus>().onboard_control_sensors_enabled &
                mavlink::sensor_bit::kGeofence,
            0U);
  // And given back as it came.
  mavlink::MissionRequestList list;
  list.target_system = 7;
  list.mission_type = 1;
  s.send(list);
  EXPECT_EQ(s.last<mavlink::MissionCount>().count, 10);
  EXPECT_EQ(s.last<mavlink::MissionCount>().mission_type, 1);
  mavlink::MissionRequestInt request;
  request.target_system = 7;
  request.mission_type = 1;
  request.seq = 4;
  s.send(request);
  EXPECT_EQ(s.last<Item>().command, 5004);
  EXPECT_EQ(s.last<Item>().param1, 80);
}

TEST(Fence, ThatIsNoneIsRefusedAndTheOldOneStays) {
  Station s;
  s.show(standing());
  using enum CommandId;
  EXPECT_EQ(upload(s, {corner(kFenceExclusionCircle, {0, 0}, 80)}, MissionType::kFence),
            0);
  const std::vector<std::vector<Item>> bad = {
      {corner(kFenceExclusionCircle, {0, 0}, 0)},
      {corner(kFenceExclusionCircle, {0, 0}, kNan)},
      {corner(kFenceInclusionVertex, {0, 0}, 3),
       corner(kFenceInclusionVertex, {100, 0}, 3)},
      {corner(kFenceInclusionVertex, {0, 0}, 2),
       corner(kFenceInclusionVertex, {100, 0}, 2)},
      {corner(kFenceInclusionVertex, {0, 0}, 3),
       corner(kFenceInclusionVertex, {100, 0}, 3),
       corner(kFenceExclusionVertex, {0, 100}, 3)},
      // Sides that cross.
      {corner(kFenceInclusionVertex, {0, 0}, 4),
       corner(kFenceInclusionVertex, {100, 100}, 4),
       corner(kFenceInclusionVertex, {100, 0}, 4),
       corner(kFenceInclusionVertex, {0, 100}, 4)},
      {item(kWaypoint, {0, 0}, 50)},
  };
  for (const auto& fence : bad) {
    EXPECT_NE(upload(s, fence, MissionType::kFence), 0);
    EXPECT_FALSE(s.texts().empty());
    EXPECT_EQ(s.server.fence().exclusion.size(), 1U);
  }
}

TEST(Rally, PointsAreKept) {
  Station s;
  s.show(standing());
  EXPECT_EQ(
      upload(s, {item(CommandId::kRallyPoint, {100, 100}, 60)}, MissionType::kRally), 0);
  EXPECT_NE(upload(s, {item(CommandId::kWaypoint, {100, 100}, 60)}, MissionType::kRally),
            0);
  mavlink::MissionRequestList list;
  list.target_system = 7;
  list.mission_type = 2;
  s.send(list);
  EXPECT_EQ(s.last<mavlink::MissionCount>().count, 1);
}

TEST(Lists, AreClearedAllAtOnceOrOneByOne) {
  Station s(Make::kPx4, false);
  s.show(standing());
  const auto fill = [&] {
    EXPECT_EQ(upload(s, {item(CommandId::kWaypoint, {900, 0}, 50)}, MissionType::kMission,
                     false),
              0);
    EXPECT_EQ(upload(s, {corner(CommandId::kFenceExclusionCircle, {0, 0}, 80)},
                     MissionType::kFence),
              0);
    s.server.take_requests();
  };
  const auto count = [&](std::uint8_t type) {
    mavlink::MissionRequestList list;
    list.target_system = 7;
    list.mission_type = type;
    s.send(list);
    return s.last<mavlink::MissionCount>().count;
  };
  const auto clear = [&](std::uint8_t type) {
    mavlink::MissionClearAll order;
    order.target_system = 7;
    order.mission_type = type;
    s.clear();
    s.send(order);
    EXPECT_EQ(s.heard<mavlink::MissionAck>().size(), 1U);
    EXPECT_EQ(s.last<mavlink::MissionAck>().mission_type, type);
    return s.last<mavlink::MissionAck>().type;
  };
  fill();
  EXPECT_EQ(clear(1), 0);
  EXPECT_EQ(count(0), 1);
  EXPECT_EQ(count(1), 0);
  EXPECT_TRUE(s.server.fence().exclusion.empty());
  fill();
  EXPECT_EQ(clear(255), 0);
  EXPECT_EQ(count(0), 0);
  EXPECT_EQ(count(1), 0);
  EXPECT_TRUE(s.only_request<MissionUpload>().items.empty());
  EXPECT_NE(clear(77), 0);
  mavlink::MissionWritePartialList partial;
  partial.target_system = 7;
  s.send(partial);
  EXPECT_EQ(s.last<mavlink::MissionAck>().type, int(MissionResult::kUnsupported));
}

TEST(Lists, AreTakenByOneStationAtATime) {
  Station s;
  s.show(standing());
  mavlink::MissionCount count;
  count.target_system = 7;
  count.count = 3;
  count.mission_type = 1;
  s.send(count);
  s.writer = mavlink::FrameWriter(254, 190);
  mavlink::MissionClearAll order;
  order.target_system = 7;
  order.mission_type = 255;
  s.send(order);
  EXPECT_EQ(s.last<mavlink::MissionAck>().type, int(MissionResult::kDenied));
  EXPECT_TRUE(s.server.take_requests().empty()) << "all or none";
}

}  // namespace
}  // namespace skein::vehicle_services::lists_test
