// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "skein/role/wind_field.h"

namespace skein::simulation {

/// The scenario's mean wind, and what a command has put on top of it.
class CommandedWind final : public WindField {
 public:
  /// @param scenario  never null.
  explicit CommandedWind(std::unique_ptr<WindField> scenario)
      : scenario_(std::move(scenario)) {}

  Vec3 wind(const Vec3& p_N, Time time) const override {
    return scenario_->wind(p_N, time) + added_N_;
  }

  /// From now on the air moves by this much more [m/s]. Not while others ask.
  void set_added(const Vec3& added_N) { added_N_ = added_N; }

 private:
  std::unique_ptr<WindField> scenario_;
  Vec3 added_N_ = Vec3::Zero();
};

}  // namespace skein::simulation
