// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "skein/role/recorder.h"

namespace skein::campaign {

/// When an aircraft counts as out of control.
struct ControlLimits {
  double stall = 0;      ///< slower than this in the air for slow_time [m/s]; 0: never
  double slow_time = 2;  ///< [s]
  double tilt = 1.3;     ///< between the body's down and down, for tilt_time [rad]
  double tilt_time = 1;  ///< [s]
  double height = 30;    ///< true, off the commanded one [m]
  double track = 60;     ///< off the route, see FlightWatch [m]
};

/// Watches one aircraft of a run for the loss of control.
///
/// Off the route: cross-track as its autopilot believes plus how wrong it is about its
/// horizontal position, while it follows a line. What hovers after its route is held
/// against the end of it.
class FlightWatch final : public Recorder {
 public:
  /// @param altitude_msl  commanded, after the first seconds of the flight [m].
  /// @param hover_at      where it shall hover once its route is done; null: it circles.
  FlightWatch(const ControlLimits& limits, EntityId aircraft, double altitude_msl,
              const Vec2* hover_at);

  void record(const Record& record) override;

  /// Adds `lost` (0 or 1), `lost_accident`, `lost_tilt`, `lost_slow`, `lost_height`,
  /// `lost_track` (why), `tilt_max_deg`, `airspeed_min_mps`, `slow_longest_s`,
  /// `height_error_max_m`, `height_error_rms_m`, `track_error_max_m`,
  /// `track_error_rms_m`.
  void add_figures(std::map<std::string, double>& figures) const;

 private:
  void take(const TruthRecord& truth);
  void take(const EstimateRecord& estimate);
  void take(const Event& event);

  struct Errors {
    double square = 0, count = 0, max = 0;
    void add(double error);
  };
  // How long something has lasted without a break.
  struct Lasting {
    double now = 0, longest = 0;
    void step(bool holds, double dt);
  };

  ControlLimits limits_;
  EntityId aircraft_;
  double altitude_msl_;
  bool hovers_ = false;
  Vec2 hover_at_ = Vec2::Zero();
  Time last_, hover_since_;
  Vec2 position_ = Vec2::Zero();
  Errors height_, track_;
  Lasting slow_, tilted_;
  double max_tilt_ = 0, min_airspeed_ = 1e9;
  bool accident_ = false;
};

}  // namespace skein::campaign
