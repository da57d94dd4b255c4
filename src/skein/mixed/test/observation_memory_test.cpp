// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/observation_memory.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

namespace skein::mixed::observation_memory_test {
namespace {

Time at_s(double seconds) {
  return Time::from_seconds(seconds);
}

Observation seen(double time, double north, Reality source = Reality::kPhysical,
                 ObjectClass what = ObjectClass::kPerson, std::uint32_t object = 0) {
  return {object, at_s(time), {north, 0}, 1, what, EntityId{1}, source};
}

ForgettingRules logical() {
  ForgettingRules rules;
  rules.model = ForgettingModel::kLogical;
  return rules;
}

// Observations of three objects, in any order of time, by sensors of both kinds.
std::vector<Observation> any_observations() {
  std::vector<Observation> all;
  const int count = *rc::gen::inRange(0, 40);
  for (int k = 0; k < count; ++k) {
    Observation each = seen(*rc::gen::inRange(0, 100), k);
    each.object = *rc::gen::inRange<std::uint32_t>(0, 3);
    each.what = static_cast<ObjectClass>(each.object);
    each.source = *rc::gen::element(Reality::kPhysical, Reality::kVirtual);
    all.push_back(each);
  }
  return all;
}

TEST(ObservationMemory, VirtualObservationsChangeNothing) {
  EXPECT_TRUE(rc::check([] {
    ObservationMemory with((ForgettingRules())), without((ForgettingRules()));
    for (const Observation& each : any_observations()) {
      const ObservationFate fate = with.add(each, at_s(100));
      if (each.source == Reality::kVirtual)
        RC_ASSERT(fate == ObservationFate::kRefused);
      else
        RC_ASSERT(fate == without.add(each, at_s(100)));
    }
    RC_ASSERT(with.entries().size() == without.entries().size());
    for (const auto& [object, entry] : with.entries()) {
      RC_ASSERT(without.find(object));
      RC_ASSERT(without.find(object)->observation.position == entry.observation.position);
      RC_ASSERT(without.find(object)->observation.time == entry.observation.time);
    }
  }));
}

TEST(ObservationMemory, KeepsTheNewestWhateverTheOrderOfArrival) {
  EXPECT_TRUE(rc::check([] {
    ObservationMemory memory((ForgettingRules()));
    std::map<std::uint32_t, Time> newest;
    for (const Observation& each : any_observations()) {
      memory.add(each, at_s(100));
      if (each.source != Reality::kPhysical) continue;
      const auto [known, first] = newest.try_emplace(each.object, each.time);
      known->second = std::max(known->second, each.time);
      RC_ASSERT(memory.find(each.object)->observation.time == known->second);
    }
    RC_ASSERT(memory.entries().size() == newest.size());
  }));
}

TEST(ObservationMemory, ALateObservationLeavesTheNewerOne) {
  ObservationMemory memory((ForgettingRules()));
  EXPECT_EQ(memory.add(seen(5, 50), at_s(5.2)), ObservationFate::kRemembered);
  EXPECT_EQ(memory.add(seen(4, 40), at_s(6)), ObservationFate::kLate);
  EXPECT_EQ(memory.find(0)->observation.position.x(), 50);
  EXPECT_EQ(memory.find(0)->since, at_s(5.2));
  EXPECT_EQ(memory.add(seen(6, 60), at_s(6.2)), ObservationFate::kRemembered);
  EXPECT_EQ(memory.find(0)->observation.position.x(), 60);
}

TEST(ObservationMemory, NothingOlderThanItsClassMayBeIsLeft) {
  EXPECT_TRUE(rc::check([] {
    ForgettingRules rules;
    rules.max_age = {at_s(10), at_s(20), at_s(30), {}};
    ObservationMemory memory(rules);
    for (const Observation& each : any_observations()) memory.add(each, at_s(100));
    const std::size_t before = memory.entries().size();
    const double now = *rc::gen::inRange(0, 200);
    const auto expired = memory.expire(at_s(now));
    RC_ASSERT(expired.size() + memory.entries().size() == before);
    for (const Observation& each : expired)
      RC_ASSERT(now - each.time.seconds() > 10 * (each.object + 1));
    for (const auto& [object, entry] : memory.entries())
      RC_ASSERT(now - entry.observation.time.seconds() <= 10 * (object + 1));
  }));
}

TEST(ObservationMemory, StructuresAreNotForgottenByAge) {
  ObservationMemory memory((ForgettingRules()));
  memory.add(seen(0, 1, Reality::kPhysical, ObjectClass::kStructure), at_s(0));
  EXPECT_TRUE(memory.expire(at_s(1e6)).empty());
  EXPECT_TRUE(memory.find(0));
}

TEST(ObservationMemory, WhatIsForgottenComesBackWithANewerPictureOnly) {
  ObservationMemory memory((ForgettingRules()));
  memory.add(seen(10, 1), at_s(10));
  ASSERT_EQ(memory.expire(at_s(611)).size(), 1u);
  EXPECT_FALSE(memory.find(0));
  EXPECT_EQ(memory.add(seen(10, 1), at_s(612)), ObservationFate::kLate);
  EXPECT_EQ(memory.add(seen(611, 2), at_s(612)), ObservationFate::kRemembered);
}

TEST(ObservationMemory, LogicalRulesForgetAnUnstableObjectAtOnceAStableOneLater) {
  ObservationMemory memory(logical());
  memory.add(seen(0, 1), at_s(0));
  memory.add(seen(0, 2, Reality::kPhysical, ObjectClass::kStructure, 1), at_s(0));
  EXPECT_TRUE(memory.expire(at_s(1e6)).empty()) << "age does not count";
  EXPECT_TRUE(memory.look_in_vain(0, at_s(1)));
  EXPECT_FALSE(memory.find(0));
  EXPECT_FALSE(memory.look_in_vain(1, at_s(1)));
  EXPECT_FALSE(memory.look_in_vain(1, at_s(2)));
  EXPECT_TRUE(memory.find(1));
  EXPECT_TRUE(memory.look_in_vain(1, at_s(3)));
  EXPECT_FALSE(memory.find(1));
  EXPECT_FALSE(memory.look_in_vain(1, at_s(4))) << "it is not remembered";
}

TEST(ObservationMemory, ASightingBetweenLooksInVainCountsThemAnew) {
  ObservationMemory memory(logical());
  const auto structure = [](double time) {
    return seen(time, 2, Reality::kPhysical, ObjectClass::kStructure);
  };
  memory.add(structure(0), at_s(0));
  memory.look_in_vain(0, at_s(1));
  memory.look_in_vain(0, at_s(2));
  memory.add(structure(3), at_s(3));
  EXPECT_FALSE(memory.look_in_vain(0, at_s(2.5))) << "before it was seen";
  EXPECT_FALSE(memory.look_in_vain(0, at_s(3))) << "in the same picture";
  EXPECT_FALSE(memory.look_in_vain(0, at_s(4)));
  EXPECT_FALSE(memory.look_in_vain(0, at_s(5)));
  EXPECT_TRUE(memory.look_in_vain(0, at_s(6)));
}

TEST(ObservationMemory, TheTemporalModelSaysOnceThatItIsGoneAndKeepsIt) {
  ObservationMemory memory((ForgettingRules()));
  memory.add(seen(0, 1), at_s(0));
  EXPECT_TRUE(memory.look_in_vain(0, at_s(1)));
  EXPECT_FALSE(memory.look_in_vain(0, at_s(2)));
  EXPECT_TRUE(memory.find(0));
}

}  // namespace
}  // namespace skein::mixed::observation_memory_test
