// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/server_memory.h"

#include <gtest/gtest.h>

#include "skein/assemble/kinds/kind_registry.h"
#include "skein/scenario/kind_table.h"

namespace skein::assemble::server_memory_test {
namespace {

EntityReality reality(const std::string& vehicle, std::optional<bool> physical,
                      std::optional<Reality> observes) {
  scenario::AircraftGroup group;
  group.vehicle = scenario::default_choice(KindRegistry().table(), "vehicle", vehicle);
  group.physical = physical;
  group.observes = observes;
  return reality_of(group);
}

TEST(Reality, OfAGroupFollowsFromItsVehicleUnlessItIsSaid) {
  constexpr Reality kV = Reality::kVirtual, kP = Reality::kPhysical, kB = Reality::kBoth;
  EXPECT_EQ(reality("simulated", {}, {}), (EntityReality{kV, kV, kV}));
  EXPECT_EQ(reality("mavlink", {}, {}), (EntityReality{kP, kV, kV}));
  EXPECT_EQ(reality("simulated", true, {}), (EntityReality{kP, kP, kP}));
  EXPECT_EQ(reality("mavlink", {}, kB), (EntityReality{kP, kB, kB}));
  EXPECT_EQ(reality("mavlink", false, kB), (EntityReality{kV, kB, kV}));
  EXPECT_EQ(reality("simulated", {}, kB), (EntityReality{kV, kB, kV}));
}

TEST(Reality, HasAClassForEachEntity) {
  EXPECT_EQ(class_of(reality("simulated", {}, {})), "pure-simulated");
  EXPECT_EQ(class_of(reality("simulated", {}, Reality::kBoth)), "simulated-mixed");
  EXPECT_EQ(class_of(reality("simulated", true, {})), "pure-real");
  EXPECT_EQ(class_of(reality("simulated", true, Reality::kBoth)), "real-mixed");
  EXPECT_EQ(class_of(reality("mavlink", {}, {})), "real-virtual-payload");
}

TEST(MemoryWarnings, SayThatNobodyWillSeeWhatIsPhysical) {
  scenario::Scenario scenario;
  EXPECT_TRUE(memory_warnings(scenario).empty());
  scenario.environment.objects.emplace_back().physical = true;
  EXPECT_EQ(memory_warnings(scenario).size(), 1u);
  scenario.aircraft.front().physical = true;
  EXPECT_TRUE(memory_warnings(scenario).empty());
}

TEST(PhysicalBody, IsTypicalOfItsClassUnlessItIsSaid) {
  scenario::PlacedObject object;
  object.what = ObjectClass::kVehicle;
  object.height = 4;
  const PhysicalObject body = body_of(object, 6);
  EXPECT_EQ(body.id, 6u);
  EXPECT_EQ(body.radius, 3);
  EXPECT_EQ(body.height, 4);
}

}  // namespace
}  // namespace skein::assemble::server_memory_test
