// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "skein/base/random.h"
#include "skein/data/vehicle/sensing.h"
#include "skein/geo/vec.h"
#include "skein/role/contract/contract.h"
#include "skein/role/phenomenon.h"
#include "skein/role/terrain.h"

// What the suites share.

namespace skein::contract {

/// Gathers violations; each sentence once.
class Checks {
 public:
  void expect(bool holds, std::string_view rule) {
    if (holds) return;
    if (std::find(found_.begin(), found_.end(), rule) == found_.end())
      found_.emplace_back(rule);
  }
  Violations take() { return std::move(found_); }

 private:
  Violations found_;
};

/// Draws of a suite.
inline RandomStream draws(std::uint32_t suite) {
  return RandomStream(2018, suite, Purpose::kTest);
}

inline Vec2 place_within(RandomStream& random, double reach) {
  const double north = random.uniform(-reach, reach);
  return {north, random.uniform(-reach, reach)};
}

/// Every number of what a sensor says, in order; the time is not among them.
std::vector<double> numbers_of(const SensorSample& sample);
Time time_of(const SensorSample& sample);

bool all_finite(const std::vector<double>& numbers);
bool is_finite(const VehicleState& state);

/// Ground that rises and falls gently.
class RollingTerrain final : public Terrain {
 public:
  double elevation_msl(const Vec2& p) const override;
  Vec2 gradient(const Vec2& p) const override;
};

/// A disc about the origin that grows evenly; counts how often it is looked at.
class GrowingDisc final : public Phenomenon {
 public:
  GrowingDisc(double radius, double rate);
  void advance(Time time) override;
  bool inside(const Vec2& p) const override;
  const geo::Region& region() const override;
  int looks() const { return looks_; }

 private:
  double start_, rate_, radius_;
  geo::Region region_;
  mutable int looks_ = 0;
};

}  // namespace skein::contract
