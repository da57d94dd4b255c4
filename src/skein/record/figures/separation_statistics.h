// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "skein/data/event/record.h"
#include "skein/record/figures/separation_meter.h"

namespace skein::record {

/// How well the aircraft of a run kept apart: a part of its key figures.
class SeparationStatistics {
 public:
  void truth(Time time, EntityId id, const VehicleState& state) {
    if (meter_) meter_->place(time, id, state.p_N, state.on_ground);
  }
  /// Of a message: its PlanReports say what separation their sender keeps.
  void message(const Message& message);
  void conflict(const ConflictReport& report);
  void loss(const SeparationLossRecord& loss);

  /// Adds, by the truth, `separation_losses` (encounters) and those in the air, in
  /// formation and on the ground, `violations` (pairs in the air), and where there are
  /// some `separation_loss_min_ratio` and `separation_loss_min_m` (least distance).
  ///
  /// As soon as one has said what it flies, also `separation_min_ratio` (in the air, of
  /// distance over separation), `near_collisions` (pairs), `conflicts` and
  /// `conflicts_unsolved`, as aircraft saw them, and `conflict_fixed_before_min_s`.
  /// @param aircraft  that take part: where there are less than two, the first are left
  ///                  out.
  void add_figures(std::map<std::string, double>& figures, std::size_t aircraft) const;

 private:
  struct Losses {
    double air = 0, formation = 0, ground = 0;
    double min_ratio = 1e9, min_distance = 1e9, min_ratio_in_air = 1e9;
    std::set<std::pair<EntityId, EntityId>> pairs;  // in the air
  };
  void add_losses(std::map<std::string, double>& figures) const;

  std::optional<SeparationMeter> meter_;
  Losses losses_;
  double conflicts_ = 0, unsolved_ = 0;
  std::optional<double> least_fixed_;
};

}  // namespace skein::record
