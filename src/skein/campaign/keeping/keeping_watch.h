// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>

#include "skein/role/recorder.h"

namespace skein::campaign {

/// What one aircraft is commanded to track.
struct Keeping {
  EntityId aircraft;
  double altitude_msl = 0;        ///< [m]
  double airspeed = 0;            ///< [m/s]
  std::optional<Vec2> hovers_at;  ///< [m]; none: it follows a route
  double settling = 20;           ///< after the start, not counted [s]
};

/// Measures how far one aircraft truly is from what it is commanded to track.
///
/// Across its route: the cross-track distance that its autopilot believes, corrected by
/// the error of its believed position across the leg. A turn is where the leg's direction
/// turns by more than 2 degrees a second.
class KeepingWatch final : public Recorder {
 public:
  explicit KeepingWatch(const Keeping& keeping) : keeping_(keeping) {}

  void record(const Record& record) override;

  /// Adds `straights_rms_m`, `turns_rms_m`, `believed_rms_m` (of routes),
  /// `height_max_m`, `airspeed_rms_mps`, `hover_max_m`, `hover_believed_max_m`: those
  /// that have been measured; and `accident` (0 or 1).
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  void take(const TruthRecord& truth);
  void take(const EstimateRecord& record);
  void take(const Event& event);

  struct Errors {
    double square = 0, count = 0, max = 0;
    void add(double error);
  };

  void keep_to_route(const NavEstimate& estimate, const AutopilotStatus& status);

  Keeping keeping_;
  Time now_;
  double dt_ = 0;
  VehicleState state_;
  Vec2 along_ = Vec2::Zero();
  Errors straights_, turns_, believed_, height_, airspeed_, hover_, hover_believed_;
  bool accident_ = false;
};

}  // namespace skein::campaign
