// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/role/traffic_aircraft.h"

namespace skein::environment {

/// A turn, or another climb, of an aircraft that otherwise flies straight on.
struct TurnAside {
  double from = 0;              ///< [s]
  double length = 10;           ///< [s]
  double turn_rate = 0;         ///< positive to the right [rad/s]
  std::optional<double> climb;  ///< from its begin on, up [m/s]; none: as before
};

struct StraightFlightOptions {
  double speed = 40;              ///< over ground, level part [m/s]
  double course = 0;              ///< [rad]
  double climb = 0;               ///< up [m/s]
  std::vector<TurnAside> asides;  ///< in order, one after the other
};

/// Flies straight on with an even speed, but for turns and other climbs at given times;
/// after one of them it keeps its new course and climb.
///
///   p' = v [cos c, sin c, -w/v],  c' = turn rate
///
/// solved exactly, whatever the steps of the run.
class StraightFlight final : public TrafficAircraft {
 public:
  /// @param begin  at time 0, in N [m].
  StraightFlight(const Vec3& begin, const StraightFlightOptions& options);

  void advance(const TrafficView& view) override;
  TrafficState state() const override { return state_; }

 private:
  struct Piece {
    double from = 0;  // [s]
    Vec3 p_N = Vec3::Zero();
    double course = 0, turn_rate = 0, climb = 0;
  };
  Piece after(const Piece& piece, double time) const;
  void add(double time, double turn_rate, double climb);

  double speed_;
  std::vector<Piece> pieces_;  // in order of time
  std::size_t piece_ = 0;      // of the last time
  TrafficState state_;
};

}  // namespace skein::environment
