// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/foxglove/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace skein::hmi::foxglove::view_test {
namespace {

using Json = nlohmann::json;

constexpr EntityId kScout{1};

Facts facts() {
  return {"run", "session", 1'780'000'000,
          geo::LocalFrame::at({50.1, 14.4, 300}).value()};
}

LiveItem entity(EntityId id, const char* name, const char* kind) {
  return LiveRecord{EntityRecord{id, name, kind, {}}};
}

class FoxgloveView : public testing::Test {
 protected:
  FoxgloveView() {
    FleetFrame fleet;
    fleet.time = Time::from_seconds(12.5);
    VehicleView& scout = fleet.vehicles.emplace_back();
    scout.id = kScout;
    scout.north = 1000;
    scout.east = 200;
    scout.altitude_msl = 420;
    scout.heading_deg = 90;
    RunClock clock;
    clock.time = fleet.time;
    view.take({entity(EntityId{0}, "base", "station"),
               entity(kScout, "scout-1", "aircraft"), clock, fleet});
  }

  std::uint32_t channel(const std::string& topic) const {
    const auto& all = view.channels();
    const auto found = std::find_if(
        all.begin(), all.end(), [&](const Channel& each) { return each.topic == topic; });
    EXPECT_NE(found, all.end()) << topic;
    return found == all.end() ? 0 : found->id;
  }
  Json state(const std::string& topic) const {
    const auto said = view.state(channel(topic));
    EXPECT_TRUE(said) << topic;
    return said ? Json::parse(said->payload) : Json();
  }
  // What is on a map, where the channel says it in words.
  Json features(const std::string& topic) const {
    return Json::parse(state(topic)["geojson"].get<std::string>())["features"];
  }

  View view{facts()};
};

TEST_F(FoxgloveView, AircraftHaveChannelsOfTheirOwnAndStationsNone) {
  channel("/aircraft/scout-1/state");
  channel("/aircraft/scout-1/location");
  for (const Channel& each : view.channels())
    EXPECT_EQ(each.topic.find("base"), std::string::npos);
  const std::size_t first = view.take_new_channels().size();
  EXPECT_EQ(first, view.channels().size());
  view.take({entity(EntityId{2}, "scout-2", "aircraft")});
  EXPECT_EQ(view.take_new_channels().size(), 2u);
  view.take({entity(EntityId{2}, "scout-2", "aircraft")});
  EXPECT_TRUE(view.take_new_channels().empty());
}

TEST_F(FoxgloveView, AnAircraftThatFliesEastPointsAlongX) {
  const Json transform = state("/tf")["transforms"].at(0);
  EXPECT_EQ(transform["child_frame_id"], "scout-1");
  EXPECT_EQ(transform["translation"], Json({{"x", 200}, {"y", 1000}, {"z", 420}}));
  EXPECT_NEAR(std::abs(transform["rotation"]["w"].get<double>()), 1, 1e-12);
  EXPECT_EQ(transform["timestamp"],
            Json({{"sec", 1'780'000'012}, {"nsec", 500'000'000}}));
}

TEST_F(FoxgloveView, PlacesInDegreesAreThoseOfTheFrame) {
  const Json fix = state("/aircraft/scout-1/location");
  const Vec3 back = facts().frame->to_local({fix["latitude"].get<double>(),
                                             fix["longitude"].get<double>(),
                                             fix["altitude"].get<double>()});
  EXPECT_NEAR(back.x(), 1000, 0.01);
  EXPECT_NEAR(back.y(), 200, 0.01);
  EXPECT_NEAR(back.z(), -420, 0.01);
  EXPECT_EQ(state("/aircraft/scout-1/state")["altitude_msl_m"], 420);
}

TEST_F(FoxgloveView, BoundariesHaveTheirDeviationAndTheTruthOnlyWhereItIsKnown) {
  PerimeterRecord record;
  record.mission = "fire";
  BoundaryPoint point;
  point.sigma = 25;
  point.normal = Vec2(1, 0);
  for (const Vec2& p : {Vec2(0, 0), Vec2(100, 0), Vec2(0, 100)}) {
    point.position = p;
    if (record.belief.rings.empty()) record.belief.rings.emplace_back();
    record.belief.rings[0].push_back(point);
  }
  view.take({LiveRecord{record}});
  EXPECT_EQ(features("/perimeter/map").size(), 4u);  // a ring and its points
  EXPECT_EQ(features("/perimeter/map").at(1)["properties"]["sigma_m"], 25);
  EXPECT_EQ(state("/perimeter")["entities"].size(), 1u);
  record.truth = {{Vec2(0, 0), Vec2(50, 0), Vec2(0, 50)}};
  view.take({LiveRecord{record}});
  EXPECT_EQ(features("/perimeter/map").size(), 5u);
  EXPECT_EQ(state("/perimeter")["entities"].size(), 2u);
}

TEST_F(FoxgloveView, ZonesComeAndGoAndAreForgottenWithASnapshot) {
  ZoneRecord zone;
  zone.change.zone.name = "wood";
  zone.change.zone.area = Disc{Vec2(10, 20), 50};
  view.take({LiveRecord{zone}});
  EXPECT_EQ(features("/zones/map").size(), 1u);
  EXPECT_EQ(state("/zones")["entities"].at(0)["id"], "wood");
  zone.change.on = false;
  view.take({LiveRecord{zone}});
  EXPECT_EQ(features("/zones/map").size(), 0u);
  zone.change.on = true;
  view.take({LiveRecord{zone}, SnapshotMark{true}});
  EXPECT_EQ(features("/zones/map").size(), 0u);
  EXPECT_EQ(view.take_changed().count(channel("/zones")), 1u);
}

TEST_F(FoxgloveView, EventsAndMetricsAreSaidOnceEach) {
  view.take_happened();
  view.take(
      {LiveRecord{Event{Time::from_seconds(3), kScout, EventKind::kFailsafe, "battery"}},
       MetricSample{Time::from_seconds(4), "fire", {{"perf_m", 40.5}}}});
  const auto happened = view.take_happened();
  ASSERT_EQ(happened.size(), 2u);
  EXPECT_EQ(happened[0].channel, channel("/log"));
  const Json log = Json::parse(happened[0].payload);
  EXPECT_EQ(log["name"], "scout-1");
  EXPECT_EQ(log["message"], "failsafe: battery");
  EXPECT_EQ(log["level"], 3);  // a warning
  EXPECT_EQ(happened[1].time_ns, 1'780'000'004'000'000'000U);
  EXPECT_EQ(Json::parse(happened[1].payload)["values"]["perf_m"], 40.5);
  EXPECT_TRUE(view.take_happened().empty());
}

TEST_F(FoxgloveView, PathsLeadWhereTheAircraftExpectToFly) {
  FlightPathRecord record;
  record.id = kScout;
  record.value.points = {{0, 1, 2, 3}, {10, 100, 200, 300}};
  view.take({LiveRecord{record}});
  const Json line = state("/plans")["entities"].at(0)["lines"].at(0);
  EXPECT_EQ(line["points"].at(1), Json({{"x", 200}, {"y", 100}, {"z", 300}}));
}

}  // namespace
}  // namespace skein::hmi::foxglove::view_test
