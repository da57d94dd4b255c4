// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/role/traffic_aircraft.h"

namespace skein::environment {

/// To which side a circuit turns.
enum class CircuitSide : std::uint8_t { kLeft, kRight };

struct CircuitOptions {
  double course = 0;         ///< of the first leg: of the runway [rad]
  double length = 2000;      ///< of the circuit along that leg, corners included [m]
  double width = 1000;       ///< across, corners included [m]
  double turn_radius = 250;  ///< of its four corners [m]
  CircuitSide side = CircuitSide::kLeft;
  double speed = 35;   ///< over ground, level part [m/s]
  double height = 0;   ///< above the begin; 0: a level racetrack [m]
  double climb = 4;    ///< after the first leg has begun, up [m/s]
  double descent = 3;  ///< to the end of the last leg, down [m/s]
};

/// How much longer a circuit takes to climb and descend than it is [s]; not above 0: it
/// can be flown.
double circuit_lacks(const CircuitOptions& options);

/// Flies a circuit again and again: four legs and four quarter turns, at an even speed.
/// With a height it is an aerodrome's: it climbs from the begin on, levels off at the
/// height, and descends to be back on the ground where it began (touch and go). Without
/// one it is a racetrack; as wide as two turn radii the usual one with half circles.
class CircuitFlight final : public TrafficAircraft {
 public:
  /// @param begin  of the first leg: the threshold, in N [m].
  /// @param share  of the circuit that has been flown at time 0, from 0 to 1.
  CircuitFlight(const Vec3& begin, const CircuitOptions& options, double share = 0);

  void advance(const TrafficView& view) override;
  TrafficState state() const override { return state_; }

 private:
  struct Piece {
    double from = 0;  // distance along the circuit [m]
    Vec2 begin = Vec2::Zero();
    double course = 0, curvature = 0;  // [rad/m], positive to the right
  };
  void add(double length, double curvature);

  CircuitOptions options_;
  double altitude_;  // of the begin [m]
  double flown_;     // at time 0 [m]
  std::vector<Piece> pieces_;
  double length_ = 0;  // of one circuit [m]
  TrafficState state_;
};

}  // namespace skein::environment
