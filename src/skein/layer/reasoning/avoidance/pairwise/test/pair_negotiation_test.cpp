// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/pairwise/pair_negotiation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "skein/base/math.h"
#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/avoidance/encounter/test/straight_flight.h"

namespace skein::reasoning::pair_negotiation_test {
namespace {

// Two that fly towards each other, and what each knows of a negotiation.
struct Two {
  FlightPlan plan_a = straight(Vec3(0, 0, -100), 0);
  FlightPlan plan_b = straight(Vec3(2400, 0, -100), geo::kPi);
  FlightLimits limits;
  Separation separation{66, 24};
  DealRule rule_a = DealRule::kSum, rule_b = DealRule::kSum;

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
    conflict.deal = a ? rule_a : rule_b;
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

// Steps both, each of which gets at once what the other has said.
void talk(PairNegotiation& a, PairNegotiation& b, int steps) {
  std::vector<Message> from_a, from_b;
  for (int k = 0; k < steps; ++k) {
    const Time now = Time::from_seconds(0.5 * k);
    give(from_b, a);
    from_a.clear();
    a.step(now, {}, from_a);
    give(from_a, b);
    from_b.clear();
    b.step(now, {}, from_b);
  }
}

TEST(PairNegotiation, BothFindTheSameFlightsThatAreApart) {
  const Two two;
  PairNegotiation a = two.of(true), b = two.of(false);
  talk(a, b, 4);
  ASSERT_EQ(a.state(), PairNegotiation::State::kAgreed);
  ASSERT_EQ(b.state(), PairNegotiation::State::kAgreed);
  EXPECT_FALSE(first_encounter(a.flight(), b.flight(), two.separation, 0, 200));
  const auto as_a_knows =
      flight_with(b.manoeuvre(), {two.plan_b, 200, two.limits}, a.conflict());
  ASSERT_TRUE(as_a_knows);
  EXPECT_EQ(as_a_knows->size(), b.flight().size());
}

// Aircraft 1 can get out of the way alone, or each goes half of it. What the second one
// says that its half costs is chosen: the two halves cost a little more than all of it.
struct Halves {
  Two two;
  Offers own, other;
  NegotiatedConflict conflict;

  Halves() {
    two.separation = {500, 150};
    PairNegotiation a = two.of(true), b = two.of(false);
    conflict = a.conflict();
    own = offers_of(a);
    other = offers_of(b);
    std::erase_if(other.manoeuvres, [](const OfferedManoeuvre& each) {
      const bool half = each.kind == static_cast<std::uint8_t>(ManoeuvreKind::kRight) &&
                        each.amount == 300 && each.lead == 50;
      return each.kind != 0 && !half;
    });
    const float alone = cheapest_with(0), half = cheapest_with(1);
    EXPECT_LT(half, alone);
    other.manoeuvres.at(0).cost = 0;
    other.manoeuvres.at(1).cost = alone - half + 0.1F;
  }

  static Offers offers_of(PairNegotiation& one) {
    std::vector<Message> out;
    one.step(Time(), {}, out);
    return std::get<Offers>(out.front().content);
  }
  std::optional<FlightPlan> flight(const OfferedManoeuvre& each,
                                   const FlightPlan& plan) const {
    return flight_with({static_cast<ManoeuvreKind>(each.kind), each.amount, each.lead},
                       {plan, 200, two.limits}, conflict);
  }
  bool is_free(const OfferedManoeuvre& mine, const OfferedManoeuvre& theirs) const {
    return !first_encounter(*flight(mine, two.plan_a), *flight(theirs, two.plan_b),
                            two.separation, conflict.begin, conflict.look_until);
  }
  float cheapest_with(std::size_t l) const {
    float least = 1e9F;
    for (const OfferedManoeuvre& each : own.manoeuvres)
      if (is_free(each, other.manoeuvres.at(l))) least = std::min(least, each.cost);
    return least;
  }

  // What aircraft 1 accepts if the two prefer these rules.
  std::optional<Acceptance> accepted(DealRule of_a, DealRule of_b) const {
    Two how = two;
    how.rule_a = of_a;
    PairNegotiation a = how.of(true);
    Offers said = other;
    said.deal = static_cast<std::uint8_t>(of_b);
    a.take(said);
    std::vector<Message> out;
    a.step(Time(), {}, out);
    for (const Message& message : out)
      if (const auto* acceptance = std::get_if<Acceptance>(&message.content))
        return *acceptance;
    return std::nullopt;
  }

  // The deal of the library over the same table.
  std::optional<Agreement> deal(DealRule rule) const {
    Bargain table;
    for (const OfferedManoeuvre& each : own.manoeuvres)
      table.u1.push_back(std::max(0.0, 1 - static_cast<double>(each.cost) / 120));
    for (const OfferedManoeuvre& each : other.manoeuvres)
      table.u2.push_back(std::max(0.0, 1 - static_cast<double>(each.cost) / 120));
    for (const OfferedManoeuvre& mine : own.manoeuvres)
      for (const OfferedManoeuvre& theirs : other.manoeuvres)
        table.free.push_back(is_free(mine, theirs));
    return agree(rule, table);
  }
};

TEST(PairNegotiation, TheDealIsThatOfTheRule) {
  const Halves halves;
  for (const DealRule rule : {DealRule::kSum, DealRule::kProduct, DealRule::kZeuthen}) {
    const auto acceptance = halves.accepted(rule, rule);
    const auto deal = halves.deal(rule);
    ASSERT_TRUE(acceptance && deal) << name_of(rule);
    EXPECT_EQ(acceptance->of_opener, deal->deal.k) << name_of(rule);
    EXPECT_EQ(acceptance->of_other, deal->deal.l) << name_of(rule);
    EXPECT_EQ(acceptance->of_other, rule == DealRule::kSum ? 0 : 1)
        << "what costs least is not what is fair";
  }
}

TEST(PairNegotiation, BothFindTheSameDealByAnyRule) {
  for (const DealRule rule : {DealRule::kProduct, DealRule::kZeuthen}) {
    Two two;
    two.rule_a = two.rule_b = rule;
    PairNegotiation a = two.of(true), b = two.of(false);
    talk(a, b, 6);
    ASSERT_EQ(a.state(), PairNegotiation::State::kAgreed) << name_of(rule);
    ASSERT_EQ(b.state(), PairNegotiation::State::kAgreed) << name_of(rule);
    EXPECT_FALSE(first_encounter(a.flight(), b.flight(), two.separation, 0, 200));
  }
}

TEST(PairNegotiation, OfDifferentRulesTheOneThatTrustsLessCounts) {
  constexpr DealRule kAll[] = {DealRule::kSum, DealRule::kProduct, DealRule::kZeuthen};
  const Halves halves;
  for (const DealRule of_a : kAll)
    for (const DealRule of_b : kAll) {
      const auto acceptance = halves.accepted(of_a, of_b);
      const auto deal = halves.deal(std::max(of_a, of_b));
      ASSERT_TRUE(acceptance && deal);
      EXPECT_EQ(acceptance->of_opener, deal->deal.k);
      EXPECT_EQ(acceptance->of_other, deal->deal.l);
    }
}

TEST(PairNegotiation, UtilityFallsWithTheCost) {
  EXPECT_EQ(utility_of(0), 1);
  EXPECT_EQ(utility_of(30), 0.75);
  EXPECT_EQ(utility_of(1e4), 0);
  EXPECT_EQ(utility_of(-50), 1) << "nobody gains by it";
}

TEST(PairNegotiation, ARuleThatIsNoneEndsIt) {
  const Two two;
  PairNegotiation a = two.of(true);
  std::vector<Message> out;
  Offers odd;
  odd.strength = 1;
  odd.deal = 3;
  a.step(Time(), {}, out);
  a.take(odd);
  EXPECT_EQ(a.state(), PairNegotiation::State::kFailed);
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
}  // namespace skein::reasoning::pair_negotiation_test
