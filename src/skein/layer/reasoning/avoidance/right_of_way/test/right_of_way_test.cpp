// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/right_of_way/right_of_way.h"

#include <gtest/gtest.h>

namespace skein::reasoning::right_of_way_test {
namespace {

constexpr EntityId kHigher{1}, kLower{2}, kThird{3};

YieldRequest conflict(std::uint32_t own_plan = 4, std::uint32_t other_plan = 7) {
  return {0, own_plan, other_plan, 50, 60};
}

Time at(double seconds) {
  return Time::from_seconds(seconds);
}

YieldRequest request_in(const std::vector<Message>& out) {
  EXPECT_EQ(out.size(), 1u);
  return std::get<YieldRequest>(out.at(0).content);
}

TEST(RightOfWay, AGrantSwapsTheOrderUntilThirtySecondsAfter) {
  RightOfWay lower(kLower), higher(kHigher);
  std::vector<Message> out;
  lower.ask(at(10), kHigher, conflict(), 1);
  lower.step(at(10), out);
  const YieldRequest request = request_in(out);
  EXPECT_EQ(out[0].to, kHigher);
  EXPECT_FALSE(higher.answer_to(at(11), kLower, request)) << "it is to be decided";
  higher.decide(kLower, request, true);
  EXPECT_FALSE(lower.other_yields(kHigher, at(11))) << "it does not know yet";
  lower.take(at(12), kHigher, {request.request, true});
  for (const double t : {12.0, 60.0, 89.9}) {
    EXPECT_TRUE(lower.other_yields(kHigher, at(t))) << t;
    EXPECT_TRUE(higher.yields_to(kLower, at(t))) << t;
  }
  EXPECT_FALSE(lower.other_yields(kHigher, at(90)));
  EXPECT_FALSE(higher.yields_to(kLower, at(90)));
  EXPECT_FALSE(lower.other_yields(kThird, at(20))) << "of this pair only";
}

TEST(RightOfWay, ARequestIsRepeatedThreeTimesAndThenGivenUp) {
  RightOfWay lower(kLower);
  std::vector<Message> out;
  lower.ask(at(0), kHigher, conflict(), 1);
  for (double t = 0; t < 20; t += 0.5) {
    lower.step(at(t), out);
    lower.ask(at(t), kHigher, conflict(), 1);
  }
  ASSERT_EQ(out.size(), 4u);
  for (const Message& each : out)
    EXPECT_EQ(std::get<YieldRequest>(each.content).request, 1u);
  EXPECT_FALSE(lower.is_asking());
  lower.take(at(20), kHigher, {1, true});
  EXPECT_TRUE(lower.other_yields(kHigher, at(20))) << "a late answer is one";
}

TEST(RightOfWay, TheSamePlansAreAskedAboutOnce) {
  RightOfWay lower(kLower);
  std::vector<Message> out;
  lower.ask(at(0), kHigher, conflict(), 1);
  lower.step(at(0), out);
  lower.take(at(1), kHigher, {1, false});
  lower.ask(at(2), kHigher, conflict(), 1);
  lower.step(at(2), out);
  EXPECT_EQ(out.size(), 1u);
  lower.ask(at(3), kHigher, conflict(4, 8), 1);
  lower.step(at(3), out);
  EXPECT_EQ(out.size(), 2u) << "another plan, another question";
  EXPECT_FALSE(lower.other_yields(kHigher, at(3)));
}

TEST(RightOfWay, TheSameRequestHasTheSameAnswer) {
  RightOfWay higher(kHigher);
  YieldRequest request = conflict();
  request.request = 5;
  higher.decide(kLower, request, true);
  EXPECT_EQ(higher.answer_to(at(1), kLower, request), true);
  YieldRequest other = request;
  other.request = 6;
  EXPECT_EQ(higher.answer_to(at(1), kLower, other), false) << "once in a conflict";
  EXPECT_FALSE(higher.answer_to(at(90), kLower, other)) << "it is over";
  EXPECT_FALSE(higher.answer_to(at(1), kThird, request)) << "of somebody else";
}

TEST(RightOfWay, AfterARefusalItMayBeAskedAboutOtherPlans) {
  RightOfWay higher(kHigher);
  YieldRequest request = conflict();
  request.request = 5;
  higher.decide(kLower, request, false);
  EXPECT_EQ(higher.answer_to(at(1), kLower, request), false);
  YieldRequest other = conflict(4, 8);
  other.request = 6;
  EXPECT_FALSE(higher.answer_to(at(1), kLower, other));
}

TEST(RightOfWay, AnswersOfOthersAndToOtherRequestsAreNone) {
  RightOfWay lower(kLower);
  std::vector<Message> out;
  lower.ask(at(0), kHigher, conflict(), 1);
  lower.step(at(0), out);
  lower.take(at(1), kThird, {1, true});
  lower.take(at(1), kHigher, {2, true});
  EXPECT_TRUE(lower.is_asking());
  EXPECT_FALSE(lower.other_yields(kHigher, at(1)));
  EXPECT_FALSE(lower.other_yields(kThird, at(1)));
}

}  // namespace
}  // namespace skein::reasoning::right_of_way_test
