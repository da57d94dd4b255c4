// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/run_view.h"

#include <gtest/gtest.h>

#include <vector>

namespace skein::simulation::run_view_test {
namespace {

class Count final : public Recorder {
 public:
  void record(const Record&) override { ++records; }
  Result<void> step_done(Time) override {
    return Error{ErrorCode::kUnavailable, "", "full", ""};
  }
  int records = 0;
};

Time at(double seconds) {
  return Time::from_seconds(seconds);
}

PerimeterRecord perimeter(double time, std::uint32_t who, const char* mission,
                          std::uint32_t phenomenon) {
  PerimeterRecord record;
  record.time = at(time);
  record.believer = EntityId{who};
  record.mission = mission;
  record.phenomenon = phenomenon;
  return record;
}

TrafficBeliefRecord track(double time, std::uint32_t who, std::uint32_t number) {
  TrafficBelief belief;
  belief.track = number;
  return {at(time), EntityId{who}, belief};
}

TEST(RunView, KeepsTheNewestBeliefOfEachSubject) {
  Count next;
  RunView view(next);
  view.record(perimeter(1, 0, "north", 0));
  view.record(perimeter(2, 0, "north", 0));
  view.record(perimeter(1, 0, "north", 1));
  view.record(perimeter(1, 0, "south", 0));
  view.record(perimeter(5, 3, "north", 0));
  const auto beliefs = view.perimeters(EntityId{0});
  ASSERT_EQ(beliefs.size(), 3u);
  EXPECT_EQ(beliefs[0].time, at(2));
  EXPECT_EQ(beliefs[1].phenomenon, 1u);
  EXPECT_EQ(beliefs[2].mission, "south");
  EXPECT_EQ(view.perimeters(EntityId{3}).size(), 1u);
  EXPECT_TRUE(view.perimeters(EntityId{1}).empty());

  ObjectBelief car;
  car.object = 4;
  car.mission = "track";
  view.record(ObjectBeliefRecord{at(1), EntityId{0}, car});
  view.record(ObjectBeliefRecord{at(3), EntityId{0}, car});
  ASSERT_EQ(view.objects(EntityId{0}).size(), 1u);
  EXPECT_EQ(view.objects(EntityId{0})[0].time, at(3));
  EXPECT_EQ(next.records, 7);
}

TEST(RunView, TracksAreThoseOfTheLastTimeOnly) {
  Count next;
  RunView view(next);
  view.record(track(1, 2, 7));
  view.record(track(1, 2, 8));
  EXPECT_EQ(view.traffic(EntityId{2}).size(), 2u);
  view.record(track(2, 2, 8));
  view.record(track(2, 5, 1));
  ASSERT_EQ(view.traffic(EntityId{2}).size(), 1u);
  EXPECT_EQ(view.traffic(EntityId{2})[0].value.track, 8u);
  EXPECT_TRUE(view.traffic(EntityId{0}).empty());
}

TEST(RunView, GivesEachEventOnceAndSaysWhatFails) {
  Count next;
  RunView view(next);
  view.record(Event{at(1), EntityId{0}, EventKind::kJoined, ""});
  view.record(Event{at(2), EntityId{0}, EventKind::kLeft, ""});
  ASSERT_EQ(view.take_events().size(), 2u);
  EXPECT_TRUE(view.take_events().empty());
  EXPECT_FALSE(view.step_done(at(2)).ok());
}

}  // namespace
}  // namespace skein::simulation::run_view_test
