// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/base/random.h"
#include "skein/geo/vec.h"
#include "skein/model/well_clear/alerting.h"

namespace skein::model::test {

/// Aircraft at random, on a grid of 2^-6 m and m/s so that quarter turns and moves do not
/// round.
class RandomEncounter {
 public:
  explicit RandomEncounter(int seed)
      : random_(static_cast<std::uint64_t>(seed), 0, Purpose::kTest) {}

  double uniform() { return random_.uniform(); }

  AircraftMotion aircraft(double reach, double height) {
    const double course = 2 * geo::kPi * uniform(), speed = 12 + 20 * uniform();
    const auto grid = [](double v) { return std::round(64 * v) / 64; };
    const auto either = [&](double size) { return size * (2 * uniform() - 1); };
    AircraftMotion m;
    m.p_N = {grid(either(reach)), grid(either(reach)), grid(-300 + either(height))};
    m.v_N = {grid(speed * math::cos(course)), grid(speed * math::sin(course)),
             uniform() < 0.5 ? 0.0 : grid(either(2))};
    return m;
  }

  std::vector<Intruder> intruders(int count, const WellClearConfiguration& c) {
    std::vector<Intruder> all;
    for (int i = 0; i < count; ++i)
      all.push_back(
          {aircraft(2500, 150),
           static_cast<std::size_t>(uniform() * static_cast<double>(c.alerters.size())),
           0, 0});
    return all;
  }

 private:
  RandomStream random_;
};

}  // namespace skein::model::test
