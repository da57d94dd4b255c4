// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/server_memory.h"

#include <gtest/gtest.h>

namespace skein::mixed::server_memory_test {
namespace {

constexpr EntityId kReal{1}, kMixed{2}, kPure{3};
constexpr std::uint32_t kWalker = 4, kMast = 7;

class Plain : public Terrain {
 public:
  double elevation_msl(const Vec2&) const override { return 30; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

// A walker and a mast; a real aircraft, and two simulated ones.
class ServerMemoryTest : public testing::Test {
 protected:
  explicit ServerMemoryTest(const ServerMemoryOptions& options = {})
      : memory(options,
               {{{kWalker, "walker", ObjectClass::kPerson}, {kWalker, 0.5, 2}},
                {{kMast, "mast", ObjectClass::kStructure}, {kMast, 2, 40}}},
               {{"station", {}},
                {"real", entity_reality(Reality::kPhysical, Reality::kPhysical)},
                {"mixed", entity_reality(Reality::kVirtual, Reality::kBoth)},
                {"pure", entity_reality(Reality::kVirtual, Reality::kVirtual)}},
               std::make_shared<Plain>()) {}

  void see(double time, EntityId who, std::uint32_t object, const Vec2& where) {
    const Time now = Time::from_seconds(time);
    memory.begin_step(now);
    const Detection detection{now, who, 0, object, where, 1};
    memory.take_payload(now, who, {}, {&detection, 1});
    memory.take_news(observations, events);
  }
  // A picture of 100 m by 100 m in which nothing was found.
  void look(double time, EntityId who, const Vec2& middle) {
    const Time now = Time::from_seconds(time);
    memory.begin_step(now);
    Footprint picture{now, who, 0, {}};
    const Vec2 corners[] = {{50, -50}, {50, 50}, {-50, 50}, {-50, -50}};
    for (std::size_t k = 0; k < 4; ++k) picture.corners[k] = middle + corners[k];
    memory.take_payload(now, who, {&picture, 1}, {});
    memory.take_news(observations, events);
  }
  // North along the line of this east, over the mast's ground at 100 m north.
  void fly(double from, EntityId who, double east, double altitude) {
    for (int k = 0; k <= 20; ++k)
      memory.take_position(Time::from_seconds(from + k), who,
                           {10.0 * k, east, -altitude});
  }
  int count(EventKind kind) const {
    int n = 0;
    for (const Event& each : events) n += each.kind == kind;
    return n;
  }
  const Event& last(EventKind kind) const {
    for (auto each = events.rbegin(); each != events.rend(); ++each)
      if (each->kind == kind) return *each;
    throw std::runtime_error("no event " + std::string(row_of(kind).name));
  }

  ServerMemory memory;
  std::vector<ObservationRecord> observations;
  std::vector<Event> events;
};

TEST_F(ServerMemoryTest, ShowsWhatPhysicalSensorsHaveSeenAsTheySawIt) {
  EXPECT_TRUE(memory.remembered().empty());
  see(10, kReal, kWalker, {100, 0});
  ASSERT_EQ(memory.remembered().size(), 1u);
  EXPECT_EQ(memory.remembered()[0].id, kWalker);
  EXPECT_EQ(memory.remembered()[0].position, Vec2(100, 0));
  EXPECT_TRUE(events.empty());
}

TEST_F(ServerMemoryTest, AVirtualSensorRefreshesNothingAndIsReportedOnce) {
  see(10, kReal, kWalker, {100, 0});
  for (int k = 1; k <= 5; ++k) see(10 + k, kMixed, kWalker, {100.0 + k, 0});
  EXPECT_EQ(memory.remembered()[0].position, Vec2(100, 0));
  EXPECT_EQ(count(EventKind::kUpdateRefused), 1);
  EXPECT_EQ(last(EventKind::kUpdateRefused).entity, kMixed);
  int refused = 0;
  for (const ObservationRecord& each : observations)
    refused += each.fate == ObservationFate::kRefused;
  EXPECT_EQ(refused, 5);
  // Nor does it keep it young.
  see(611, kMixed, kWalker, {100, 0});
  EXPECT_TRUE(memory.remembered().empty());
  EXPECT_EQ(count(EventKind::kForgotten), 1);
}

TEST_F(ServerMemoryTest, VirtualObjectsAreNotItsBusiness) {
  see(10, kMixed, 99, {100, 0});
  see(10, kReal, 99, {100, 0});
  EXPECT_TRUE(memory.remembered().empty());
  EXPECT_TRUE(observations.empty());
  EXPECT_TRUE(events.empty());
}

TEST_F(ServerMemoryTest, RelianceOnWhatHasMovedIsNonActual) {
  see(10, kReal, kWalker, {100, 0});
  see(30, kMixed, kWalker, {101, 0});
  see(70, kReal, kWalker, {160, 0});
  ASSERT_EQ(count(EventKind::kNonActualObservation), 1);
  const Event& event = last(EventKind::kNonActualObservation);
  EXPECT_EQ(event.entity, kReal);
  EXPECT_EQ(event.text,
            "walker: remembered at 100 m north, 0 m east as of 10.0 s, is 60 m from "
            "there; relied on by mixed from 30.0 s on");
  EXPECT_EQ(memory.remembered()[0].position, Vec2(160, 0));
}

TEST_F(ServerMemoryTest, WithoutRelianceAMoveIsJustNews) {
  see(10, kReal, kWalker, {100, 0});
  see(70, kReal, kWalker, {160, 0});
  EXPECT_EQ(count(EventKind::kNonActualObservation), 0);
}

TEST_F(ServerMemoryTest, ASmallMoveIsNone) {
  see(10, kReal, kWalker, {100, 0});
  see(30, kMixed, kWalker, {101, 0});
  // 5 m and three deviations of two places of 1 m: 9.24 m.
  see(70, kReal, kWalker, {109, 0});
  EXPECT_EQ(count(EventKind::kNonActualObservation), 0);
}

TEST_F(ServerMemoryTest, ALookInVainAfterRelianceIsNonActual) {
  see(10, kReal, kWalker, {100, 0});
  look(20, kReal, {100, 300});
  look(21, kReal, {148.5, 0});
  EXPECT_EQ(count(EventKind::kNonActualObservation), 0);
  see(30, kMixed, kWalker, {101, 0});
  look(40, kMixed, {100, 0});
  EXPECT_EQ(count(EventKind::kNonActualObservation), 0) << "what is virtual cannot tell";
  look(50, kReal, {100, 0});
  ASSERT_EQ(count(EventKind::kNonActualObservation), 1);
  EXPECT_NE(last(EventKind::kNonActualObservation).text.find("is not found there"),
            std::string::npos);
  EXPECT_EQ(memory.remembered().size(), 1u) << "the temporal model keeps it";
}

class LogicalServerMemoryTest : public ServerMemoryTest {
 protected:
  LogicalServerMemoryTest() : ServerMemoryTest(logical()) {}
  static ServerMemoryOptions logical() {
    ServerMemoryOptions options;
    options.forgetting.model = ForgettingModel::kLogical;
    return options;
  }
};

TEST_F(LogicalServerMemoryTest, ForgetsWhatIsNotFoundWhereItWas) {
  see(10, kReal, kWalker, {100, 0});
  see(10, kReal, kMast, {100, 20});
  look(1000, kReal, {100, 0});
  ASSERT_EQ(memory.remembered().size(), 1u);
  EXPECT_EQ(memory.remembered()[0].id, kMast);
  EXPECT_EQ(observations.back().fate, ObservationFate::kNotFound);
  look(1001, kReal, {100, 0});
  look(1002, kReal, {100, 0});
  EXPECT_TRUE(memory.remembered().empty());
  EXPECT_EQ(count(EventKind::kForgotten), 2);
}

TEST_F(ServerMemoryTest, WhoeverWentThroughAnUnknownMastIsReported) {
  fly(0, kPure, 8, 50);
  fly(0, kMixed, 60, 50);
  fly(0, kReal, 0, 50);
  see(40, kReal, kMast, {100, 0});
  ASSERT_EQ(count(EventKind::kUnknownObjectInteraction), 1)
      << "the second was 58 m from it, and the real one met it in reality";
  const Event& event = last(EventKind::kUnknownObjectInteraction);
  EXPECT_EQ(event.entity, kPure);
  EXPECT_EQ(event.text,
            "passed mast at 10.0 s, 6.0 m from it (its place is known to 1.0 m); nobody "
            "knew of it until real saw it at 40.0 s");
}

TEST_F(ServerMemoryTest, WhatIsKnownIsNoLongerAnUnknownObject) {
  see(5, kReal, kMast, {100, 0});
  fly(10, kPure, 0, 50);
  see(40, kReal, kMast, {100, 0});
  EXPECT_EQ(count(EventKind::kUnknownObjectInteraction), 0);
}

TEST_F(ServerMemoryTest, WhatMovesSaysNothingAboutTheTimeBefore) {
  fly(0, kPure, 0, 31);
  see(40, kReal, kWalker, {100, 0});
  EXPECT_EQ(count(EventKind::kUnknownObjectInteraction), 0);
}

}  // namespace
}  // namespace skein::mixed::server_memory_test
