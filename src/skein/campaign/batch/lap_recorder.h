// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "skein/role/recorder.h"

namespace skein::campaign {

/// One moment of a flight along a route.
struct LapSample {
  double time = 0;               ///< [s]
  int lap = 0;                   ///< from 0
  Vec2 position = Vec2::Zero();  ///< true [m]
  Vec2 on_route = Vec2::Zero();  ///< the point of the route nearest to it [m]
  double cross_track = 0;        ///< true distance from the route, right positive [m]
  double estimated = 0;          ///< the same, as the autopilot believes it [m]
  double height_error = 0;       ///< true altitude less the demanded one [m]
  double airspeed_error = 0;     ///< true airspeed less the demanded one [m/s]
  double effort = 0;  ///< root of the summed squares of all surface rates [rad/s]
};

/// Listens to a run and keeps how its first aircraft, a fixed wing, flew a route: in the
/// mode auto, as circles flown in guided mode are no route.
///
/// The true distance from the route is the believed one corrected by the error of the
/// believed position:
///
///   e = e_hat + t x (p - v dt - p_hat),   dt = time now - time of the estimate
///
/// with t the tangent of the route: exact on straights, in a turn of radius R short of
/// |p - p_hat|^2 / 2R.
class LapRecorder final : public Recorder {
 public:
  void record(const Record& record) override;

  const std::vector<LapSample>& samples() const { return samples_; }
  /// Laps that were completed.
  int laps() const { return laps_; }

  /// Adds `laps` and, for each completed lap k from 1 on, `lapK_` with each of
  /// kLapFigures.
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  void take(const TruthRecord& truth);
  void take(const EstimateRecord& estimate);

  std::optional<EntityId> aircraft_;
  VehicleState now_, before_;
  Time time_, time_before_;
  bool fresh_ = true;
  int laps_ = 0;
  std::vector<LapSample> samples_;
};

/// What is measured of each lap.
struct LapFigure {
  const char* name;     ///< in files, with its unit
  const char* heading;  ///< for people
  int digits;           ///< after the point, for people
};
inline constexpr LapFigure kLapFigures[] = {
    {"cross_track_rms_m", "cross-track RMS [m]", 2},
    {"cross_track_p95_m", "cross-track 95 % [m]", 2},
    {"believed_cross_track_rms_m", "believed RMS [m]", 2},
    {"believed_cross_track_p95_m", "believed 95 % [m]", 2},
    {"height_rms_m", "height RMS [m]", 2},
    {"airspeed_rms_mps", "airspeed RMS [m/s]", 2},
    {"effort_deg_per_s", "effort [deg/s]", 1},
    {"time_s", "time [s]", 1},
};

}  // namespace skein::campaign
