// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <variant>
#include <vector>

#include "skein/role/sensor.h"

namespace skein::sensory {

class LevelGround final : public Terrain {
 public:
  explicit LevelGround(double elevation = 100) : elevation_(elevation) {}
  double elevation_msl(const Vec2&) const override { return elevation_; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }

 private:
  double elevation_;
};

inline Time ms(std::int64_t n) {
  return Time::from_ns(n * 1'000'000);
}

/// A vehicle over level ground, asked at even times.
struct TestWorld {
  LevelGround ground;
  VehicleState vehicle;
  Air air;
  std::vector<VisibleObject> objects;
  std::vector<VisibleAircraft> aircraft;

  SensorView at(Time now) const { return at(now, ground); }
  SensorView at(Time now, const Terrain& terrain) const {
    return {now, vehicle, air, terrain, {}, objects, std::nullopt, aircraft};
  }

  /// What comes out at 0, step, 2 step, ..., (steps - 1) step.
  std::vector<SensorSample> run(Sensor& sensor, Time step, int steps) const {
    std::vector<SensorSample> out;
    for (int i = 0; i < steps; ++i) sensor.sample(at(step * i), out);
    return out;
  }
};

/// The samples of one kind in `all`.
template <class Sample>
std::vector<Sample> only(const std::vector<SensorSample>& all) {
  std::vector<Sample> some;
  for (const SensorSample& sample : all)
    if (const auto* s = std::get_if<Sample>(&sample)) some.push_back(*s);
  return some;
}

/// Mean and variance of numbers.
struct Moments {
  double mean = 0, variance = 0;
};
inline Moments moments(const std::vector<double>& x) {
  Moments m;
  const auto n = static_cast<double>(x.size());
  for (const double v : x) m.mean += v / n;
  for (const double v : x) m.variance += (v - m.mean) * (v - m.mean) / n;
  return m;
}

}  // namespace skein::sensory
