// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "skein/scenario/test/reading.h"

namespace skein::scenario::test::memory_keys_test {
namespace {

TEST(MemoryKeys, AreRead) {
  const Scenario s = read_good(
      "environment:\n"
      "  objects: [{physical: true, class: structure, radius_m: 4}, {}]\n"
      "  memory: {model: logical, stable: [structure, vehicle], person_max_age_s: null,\n"
      "           animal_max_age_s: 7, stable_looks: 5, moved_m: 2}\n"
      "aircraft: [{physical: true, observes: both}, {}]\n");
  EXPECT_TRUE(s.environment.objects[0].physical);
  EXPECT_EQ(s.environment.objects[0].radius, 4);
  EXPECT_FALSE(s.environment.objects[0].height);
  EXPECT_FALSE(s.environment.objects[1].physical);
  const ForgettingRules& rules = s.environment.memory.forgetting;
  EXPECT_EQ(rules.model, ForgettingModel::kLogical);
  EXPECT_EQ(rules.rate_of(ObjectClass::kVehicle), RateOfChange::kStable);
  EXPECT_EQ(rules.rate_of(ObjectClass::kPerson), RateOfChange::kUnstable);
  EXPECT_EQ(rules.looks(ObjectClass::kVehicle), 5);
  EXPECT_EQ(rules.looks(ObjectClass::kPerson), 1);
  EXPECT_FALSE(rules.max_age_of(ObjectClass::kPerson));
  EXPECT_EQ(rules.max_age_of(ObjectClass::kAnimal), Time::from_seconds(7));
  EXPECT_EQ(rules.max_age_of(ObjectClass::kVehicle), Time::from_seconds(300));
  EXPECT_FALSE(rules.max_age_of(ObjectClass::kStructure));
  EXPECT_EQ(s.environment.memory.moved, 2);
  EXPECT_EQ(s.aircraft[0].physical, true);
  EXPECT_EQ(s.aircraft[0].observes, Reality::kBoth);
  EXPECT_FALSE(s.aircraft[1].physical || s.aircraft[1].observes);
}

TEST(MemoryKeys, ThatContradictEachOtherAreRefused) {
  EXPECT_NE(problems_of("aircraft: [{observes: physical}]").find("needs physical: true"),
            std::string::npos);
  EXPECT_EQ(problems_of("aircraft: [{observes: physical, physical: true}]"), "");
  EXPECT_NE(problems_of("environment: {objects: [{radius_m: 3}]}")
                .find("environment.objects[0].physical: is needed"),
            std::string::npos);
}

}  // namespace
}  // namespace skein::scenario::test::memory_keys_test
