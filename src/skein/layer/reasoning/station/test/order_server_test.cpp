// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/station/order_server.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/station/ground_station.h"
#include "skein/layer/reasoning/station/nearest_allocator.h"

namespace skein::reasoning::order_server_test {
namespace {

constexpr EntityId kFirst{1}, kSecond{2};

// A mission that gives every aircraft one order, and again while it is not confirmed.
class Repeated final : public Mission {
 public:
  explicit Repeated(std::vector<AircraftReport>& reports) : reports_(reports) {}

  void step(const AgentInput& in, AgentOutput& out) override {
    reports_.clear();
    for (const Message& message : in.inbox)
      if (const auto* report = std::get_if<AircraftReport>(&message.content))
        reports_.push_back(*report);
    for (const EntityId id : {kFirst, kSecond})
      out.outbox.push_back({{}, id, 0, Time(), Task{number, FlyTo{{1000, 0}}}});
  }
  MissionDemand demand() const override { return {}; }
  std::uint32_t number = 1;

 private:
  std::vector<AircraftReport>& reports_;
};

// An aircraft keeps the task with the highest number.
struct Aircraft {
  Task task;
  void take(const Message& message) {
    const auto* order = std::get_if<Task>(&message.content);
    if (order && order->number > task.number) task = *order;
  }
  bool flies_to() const { return std::holds_alternative<FlyTo>(task.what); }
};

class Orders : public testing::Test {
 protected:
  Orders() {
    auto mission = std::make_unique<Repeated>(reports_);
    mission_ = mission.get();
    GroundStationOptions options;
    options.team = {{kFirst, "a", {}}, {kSecond, "b", {}}};
    std::vector<PlannedMission> missions(1);
    missions[0].name = "mission";
    missions[0].mission = std::move(mission);
    missions[0].candidates = {kFirst, kSecond};
    missions[0].start = Time();
    server_ = std::make_unique<GroundStation>(options, std::move(missions),
                                              std::make_unique<NearestAllocator>());
  }

  // One second: the aircraft report, the server acts, its orders arrive.
  void second(const std::vector<Command>& commands = {}, bool radio = true) {
    std::vector<Message> inbox;
    for (const EntityId id : {kFirst, kSecond}) {
      AircraftReport report;
      report.task_number = aircraft_[id.value - 1].task.number;
      if (now_ == Time()) report.limits = FlightLimits{.airspeed = 17};
      inbox.push_back({id, {}, 0, Time(), report});
    }
    AgentInput in;
    in.now = now_ += Time::from_seconds(1);
    in.inbox = inbox;
    in.commands = commands;
    AgentOutput out;
    server_->step(in, out);
    if (!radio) return;
    for (const Message& message : out.outbox)
      aircraft_[message.to.value - 1].take(message);
  }

  std::vector<AircraftReport> reports_;
  Repeated* mission_ = nullptr;
  std::unique_ptr<GroundStation> server_;
  Aircraft aircraft_[2];
  Time now_;
};

TEST_F(Orders, ATaskedAircraftIsTheOperatorsUntilTheMissionResumes) {
  second();
  second();
  EXPECT_EQ(reports_[0].task_number, 1u);
  EXPECT_TRUE(reports_[0].obeys);

  second({TaskCommand{"a", FlyCourse{1}}});
  second();
  EXPECT_TRUE(std::holds_alternative<FlyCourse>(aircraft_[0].task.what));
  EXPECT_TRUE(aircraft_[1].flies_to());
  EXPECT_FALSE(reports_[0].obeys);
  EXPECT_TRUE(reports_[1].obeys);
  mission_->number = 2;
  second();
  second();
  EXPECT_TRUE(std::holds_alternative<FlyCourse>(aircraft_[0].task.what));

  second({MissionCommand{MissionAction::kResume}});
  EXPECT_EQ(reports_[0].task_number, 0u) << "it works on none of the mission's orders";
  second();
  EXPECT_TRUE(aircraft_[0].flies_to());
  EXPECT_EQ(reports_[0].task_number, 2u);
  EXPECT_TRUE(reports_[0].obeys);
}

TEST_F(Orders, MissionsKnowLimitsThatWereSaidOnce) {
  for (int k = 0; k < 5; ++k) second();
  ASSERT_EQ(reports_.size(), 2u);
  for (const AircraftReport& each : reports_) {
    ASSERT_TRUE(each.limits);
    EXPECT_EQ(each.limits->airspeed, 17);
  }
}

TEST_F(Orders, APausedMissionCirclesAndGoesOnWithTheSameOrder) {
  second();
  second({MissionCommand{MissionAction::kPause}});
  for (const Aircraft& one : aircraft_)
    EXPECT_TRUE(std::holds_alternative<Loiter>(one.task.what));
  second();
  second({MissionCommand{MissionAction::kResume}});
  second();
  for (const Aircraft& one : aircraft_) EXPECT_TRUE(one.flies_to());
  second();
  EXPECT_EQ(reports_[0].task_number, 1u);
  EXPECT_EQ(reports_[1].task_number, 1u);
}

TEST_F(Orders, AnOrderThatIsLostIsSentAgain) {
  second();
  second({TaskCommand{"b", Loiter{{5, 5}}}}, false);
  for (int k = 0; k < 4; ++k) second();
  EXPECT_TRUE(std::holds_alternative<Loiter>(aircraft_[1].task.what));
}

TEST_F(Orders, OrdersOfBothHoldOverAndOver) {
  for (std::uint32_t round = 1; round < 20; ++round) {
    mission_->number = round;
    second({MissionCommand{MissionAction::kResume}});
    second();
    second();
    ASSERT_TRUE(aircraft_[0].flies_to()) << round;
    ASSERT_EQ(reports_[0].task_number, round);
    for (std::uint32_t k = 0; k < round % 4; ++k)
      second({TaskCommand{"a", FlyCourse{double(k)}}});
    if (round % 4 == 0) continue;
    ASSERT_TRUE(std::holds_alternative<FlyCourse>(aircraft_[0].task.what)) << round;
  }
}

// Followers are sent the positions of whom they follow, unless that does so itself.
TEST(OrderServer, PassesOnThePositionsOfThoseThatATaskIsAbout) {
  for (const bool direct : {false, true}) {
    OrderServer server({{kFirst, "a", {}}, {kSecond, "b", {}}}, 0, EntityId{0}, {});
    AgentOutput out;
    FlyRoute route{{{0, 0}, {100, 0}}, 1, {}};
    if (direct) route.report_to.push_back(kSecond);
    server.order(0, route, OrderServer::Holder::kOperator, Time(), out);
    server.order(1, FollowLeader{kFirst, {-30, 0}}, OrderServer::Holder::kOperator,
                 Time(), out);
    out = {};
    AircraftReport report;
    report.nav.p_N = {5, 6, -7};
    const std::vector<Message> inbox{{kFirst, {}, 0, Time(), report},
                                     {kSecond, {}, 0, Time(), AircraftReport()}};
    AgentInput in;
    in.inbox = inbox;
    server.listen(in, out);
    std::vector<TeamPosition> positions;
    for (const Message& message : out.outbox)
      if (const auto* position = std::get_if<TeamPosition>(&message.content)) {
        EXPECT_EQ(message.to, kSecond);
        positions.push_back(*position);
      }
    ASSERT_EQ(positions.size(), direct ? 0u : 1u);
    if (!direct) {
      EXPECT_EQ(positions[0].aircraft, kFirst);
      EXPECT_EQ(positions[0].nav.p_N, Vec3(5, 6, -7));
    }
  }
}

}  // namespace
}  // namespace skein::reasoning::order_server_test
