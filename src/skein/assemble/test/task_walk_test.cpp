// SPDX-License-Identifier: Apache-2.0
// An agent is given whatever comes: tasks, changes, zones, wind, failures.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include "skein/assemble/kinds/task_kinds.h"
#include "skein/base/random.h"
#include "skein/layer/reasoning/agent/onboard_agent.h"
#include "skein/layer/reasoning/trajectory/test/test_flight.h"
#include "skein/model/connection/connection.h"
#include "skein/solve/path/aa_star.h"

namespace skein::assemble::task_walk_test {
namespace {

using reasoning::FlightContext;
using reasoning::OnboardAgent;

constexpr EntityId kSelf{1}, kOther{2}, kStation{0};

class Walk {
 public:
  explicit Walk(std::uint64_t seed)
      : random_(seed, 0, Purpose::kTest, 0),
        agent_({}, kStation, context_, {},
               [kinds = task_kinds()](const TaskKind& task,
                                      const reasoning::FlightContext& context) {
                 TaskOptions options;
                 options.has_camera = true;
                 return kinds.make(task, {context, options});
               }) {}

  // Half a second.
  void step() {
    if (uniform() < 0.03) order();
    if (uniform() < 0.02) change();
    if (uniform() < 0.02)
      send(FlightChange{++flight_number_, 30 + 200 * uniform(), 12 + 16 * uniform()});
    if (uniform() < 0.01) zone();
    if (uniform() < 0.01) aircraft_.wind = 9 * uniform() * geo::unit(7 * uniform());
    if (uniform() < 0.005) refuses_ = !refuses_;
    if (uniform() < 0.02) others();
    think();
  }

  void think() {
    const NavEstimate nav = aircraft_.nav(now_);
    AgentInput in;
    in.now = now_;
    in.nav = &nav;
    in.autopilot = aircraft_.status;
    in.inbox = inbox_;
    in.command_fate = fate_;
    std::vector<SensorSample> samples;
    if (now_.ns() % Time::from_seconds(1).ns() == 0)
      samples.push_back(FireSample{now_, 0, aircraft_.position().norm() < 400});
    if (uniform() < 0.2) {
      const Vec2 to = Vec2(300 + now_.seconds() * 0.3, -200) - aircraft_.position();
      if (to.norm() < 150) samples.push_back(DetectionSample{now_, 0, to, 3});
    }
    in.samples = samples;
    AgentOutput out;
    agent_.step(in, out);
    inbox_.clear();
    for (const Event& event : out.events)
      last_ = std::string(event.kind.name()) + ": " + event.text;
    check(out);
    if (out.command) take(*out.command);
    for (int k = 0; k < 10; ++k) aircraft_.step(0.05);
    if (!aircraft_.p.allFinite()) ADD_FAILURE() << last_;
    now_ += Time::from_seconds(0.5);
  }

  // Without zones and with a willing autopilot it does what it is told.
  bool reaches(const Vec2& place) {
    refuses_ = false;
    aircraft_.wind = {2, 1};
    for (const std::string& name : zones_)
      send(ZoneChange{++zone_number_, false, named(name)});
    zones_.clear();
    send(FlightChange{++flight_number_, 120, 20});  // as the test's aircraft flies
    send(Task{++number_, FlyTo{place}});
    for (int k = 0; k < 1000; ++k) {
      think();
      if ((aircraft_.position() - place).norm() < 60) return true;
    }
    return false;
  }

  const std::string& last() const { return last_; }

 private:
  double uniform() { return random_.uniform(); }
  Vec2 place() { return {2400 * uniform() - 1200, 2400 * uniform() - 1200}; }
  template <class T>
  void send(T content) {
    inbox_.push_back({kStation, kSelf, 0, now_, std::move(content)});
  }
  static Zone named(const std::string& name) {
    Zone zone;
    zone.name = name;
    return zone;
  }

  void order() { send(Task{++number_, some_task()}); }

  TaskKind some_task() {
    const Vec2 a = place(), b = place(), c = place();
    switch (static_cast<int>(18 * uniform())) {
      case 0:
        return Loiter{a};
      case 1:
        return FlyTo{a};
      case 2:
        return FollowEdge{uniform() < 0.5, a, {0, 1}};
      case 3:
        return FollowLine{{a, b, c}};
      case 4:
        return FlyCourse{7 * uniform()};
      case 5:
        return FlyRoute{{a, b, c}, 2, {}};
      case 6:
        return FollowLeader{kOther, {-40, 30}};
      case 7:
        return FlyTour{{a, b, c}, 2};
      case 8:
        return Hold{};
      case 9: {
        Survey survey;
        survey.area = {a, a + Vec2(500, 0), a + Vec2(500, 400), a + Vec2(0, 400)};
        survey.swath = 90;
        return survey;
      }
      case 10:
        return Patrol{{a, b, c}, uniform() < 0.5, 20, 2};
      case 11: {
        Orbit orbit;
        orbit.point = a;
        if (uniform() < 0.5) orbit.object = 0;
        orbit.weave = uniform() < 0.3;
        orbit.radius = 300 * uniform();
        return orbit;
      }
      case 12:
        return Measure{a, 30};
      case 13:
        return Rendezvous{a, now_ + Time::from_seconds(300 * uniform()), {}};
      case 14:
        return Relay{kOther, kStation};
      case 15: {
        const model::AirMotion air{20, 70, {2, 1}};
        const model::Pose from{a, 7 * uniform()}, to{b, 7 * uniform()};
        return FlyPlan{
            model::to_flight_plan(model::connect(from, to, air), from, air, 0, -220)};
      }
      case 16:
        return ReturnHome{};
      default:
        return LandAt{uniform() < 0.5, a};
    }
  }

  void change() {
    send(TaskChange{++number_, static_cast<TaskAction>(static_cast<int>(3 * uniform()))});
  }

  void zone() {
    if (!zones_.empty() && uniform() < 0.5) {
      send(ZoneChange{++zone_number_, false, named(zones_.back())});
      zones_.pop_back();
      return;
    }
    Zone zone{.area = Disc{place(), 60 + 250 * uniform()}};
    zone.name = fmt::format("z{}", ++named_);
    zones_.push_back(zone.name);
    send(ZoneChange{++zone_number_, true, zone});
  }

  void others() {
    NavEstimate nav;
    nav.time = now_;
    nav.p_N = {place().x(), place().y(), -220};
    nav.v_N = {18, 0, 0};
    send(TeamPosition{kOther, nav});
    send(TeamPosition{kStation, nav});
  }

  // There is something to fly, and it can be flown.
  void check(const AgentOutput& out) {
    has_flown_ = has_flown_ || out.command.has_value();
    EXPECT_TRUE(has_flown_);
    if (!out.command) return;
    EXPECT_TRUE(std::isfinite(out.command->altitude_msl)) << last_;
    if (const auto* plan = std::get_if<FollowPlan>(&out.command->guidance)) {
      EXPECT_FALSE(plan->plan.empty()) << last_;
      for (std::size_t k = 0; k < plan->plan.size(); ++k) {
        EXPECT_TRUE(plan->plan[k].p_N.allFinite()) << last_;
        EXPECT_TRUE(k == 0 || plan->plan[k - 1].time < plan->plan[k].time) << last_;
      }
    }
  }

  // What of a command the test's aircraft does not know becomes something that it does.
  void take(const AutopilotCommand& command) {
    ++fate_.number;
    fate_.state = CommandFate::State::kAccepted;
    if (refuses_ && std::holds_alternative<FollowPlan>(command.guidance)) {
      fate_.state = CommandFate::State::kRefused;
      return;
    }
    AutopilotCommand known = command;
    if (const auto* route = std::get_if<FlyWaypoints>(&command.guidance))
      known.guidance = HoldPosition{route->points.front().point};
    else if (std::holds_alternative<Return>(command.guidance))
      known.guidance = HoldPosition{Vec2::Zero()};
    else if (const auto* land = std::get_if<Land>(&command.guidance))
      known.guidance = HoldPosition{land->point};
    else if (std::holds_alternative<TakeOff>(command.guidance))
      known.guidance = HoldCourse{0};
    aircraft_.obey(known);
  }

  RandomStream random_;
  reasoning::test::FlatGround ground_;
  reasoning::test::TestAircraft aircraft_;
  FlightContext context_{kSelf, FlightLimits{}, &ground_,
                         std::make_shared<solve::AaStar>(), 120};
  OnboardAgent agent_;
  std::vector<Message> inbox_;
  std::vector<std::string> zones_;
  std::uint32_t number_ = 0, zone_number_ = 0, flight_number_ = 0;
  int named_ = 0;
  bool refuses_ = false, has_flown_ = false;
  CommandFate fate_;
  Time now_;
  std::string last_;
};

TEST(TaskWalk, HasAlwaysSomethingToFlyAndAWayOut) {
  for (const std::uint64_t seed : {1, 2}) {
    Walk walk(seed);
    for (int k = 0; k < 10'000; ++k) {
      walk.step();
      if (testing::Test::HasFailure()) {
        FAIL() << "seed " << seed << ", step " << k << ", after " << walk.last();
      }
      // Now and then: out of whatever it is in.
      if (k % 1000 == 999) {
        ASSERT_TRUE(walk.reaches({500, -300}))
            << "seed " << seed << ", step " << k << ", after " << walk.last();
      }
    }
  }
}

}  // namespace
}  // namespace skein::assemble::task_walk_test
