#pragma once

#include <map>
#include <optional>
#include <string>

#include "skein/data/record.h"
#include "skein/record/separation_meter.h"

namespace skein::record {

/// How well the aircraft of a run kept apart: the part of its key figures that is there
/// as soon as one says what it flies.
class SeparationStatistics {
 public:
  void truth(Time time, EntityId id, const VehicleState& state) {
    if (meter_) meter_->place(time, id, state.p_N, state.on_ground);
  }
  /// Of a message: its PlanReports say what separation is kept.
  void message(const Message& message);
  void conflict(const ConflictReport& report);

  /// Adds `separation_min_ratio` (least distance over separation), `violations` and
  /// `near_collisions` (pairs), all by the truth; `conflicts` and
  /// `conflicts_unsolved`, as aircraft saw them, and `conflict_fixed_before_min_s`.
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  std::optional<SeparationMeter> meter_;
  double conflicts_ = 0, unsolved_ = 0;
  std::optional<double> least_fixed_;
};

}  // namespace skein::record
