// SPDX-License-Identifier: Apache-2.0
#include "skein/role/contract/checks.h"
#include "skein/role/sensor.h"

namespace skein::contract {
namespace {

constexpr Time kStepOfSensor = Time::from_ns(10'000'000);

// A vehicle in a wide turn over and beside the fire, at changing heights.
VehicleState in_flight(int step) {
  const double t = step * kStepOfSensor.seconds(), angle = 0.02 * t;
  VehicleState vehicle;
  vehicle.p_N << 300 * geo::unit(angle), -150 + 20 * math::sin(0.1 * t);
  vehicle.v_N << 6 * geo::unit(angle + geo::kPi / 2), -2 * math::cos(0.1 * t);
  vehicle.q_NB = geo::from_euler({0.1, 0.02, angle + geo::kPi / 2});
  vehicle.airspeed = 6;
  vehicle.energy = {.charge = 0.6, .voltage = 14, .power = 90};
  return vehicle;
}

bool same(const SensorSample& a, const SensorSample& b) {
  return a.index() == b.index() && time_of(a) == time_of(b) &&
         numbers_of(a) == numbers_of(b);
}

}  // namespace

Violations sensor_violations(const Make<Sensor>& make) {
  constexpr int kSteps = 2000;
  Checks checks;
  const auto sensor = make(), twin = make();
  const RollingTerrain terrain;
  GrowingDisc fire(280, 1);
  const Phenomenon* const phenomena[] = {&fire};
  const std::vector<VisibleObject> objects = {{1, ObjectClass::kVehicle, {290, 20}}};
  const std::vector<VisibleAircraft> aircraft = {
      {{300, 40, -160}, {20, 5, 1}, 7, {true, true, true}, {}},
      {{310, 30, -150}, {6, 0, 0}, 2, {}, EntityId{2}},
      {{300, 0, -150},
       {6, 0, 0},
       1,
       {true, true, true},
       EntityId{1}}};  // itself, perhaps
  const bool payload = sensor->payload();
  Air air;
  air.wind_N = {3, -1, 0};
  for (int i = 0; i < kSteps; ++i) {
    const Time now = kStepOfSensor * i;
    fire.advance(now);
    const int looks = fire.looks();
    const VehicleState vehicle = in_flight(i);
    const SensorView view{now,       vehicle, air,          terrain,
                          phenomena, objects, std::nullopt, aircraft};
    const SensorSample others = HeightSample{now, 1.0 * i};  // said before
    std::vector<SensorSample> said = {others}, twin_said = said;
    sensor->sample(view, said);
    checks.expect(
        payload || fire.looks() == looks,
        "it looks at the fire, but payload() says that it serves the autopilot");
    twin->sample(view, twin_said);
    checks.expect(!said.empty() && same(said.front(), others),
                  "sample() changes what others have said before");
    for (std::size_t k = 1; k < said.size(); ++k) {
      checks.expect(time_of(said[k]) <= now, "a sample is from the future");
      checks.expect(all_finite(numbers_of(said[k])), "a sample is not finite");
    }
    checks.expect(
        std::equal(said.begin(), said.end(), twin_said.begin(), twin_said.end(), same),
        "two equal ones do not say the same");
  }
  checks.expect(sensor->payload() == payload, "payload() changes");
  return checks.take();
}

}  // namespace skein::contract
