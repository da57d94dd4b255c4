#include "skein/layer/reasoning/agent/operator_orders.h"

#include <gtest/gtest.h>

namespace skein::reasoning {
namespace {

constexpr EntityId kFirst{1}, kSecond{2};

// A mission that gives every aircraft one order, and again while it is not confirmed.
class Mission final : public Agent {
 public:
  explicit Mission(std::vector<AircraftReport>& reports) : reports_(reports) {}

  void step(const AgentInput& in, AgentOutput& out) override {
    reports_.clear();
    for (const Message& message : in.inbox)
      reports_.push_back(std::get<AircraftReport>(message.content));
    for (const EntityId id : {kFirst, kSecond})
      out.outbox.push_back({{}, id, 0, Time(), Task{number, FlyTo{{1000, 0}}}});
  }
  std::uint32_t number = 1;

 private:
  std::vector<AircraftReport>& reports_;
};

// An aircraft keeps the task with the highest number.
struct Aircraft {
  Task task;
  void take(const Message& message) {
    const Task& order = std::get<Task>(message.content);
    if (order.number > task.number) task = order;
  }
  bool flies_to() const { return std::holds_alternative<FlyTo>(task.what); }
};

class OperatorOrdersTest : public testing::Test {
 protected:
  OperatorOrdersTest() {
    auto mission = std::make_unique<Mission>(reports_);
    mission_ = mission.get();
    server_ = std::make_unique<OperatorOrders>(
        std::vector<NamedAircraft>{{kFirst, "a"}, {kSecond, "b"}}, std::move(mission));
  }

  // One second: the aircraft report, the server acts, its orders arrive.
  void second(const std::vector<Command>& commands = {}, bool radio = true) {
    std::vector<Message> inbox;
    for (const EntityId id : {kFirst, kSecond}) {
      AircraftReport report;
      report.task_number = aircraft_[id.value - 1].task.number;
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
  Mission* mission_ = nullptr;
  std::unique_ptr<OperatorOrders> server_;
  Aircraft aircraft_[2];
  Time now_;
};

TEST_F(OperatorOrdersTest, ATaskedAircraftIsTheOperatorsUntilTheMissionResumes) {
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

  second({MissionCommand{false}});
  EXPECT_EQ(reports_[0].task_number, 0u) << "it works on none of the mission's orders";
  second();
  EXPECT_TRUE(aircraft_[0].flies_to());
  EXPECT_EQ(reports_[0].task_number, 2u);
  EXPECT_TRUE(reports_[0].obeys);
}

TEST_F(OperatorOrdersTest, APausedMissionCirclesAndGoesOnWithTheSameOrder) {
  second();
  second({MissionCommand{true}});
  for (const Aircraft& one : aircraft_)
    EXPECT_TRUE(std::holds_alternative<Loiter>(one.task.what));
  second();
  second({MissionCommand{false}});
  second();
  for (const Aircraft& one : aircraft_) EXPECT_TRUE(one.flies_to());
  second();
  EXPECT_EQ(reports_[0].task_number, 1u);
  EXPECT_EQ(reports_[1].task_number, 1u);
}

TEST_F(OperatorOrdersTest, AnOrderThatIsLostIsSentAgain) {
  second();
  second({TaskCommand{"b", Loiter{{5, 5}}}}, false);
  for (int k = 0; k < 4; ++k) second();
  EXPECT_TRUE(std::holds_alternative<Loiter>(aircraft_[1].task.what));
}

TEST_F(OperatorOrdersTest, OrdersOfBothHoldOverAndOver) {
  for (std::uint32_t round = 1; round < 20; ++round) {
    mission_->number = round;
    second({MissionCommand{false}});
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

}  // namespace
}  // namespace skein::reasoning
