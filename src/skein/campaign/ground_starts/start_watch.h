// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "skein/role/recorder.h"

namespace skein::campaign {

/// When a start from the ground counts as lost.
struct StartLimits {
  double altitude_msl = 0;       ///< commanded [m]
  double arrival = 10;           ///< below it, still counted as reached [m]
  double climb_time = 120;       ///< from the start of the run to that altitude [s]
  double tilt = 1.3;             ///< true, between the body's down and down [rad]
  double attitude_error = 0.35;  ///< of the believed down [rad]
  double height_error = 25;      ///< of the believed altitude [m]
  double time = 1;               ///< for which tilt or an error must last [s]
};

/// Watches one aircraft from the ground to its altitude and on: an accident, a belief
/// that has left the truth, a failsafe or a start that does not get off the ground are
/// losses.
class StartWatch final : public Recorder {
 public:
  StartWatch(const StartLimits& limits, EntityId aircraft)
      : limits_(limits), aircraft_(aircraft) {}

  void record(const Record& record) override;

  /// Adds `lost` (0 or 1), why: `lost_accident`, `lost_tilt`, `lost_belief`,
  /// `lost_failsafe`, `lost_climb`; `climb_time_s` (when the altitude was reached),
  /// `tilt_max_deg`, `attitude_error_max_deg`, `believed_height_error_max_m`.
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  void take(const TruthRecord& truth);
  void take(const EstimateRecord& record);
  void take(const Event& event);

  // How long something has lasted without a break.
  struct Lasting {
    double now = 0, longest = 0;
    void step(bool holds, double dt) {
      now = holds ? now + dt : 0;
      if (now > longest) longest = now;
    }
  };

  StartLimits limits_;
  EntityId aircraft_;
  Time last_;
  double dt_ = 0;
  VehicleState state_;
  Lasting tilted_, misled_;
  double max_tilt_ = 0, max_attitude_error_ = 0, max_height_error_ = 0;
  double climbed_at_ = -1;
  bool accident_ = false, failsafe_ = false;
};

}  // namespace skein::campaign
