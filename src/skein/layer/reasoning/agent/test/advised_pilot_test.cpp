// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/advised_pilot.h"

#include <gtest/gtest.h>

#include <vector>

namespace skein::reasoning::advised_pilot_test {
namespace {

FlightIntent straight(std::uint32_t number) {
  FlightElement e;
  e.duration = 300;
  e.airspeed = 50;
  e.p_N = Vec3(0, 0, -600);
  return {number, Itinerary{{e}, {300}, true, true, false}};
}

class Cockpit {
 public:
  explicit Cockpit(const AdvisedPilotOptions& options) : pilot_(EntityId{2}, options) {
    nav_.v_N = Vec3(50, 0, 0);
  }

  const FlightIntent* fly(double time, const FlightIntent& advised,
                          std::string_view reason) {
    AgentInput in;
    in.now = Time::from_seconds(time);
    in.nav = &nav_;
    AgentOutput out;
    const FlightIntent* flown = pilot_.fly(&task, &advised, reason, in, out);
    for (const AgentRecord& record : out.records)
      said.push_back(std::get<Recommendation>(record));
    return flown;
  }

  FlightIntent task = straight(1);
  std::vector<Recommendation> said;

 private:
  AdvisedPilot pilot_;
  NavEstimate nav_;
};

TEST(AdvisedPilot, FliesTheTaskWithoutAWordUntilSomethingIsRecommended) {
  Cockpit cockpit({2, 20, 1, 7});
  EXPECT_EQ(cockpit.fly(0, cockpit.task, ""), &cockpit.task);
  EXPECT_TRUE(cockpit.said.empty());
}

TEST(AdvisedPilot, FollowsAfterAReactionTimeWithinItsRange) {
  double earliest = 1e9, latest = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Cockpit cockpit({2, 20, 1, seed});
    cockpit.fly(0, cockpit.task, "");
    const FlightIntent aside = straight(2);
    double followed = -1;
    for (double t = 0.5; t < 30 && followed < 0; t += 0.5)
      if (cockpit.fly(t, aside, "gives way") == &aside) followed = t - 0.5;
    ASSERT_GE(followed, 2);
    ASSERT_LE(followed, 20.5);
    earliest = std::min(earliest, followed);
    latest = std::max(latest, followed);
    ASSERT_EQ(cockpit.said.size(), 2u);
    EXPECT_EQ(cockpit.said[0].state, RecommendationState::kShown);
    EXPECT_EQ(cockpit.said[0].reason, "gives way");
    ASSERT_EQ(cockpit.said[0].path.size(), 37u) << "three minutes, each five seconds";
    EXPECT_EQ(cockpit.said[1].state, RecommendationState::kFollowed);
  }
  EXPECT_LT(earliest, 3.5) << "200 even draws";
  EXPECT_GT(latest, 18.5);
}

TEST(AdvisedPilot, UntilThenTheFlightOfBeforeGoesOn) {
  Cockpit cockpit({10, 10, 1, 7});
  const FlightIntent timed = straight(5);  // the task's own, flown in time
  cockpit.fly(0, timed, "");
  const FlightIntent aside = straight(6), other = straight(8);
  EXPECT_EQ(cockpit.fly(1, aside, "gives way")->number, 5u);
  EXPECT_EQ(cockpit.fly(10.5, aside, "gives way")->number, 5u);
  EXPECT_EQ(cockpit.fly(11.5, aside, "gives way")->number, 6u);
  EXPECT_EQ(cockpit.fly(50, other, "gives way")->number, 6u) << "thinks anew";
  EXPECT_EQ(cockpit.fly(59.5, other, "gives way")->number, 6u);
  EXPECT_EQ(cockpit.fly(60.5, other, "gives way")->number, 8u);
  EXPECT_EQ(cockpit.fly(61, timed, "")->number, 5u);
  EXPECT_EQ(cockpit.said.back().state, RecommendationState::kOver);
}

TEST(AdvisedPilot, AnUpdateOfThePathIsNotThoughtAboutAnew) {
  Cockpit cockpit({10, 10, 1, 7});
  cockpit.fly(0, straight(5), "");
  const FlightIntent first = straight(6), second = straight(7), third = straight(8);
  cockpit.fly(1, first, "gives way");
  EXPECT_EQ(cockpit.fly(8, second, "gives way")->number, 5u);
  EXPECT_EQ(cockpit.fly(11.5, second, "gives way")->number, 7u) << "as of the first";
  EXPECT_EQ(cockpit.fly(14, third, "gives way")->number, 8u) << "it is being followed";
  const FlightIntent fourth = straight(9);
  EXPECT_EQ(cockpit.fly(15, fourth, "climbs")->number, 9u);
  EXPECT_EQ(cockpit.said.back().reason, "climbs");
  EXPECT_EQ(cockpit.said.back().number, 1u);
}

TEST(AdvisedPilot, IgnoresAsOftenAsItDoesNotObey) {
  int ignored = 0;
  constexpr int kPilots = 1000;
  for (std::uint64_t seed = 1; seed <= kPilots; ++seed) {
    Cockpit cockpit({2, 4, 0.8, seed});
    cockpit.fly(0, cockpit.task, "");
    const FlightIntent aside = straight(2);
    const FlightIntent* flown = nullptr;
    for (double t = 1; t < 100; t += 9) flown = cockpit.fly(t, aside, "gives way");
    const bool follows = flown == &aside;
    ignored += follows ? 0 : 1;
    EXPECT_EQ(cockpit.said[1].state,
              follows ? RecommendationState::kFollowed : RecommendationState::kIgnored);
    if (!follows) {
      EXPECT_EQ(flown, &cockpit.task);
    }
  }
  EXPECT_NEAR(ignored, 200, 4 * 12.6) << "four standard deviations";
}

}  // namespace
}  // namespace skein::reasoning::advised_pilot_test
