// SPDX-License-Identifier: Apache-2.0
// Plants and autopilots.
#include <cmath>
#include <limits>

#include "skein/role/autopilot.h"
#include "skein/role/contract/checks.h"
#include "skein/role/plant.h"

namespace skein::contract {
namespace {

// Numbers from `value()`, as the control that a plant of this airframe takes.
template <class Value>
Control control_of(const Airframe& airframe, Value value) {
  if (std::holds_alternative<SelfStabilised>(airframe)) {
    FlightCommand command;
    command.roll = value();
    command.airspeed = value();
    command.climb_rate = value();
    return command;
  }
  Actuators actuators;
  for (double& channel : actuators.channel) channel = value();
  return actuators;
}

bool same(const VehicleState& a, const VehicleState& b) {
  return a.p_N == b.p_N && a.v_N == b.v_N && a.q_NB.coeffs() == b.q_NB.coeffs() &&
         a.w_NB_B == b.w_NB_B && a.airspeed == b.airspeed && a.actuators == b.actuators &&
         a.energy.charge == b.energy.charge;
}

void check_start(const Plant& plant, Checks& checks) {
  RandomStream random = draws(11);
  const FlightLimits limits = plant.limits();
  checks.expect(limits.slowest <= limits.airspeed && limits.airspeed <= limits.fastest,
                "limits(): slowest, airspeed and fastest are not in order");
  checks.expect(limits.turn_radius > 0 && limits.climb_rate > 0 && limits.sink_rate > 0,
                "limits(): turn_radius, climb_rate and sink_rate are not above 0");
  for (int i = 0; i < 20; ++i) {
    VehicleStart start;
    start.p_N << place_within(random, 5000), -random.uniform(100, 2000);
    start.heading = random.uniform(-geo::kPi, geo::kPi);
    start.wind_N << place_within(random, 4), 0;
    const VehicleState s = plant.start(start);
    checks.expect(is_finite(s), "start() is not finite");
    checks.expect(s.p_N == start.p_N, "start() begins at another place");
    checks.expect(std::abs(geo::wrap_pi(geo::yaw(s.q_NB) - start.heading)) < 1e-6,
                  "start() begins with another heading");
    checks.expect(!s.on_ground, "start() in the air says that it is on the ground");
  }
}

void check_any_control(const Plant& plant, Checks& checks) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const double odd[] = {kNan, kInf, -kInf, 1e300, -1, 0, 0.5, 1, 30};
  RandomStream random = draws(12);
  VehicleState s = plant.start({{0, 0, -3000}, 0, Vec3::Zero(), false});
  for (int i = 0; i < 2000; ++i) {
    const Control control = control_of(plant.airframe(), [&] {
      return odd[static_cast<std::size_t>(random.uniform() * 9)];
    });
    Air air;
    air.wind_N << place_within(random, 10), 0;
    plant.step(s, control, air, 0.01);
    checks.expect(is_finite(s), "step() is not finite under some control");
    checks.expect(s.energy.charge >= 0 && s.energy.charge <= 1,
                  "step() leaves a charge that is not from 0 to 1");
    if (!is_finite(s)) return;
    s.p_N.z() = -3000;
  }
}

void check_memory(const Plant& plant, Checks& checks) {
  VehicleState a = plant.start({{0, 0, -300}, 1, Vec3::Zero(), false});
  VehicleState other = plant.start({{5, 0, -900}, -2, Vec3::Zero(), false});
  VehicleState b = a;
  const Control control = control_of(plant.airframe(), [] { return 0.55; });
  const Control different = control_of(plant.airframe(), [] { return 0.1; });
  for (int i = 0; i < 50; ++i) plant.step(a, control, {}, 0.01);
  for (int i = 0; i < 50; ++i) {
    plant.step(other, different, {}, 0.02);
    plant.step(b, control, {}, 0.01);
  }
  checks.expect(same(a, b), "step() depends on more than the state: on other vehicles");
}

void check_touch(const Plant& plant, Checks& checks) {
  RandomStream random = draws(13);
  for (int i = 0; i < 20; ++i) {
    VehicleState s = plant.start({{0, 0, -100}, 1, Vec3::Zero(), false});
    s.v_N.z() = random.uniform(0, 3);
    const double ground = 100 + random.uniform(0, 0.05);
    const Contact contact = plant.touch(s, ground, 0.01);
    checks.expect(contact == Contact::kCrash || (s.on_ground && is_finite(s)),
                  "touch() rests, but the vehicle is not on the ground");
  }
}

}  // namespace

Violations plant_violations(const Make<Plant>& make) {
  Checks checks;
  const auto plant = make();
  check_start(*plant, checks);
  check_any_control(*plant, checks);
  check_memory(*plant, checks);
  check_touch(*plant, checks);
  return checks.take();
}

namespace {

NavEstimate level_flight(const FlightLimits& limits) {
  NavEstimate nav;
  nav.p_N = {120, -80, -300};
  nav.heading = 1;
  nav.v_N << limits.airspeed * geo::unit(nav.heading), 0;
  return nav;
}

bool in_range(const Control& control, const Airframe& airframe) {
  if (const auto* command = std::get_if<FlightCommand>(&control))
    return std::holds_alternative<SelfStabilised>(airframe) &&
           std::isfinite(command->roll) && std::isfinite(command->airspeed) &&
           std::isfinite(command->climb_rate);
  const auto& channels = std::get<Actuators>(control).channel;
  return !std::holds_alternative<SelfStabilised>(airframe) &&
         std::all_of(channels.begin(), channels.end(),
                     [](double value) { return std::abs(value) <= 1; });
}

std::vector<double> numbers_of(const Control& control) {
  if (const auto* command = std::get_if<FlightCommand>(&control))
    return {command->roll, command->airspeed, command->climb_rate};
  const auto& channels = std::get<Actuators>(control).channel;
  return {channels.begin(), channels.end()};
}

// Samples as a vehicle in level flight has them, at random of any kind.
SensorSample some_sample(RandomStream& random, const NavEstimate& nav) {
  const Time now = nav.time;
  switch (static_cast<int>(random.uniform() * 8)) {
    case 0:
      return GnssFix{now, nav.p_N, nav.v_N, 2, 4, 0.3};
    case 1:
      return AirDataSample{now, nav.v_N.norm(), nav.heading};
    case 2:
      return ImuSample{now, 0.02, Vec3::Zero(), {0, 0, -kGravity}};
    case 3:
      return BarometerSample{now, -nav.p_N.z()};
    case 4:
      return FireSample{now, 0, true};
    case 5:
      return RangeSample{now, {0, 0, 1}, random.uniform(0, 500)};
    case 6:
      return LinkSample{now};
    default:
      return HeightSample{now, 200};
  }
}

}  // namespace

Violations autopilot_violations(const Make<Autopilot>& make, const Airframe& airframe,
                                const FlightLimits& limits) {
  constexpr double kStep = 0.02;  // [s]
  Checks checks;
  RandomStream random = draws(14);
  for (const bool with_samples : {false, true}) {
    const auto one = make(), twin = make();
    NavEstimate nav = level_flight(limits);
    for (Autopilot* each : {one.get(), twin.get()}) {
      each->begin(nav, false);
      each->command({HoldCourse{nav.heading}, 300, std::nullopt});
    }
    for (int i = 0; i < 500; ++i) {
      nav.time = Time::from_seconds(kStep * i);
      const SensorSample sample = some_sample(random, nav);
      std::vector<double> numbers[2];
      for (Autopilot* each : {one.get(), twin.get()}) {
        if (with_samples) each->sense(sample);
        const Control control = each->control(nav.time, kStep);
        checks.expect(in_range(control, airframe),
                      "control() is not what the airframe takes, or not in its range");
        numbers[each == twin.get() ? 1 : 0] = numbers_of(control);
      }
      checks.expect(numbers[0] == numbers[1], "two equal ones do not fly alike");
      const NavEstimate own = one->estimate();
      checks.expect(own.p_N.allFinite() && own.v_N.allFinite(),
                    "estimate() is not finite");
      checks.expect(i > 0 || (own.p_N - nav.p_N).norm() < 1 + limits.airspeed * kStep,
                    "estimate() does not begin where begin() says");
      nav.p_N += kStep * nav.v_N;
    }
  }
  return checks.take();
}

}  // namespace skein::contract
