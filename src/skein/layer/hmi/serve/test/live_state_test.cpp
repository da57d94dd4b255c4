// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/live_state.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace skein::hmi::live_state_test {
namespace {

std::vector<Record> kept(const LiveState& state) {
  std::vector<Record> all;
  state.for_each([&all](const Record& record) { all.push_back(record); });
  return all;
}

template <class T>
std::vector<T> kept_of(const LiveState& state) {
  std::vector<T> all;
  for (const Record& record : kept(state))
    if (const auto* one = std::get_if<T>(&record)) all.push_back(*one);
  return all;
}

EntityRecord entity(std::uint32_t id, const char* kind) {
  EntityRecord record;
  record.id = EntityId{id};
  record.name = kind + std::to_string(id);
  record.kind = kind;
  return record;
}

EstimateRecord estimate(std::uint32_t id, double time, double north) {
  EstimateRecord record;
  record.id = EntityId{id};
  record.nav.time = Time::from_seconds(time);
  record.nav.p_N = Vec3(north, 2, -100);
  record.nav.heading = geo::radians(-90);
  return record;
}

ZoneRecord zone(const char* name, bool on) {
  ZoneRecord record;
  record.change.on = on;
  record.change.zone.name = name;
  return record;
}

TEST(LiveState, WhoComesLateIsToldHowEverythingIsNow) {
  LiveState state;
  state.take(entity(0, "station"));
  state.take(entity(1, "aircraft"));
  state.take(zone("a", true));
  state.take(zone("b", true));
  state.take(zone("a", false));
  for (int k = 0; k < 5; ++k) {
    PerimeterRecord perimeter;
    perimeter.time = Time::from_seconds(5 * k);
    perimeter.mission = "fire";
    state.take(perimeter);
  }
  EXPECT_EQ(kept_of<EntityRecord>(state).size(), 2U);
  const auto zones = kept_of<ZoneRecord>(state);
  ASSERT_EQ(zones.size(), 1U);
  EXPECT_EQ(zones[0].change.zone.name, "b");
  const auto perimeters = kept_of<PerimeterRecord>(state);
  ASSERT_EQ(perimeters.size(), 1U);
  EXPECT_EQ(perimeters[0].time, Time::from_seconds(20));
}

TEST(LiveState, EachHorizonOfAForecastIsKept) {
  LiveState state;
  for (int made = 0; made < 3; ++made)
    for (const double ahead : {600., 1800., 3600.}) {
      ForecastRecord record;
      record.forecast.made = Time::from_seconds(60 * made);
      record.forecast.boundary.time = Time::from_seconds(60 * made + ahead);
      record.forecast.mission = "fire";
      state.take(record);
    }
  const auto forecasts = kept_of<ForecastRecord>(state);
  ASSERT_EQ(forecasts.size(), 3U);
  for (const auto& each : forecasts)
    EXPECT_EQ(each.forecast.made, Time::from_seconds(120));
}

TEST(LiveState, DoesNotGrowWithTime) {
  LiveState state;
  for (int k = 0; k < 20000; ++k) {
    Event event;
    event.time = Time::from_seconds(k);
    event.kind = EventKind::kCrossing;
    state.take(event);
    state.take(estimate(1, k, k));
  }
  const auto events = kept_of<Event>(state);
  EXPECT_EQ(events.size(), 1000U);
  EXPECT_EQ(events.back().time, Time::from_seconds(19999));
  EXPECT_EQ(kept(state).size(), 1000U);
}

// Of whatever comes with a new number or name each time.
TEST(LiveState, KeepsTheSubjectsThatWereHeardOfLast) {
  LiveState state;
  const auto name = [](std::size_t k) { return "zone " + std::to_string(k); };
  state.take(zone("kept", true));
  constexpr std::size_t kCount = 3 * LiveState::kMaxSubjects / 2;
  for (std::size_t k = 0; k < kCount; ++k) {
    state.take(zone(name(k).c_str(), true));
    if (k % 1000 == 0) state.take(zone("kept", true));
    ASSERT_LE(state.size(), LiveState::kMaxSubjects);
  }
  std::set<std::string> names;
  for (const ZoneRecord& each : kept_of<ZoneRecord>(state))
    names.insert(each.change.zone.name);
  EXPECT_GE(names.size(), LiveState::kMaxSubjects / 2);
  EXPECT_TRUE(names.contains("kept"));
  EXPECT_FALSE(names.contains(name(0)));
  for (std::size_t k = 1; k < LiveState::kMaxSubjects / 2; ++k)
    EXPECT_TRUE(names.contains(name(kCount - k)));
  for (const std::string& each : names) state.take(zone(each.c_str(), false));
  EXPECT_EQ(state.size(), 0U);
}

TEST(LiveState, FrameHasWhatAircraftBelieveAndWhatStationsHaveHeard) {
  LiveState state;
  state.take(entity(0, "station"));
  state.take(entity(1, "aircraft"));
  TruthRecord truth;
  truth.time = Time::from_seconds(10);
  truth.id = EntityId{1};
  truth.state.p_N = Vec3(990, 0, -90);
  state.take(truth);
  state.take(estimate(1, 9.5, 1000));
  MessageRecord message;
  message.message.from = EntityId{1};
  message.message.to = EntityId{0};
  message.arrived = Time::from_seconds(8);
  AircraftReport report;
  report.task_number = 7;
  report.task_state = TaskState::kFlying;
  report.task_share = 0.25;
  message.message.content = report;
  state.take(message);
  message.lost = true;
  message.arrived = Time::from_seconds(9);
  state.take(message);
  const FleetFrame frame = state.fleet();
  ASSERT_EQ(frame.vehicles.size(), 1U);
  const VehicleView& view = frame.vehicles[0];
  EXPECT_EQ(view.north, 1000);
  EXPECT_EQ(view.altitude_msl, 100);
  EXPECT_FLOAT_EQ(view.heading_deg, 270);
  EXPECT_FLOAT_EQ(view.age, 0.5);
  EXPECT_EQ(view.heard, Time::from_seconds(8));
  EXPECT_EQ(view.task_number, 7U);
  EXPECT_EQ(view.task_state, TaskState::kFlying);
  ASSERT_EQ(state.truth().places.size(), 1U);
  EXPECT_EQ(state.truth().places[0].north, 990);
  EXPECT_TRUE(kept_of<MessageRecord>(state).empty());
}

TEST(LiveState, NewestOrderIsTheTaskOfAnAircraft) {
  LiveState state;
  for (std::uint32_t number = 1; number <= 3; ++number) {
    MessageRecord message;
    message.message.to = EntityId{1};
    message.message.content = Task{number, Loiter{}};
    state.take(message);
  }
  const auto orders = kept_of<MessageRecord>(state);
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(std::get<Task>(orders[0].message.content).number, 3U);
}

TEST(LiveState, TruthIsLeftOut) {
  PerimeterRecord perimeter;
  perimeter.truth = {{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}};
  perimeter.mission = "fire";
  const auto open = without_truth(perimeter);
  ASSERT_TRUE(open);
  EXPECT_TRUE(std::get<PerimeterRecord>(*open).truth.empty());
  EXPECT_EQ(std::get<PerimeterRecord>(*open).mission, "fire");
  EXPECT_FALSE(without_truth(ObjectMotion{}));
  EXPECT_FALSE(without_truth(TrafficMotion{}));
  EXPECT_TRUE(without_truth(Event{}));
}

}  // namespace
}  // namespace skein::hmi::live_state_test
