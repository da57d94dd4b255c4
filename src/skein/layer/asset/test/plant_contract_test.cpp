// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>

#include "skein/base/random.h"
#include "skein/base/test/allocations.h"
#include "skein/layer/asset/fixed_wing/fixed_wing_plant.h"
#include "skein/layer/asset/kinematic_plant.h"
#include "skein/layer/asset/multirotor/multirotor_plant.h"
#include "skein/layer/asset/performance/performance_plant.h"

// What every plant owes to whoever flies it.

namespace skein::asset::plant_contract_test {
namespace {

struct Kind {
  std::string name;
  std::unique_ptr<Plant> (*make)();
};

template <class P, class Parameters>
std::unique_ptr<Plant> made() {
  return std::make_unique<P>(Parameters{});
}

class AnyPlant : public ::testing::TestWithParam<Kind> {
 protected:
  std::unique_ptr<Plant> plant_ = GetParam().make();

  bool self_stabilised() const {
    return std::holds_alternative<SelfStabilised>(plant_->airframe());
  }

  // Numbers from `value()`, as the control that the plant takes.
  template <class Value>
  Control control_of(Value value) const {
    if (self_stabilised()) return FlightCommand{value(), value(), value()};
    Actuators actuators;
    for (double& channel : actuators.channel) channel = value();
    return actuators;
  }
};

bool finite(const VehicleState& s) {
  return s.p_N.allFinite() && s.v_N.allFinite() && s.q_NB.coeffs().allFinite() &&
         s.w_NB_B.allFinite() && std::isfinite(s.airspeed) &&
         std::isfinite(s.energy.charge) && std::isfinite(s.energy.power);
}

TEST_P(AnyPlant, StartsAtTheGivenState) {
  const VehicleStart start{{100, -50, -400}, 2, {4, -3, 0}, false};
  const VehicleState s = plant_->start(start);
  EXPECT_EQ(s.p_N, start.p_N);
  EXPECT_NEAR(geo::yaw(s.q_NB), 2, 1e-9);
  EXPECT_NEAR(s.airspeed, (s.v_N - start.wind_N).norm(), 1e-9);
  EXPECT_FALSE(s.on_ground);
  EXPECT_TRUE(finite(s));
  EXPECT_EQ(s.energy.charge, 1);
  const FlightLimits limits = plant_->limits();
  // What can hover hovers; what cannot flies at cruise.
  EXPECT_NEAR(limits.slowest > 0 ? s.airspeed : s.v_N.norm(),
              limits.slowest > 0 ? limits.airspeed : 0, 1e-6);
}

TEST_P(AnyPlant, LimitsAreInOrder) {
  const FlightLimits limits = plant_->limits();
  EXPECT_LE(limits.slowest, limits.airspeed);
  EXPECT_LE(limits.airspeed, limits.fastest);
  EXPECT_GT(limits.turn_radius, 0);
  EXPECT_GT(limits.climb_rate, 0);
  EXPECT_GT(limits.sink_rate, 0);
}

TEST_P(AnyPlant, StepDoesNotAllocate) {
  VehicleState s = plant_->start({{0, 0, -300}, 0, Vec3::Zero(), false});
  const Control control = control_of([] { return 0.6; });
  const auto before = allocations();
  if (!before) GTEST_SKIP() << "the sanitizer's own malloc prevents it";
  ASSERT_GT(before, 0);
  for (int i = 0; i < 100; ++i) plant_->step(s, control, {}, 0.01);
  plant_->touch(s, 0, 0.01);
  EXPECT_EQ(allocations(), before);
}

TEST_P(AnyPlant, StaysFiniteUnderAnyControl) {
  RandomStream random(11, 0, Purpose::kTest);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const double odd[] = {kNan, kInf, -kInf, 1e300, -1, 0, 0.5, 1, 30};
  VehicleState s = plant_->start({{0, 0, -3000}, 0, Vec3::Zero(), false});
  for (int i = 0; i < 5000; ++i) {
    const Control control =
        control_of([&] { return odd[static_cast<std::size_t>(random.uniform() * 9)]; });
    Air air;
    air.wind_N = {20 * random.uniform() - 10, 20 * random.uniform() - 10, 0};
    plant_->step(s, control, air, 0.01);
    ASSERT_TRUE(finite(s)) << i;
    s.p_N.z() = -3000;
  }
  EXPECT_GE(s.energy.charge, 0);
  EXPECT_LE(s.energy.charge, 1);
}

TEST_P(AnyPlant, HasNothingButItsStateToRemember) {
  VehicleState a = plant_->start({{0, 0, -300}, 1, Vec3::Zero(), false});
  VehicleState other = plant_->start({{5, 0, -900}, -2, Vec3::Zero(), false});
  VehicleState b = a;
  const Control control = control_of([] { return 0.55; });
  const Control different = control_of([] { return 0.1; });
  for (int i = 0; i < 50; ++i) plant_->step(a, control, {}, 0.01);
  for (int i = 0; i < 50; ++i) {
    plant_->step(other, different, {}, 0.02);
    plant_->step(b, control, {}, 0.01);
  }
  EXPECT_EQ(a.p_N, b.p_N);
  EXPECT_EQ(a.q_NB.coeffs(), b.q_NB.coeffs());
  EXPECT_EQ(a.actuators, b.actuators);
  EXPECT_EQ(a.energy.charge, b.energy.charge);
}

TEST_P(AnyPlant, GivesNoPowerWithoutBattery) {
  VehicleState s = plant_->start({{0, 0, -300}, 1, Vec3::Zero(), false});
  s.faults.battery = true;
  const Control control = control_of([] { return 0.6; });
  for (int i = 0; i < 10; ++i) plant_->step(s, control, {}, 0.01);
  EXPECT_EQ(s.energy.power, 0);
  EXPECT_EQ(s.energy.charge, 1);
}

INSTANTIATE_TEST_SUITE_P(
    Plants, AnyPlant,
    ::testing::Values(Kind{"kinematic", made<KinematicPlant, KinematicOptions>},
                      Kind{"performance", made<PerformancePlant, PerformanceParameters>},
                      Kind{"fixed_wing", made<FixedWingPlant, FixedWingParameters>},
                      Kind{"multirotor", made<MultirotorPlant, MultirotorParameters>}),
    [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace skein::asset::plant_contract_test
