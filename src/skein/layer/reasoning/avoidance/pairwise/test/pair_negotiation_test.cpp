#include "skein/layer/reasoning/avoidance/pairwise/pair_negotiation.h"

#include <gtest/gtest.h>

#include "skein/base/math.h"
#include "skein/layer/reasoning/avoidance/meeting/plan_meeting.h"

namespace skein::reasoning {
namespace {

FlightPlan straight(const Vec3& from, double heading) {
  FlightElement e;
  e.duration = 200;
  e.airspeed = 20;
  e.heading = heading;
  e.p_N = from;
  return {e};
}

// Two that fly towards each other, and what each knows of a negotiation.
struct Two {
  FlightPlan plan_a = straight(Vec3(0, 0, -100), 0);
  FlightPlan plan_b = straight(Vec3(2400, 0, -100), geo::kPi);
  FlightLimits limits;
  Separation separation{66, 24};

  PairNegotiation of(bool a, double delay = 0) const {
    NegotiatedConflict conflict;
    conflict.self = EntityId{a ? 1u : 2u};
    conflict.other = EntityId{a ? 2u : 1u};
    conflict.name = {EntityId{1}, 1};
    conflict.begin = 4;
    conflict.meets = 58;
    conflict.closest = 60;
    conflict.apart = 62;
    conflict.separation = separation;
    conflict.look_until = 150;
    conflict.delay = delay;
    return {conflict,
            {a ? plan_a : plan_b, 200, limits},
            {a ? plan_b : plan_a, 200, {}},
            Time()};
  }
};

void give(const std::vector<Message>& from, PairNegotiation& to) {
  for (const Message& message : from)
    if (const auto* offers = std::get_if<Offers>(&message.content))
      to.take(*offers);
    else if (const auto* acceptance = std::get_if<Acceptance>(&message.content))
      to.take(*acceptance);
}

TEST(PairNegotiation, BothFindTheSameFlightsThatAreApart) {
  const Two two;
  PairNegotiation a = two.of(true), b = two.of(false);
  std::vector<Message> from_a, from_b;
  for (int k = 0; k < 4; ++k) {
    const Time now = Time::from_seconds(0.5 * k);
    give(from_b, a);
    from_a.clear();
    a.step(now, {}, from_a);
    give(from_a, b);
    from_b.clear();
    b.step(now, {}, from_b);
  }
  ASSERT_EQ(a.state(), PairNegotiation::State::kAgreed);
  ASSERT_EQ(b.state(), PairNegotiation::State::kAgreed);
  EXPECT_FALSE(first_meeting(a.flight(), b.flight(), two.separation, 0, 200));
  const auto as_a_knows =
      flight_with(b.manoeuvre(), {two.plan_b, 200, two.limits}, a.conflict());
  ASSERT_TRUE(as_a_knows);
  EXPECT_EQ(as_a_knows->size(), b.flight().size());
}

TEST(PairNegotiation, EndsByItselfWhenNobodyAnswers) {
  const Two two;
  PairNegotiation a = two.of(true);
  std::vector<Message> out;
  for (int k = 0; k < 40; ++k) a.step(Time::from_seconds(0.5 * k), {}, out);
  EXPECT_EQ(a.state(), PairNegotiation::State::kFailed);
  EXPECT_GE(out.size(), 3u);  // it was said again
}

TEST(PairNegotiation, IsAgreedWhenTheOtherFliesIt) {
  const Two two;
  PairNegotiation a = two.of(true), b = two.of(false);
  std::vector<Message> from_a, from_b;
  a.step(Time(), {}, from_a);
  give(from_a, b);
  b.step(Time(), {}, from_b);
  give({from_b.front()}, a);  // its offers; the acceptance is lost
  a.step(Time::from_seconds(0.5), {}, from_a);
  EXPECT_EQ(a.state(), PairNegotiation::State::kOpen);
  a.other_flies_it();
  a.step(Time::from_seconds(1), {}, from_a);
  EXPECT_EQ(a.state(), PairNegotiation::State::kAgreed);
}

TEST(PairNegotiation, OffersThatMakeNoSenseEndIt) {
  const Two two;
  PairNegotiation a = two.of(true);
  std::vector<Message> out;
  Offers odd;
  odd.strength = 1;
  odd.manoeuvres.push_back({200, 0, 0, 0.5F});
  a.step(Time(), {}, out);
  a.take(odd);
  EXPECT_EQ(a.state(), PairNegotiation::State::kFailed);
}

}  // namespace
}  // namespace skein::reasoning
