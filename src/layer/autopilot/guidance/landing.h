#pragma once

#include <optional>

#include "data/autopilot.h"
#include "data/vehicle.h"
#include "layer/autopilot/demand.h"
#include "model/path/path_cursor.h"
#include "model/path/pose.h"

namespace skein::autopilot {

struct LandingOptions {
  double glide_slope = 0.09;  ///< of the approach over ground, at most [rad]
  /// And at most so much of the slope that it glides down at cruise, motor idle: the rest
  /// is left to slow down with, and for gusts.
  double idle_share = 0.6;
  double height = 40;       ///< above ground at which the approach begins [m]
  double lead_in = 4;       ///< level flight in line before it, at least [s]
  double airspeed = 1.15;   ///< of the approach, over the slowest airspeed
  double wind_share = 0.4;  ///< of the wind speed on top, up to cruise
  /// Above ground, from which sink rate counts and no longer altitude or, should it be
  /// too slow, airspeed [m].
  double sink_height = 6;
  double flare_time = 1.5;       ///< before the ground, at the sink of the approach [s]
  double touch_down_sink = 0.4;  ///< at the ground [m/s]
  /// The ground's friction over weight, which stops it; see roll_out().
  double roll_friction = 0.1;
  double too_high = 12;  ///< above the approach: one more circle [m]
  /// false: no wheels or skids; at `floor` above ground it circles the point instead.
  bool touches_down = true;
  double floor = 30;  ///< [m]
};

/// Way over ground [m] from the touch to rest. The aircraft is braked by friction mu
/// against what the wings no longer carry, and by the drag, r of the weight at the touch:
///
///   V' = -g (mu (1 - u) + r u),  u = (V / V0)^2   ->   V0^2 / 2g ln(r / mu) / (r - mu)
///
/// @param pace  V0, at the touch, over ground [m/s].
/// @param drag  r.
double roll_out(double pace, double friction, double drag);

/// To rest at a point on the ground: a shortest path into line with the approach (a
/// straight line with a glide slope that ends short of the point by flare and roll-out),
/// circles there while still too high, level flight that slows down, approach, flare,
/// roll-out.
class Landing {
 public:
  /// @param from    position and course over ground now.
  /// @param radius  of its turns over ground [m].
  void begin(const Land& command, const model::Pose& from, const Vec2& wind,
             double radius, const FlightLimits& limits, const LandingOptions& options);

  struct Step {
    FlightPhase phase = FlightPhase::kFlight;
    model::PathCursor::Place place;
    double altitude_msl = 0, climb_rate = 0;  ///< [m], [m/s]
    double airspeed = 0;  ///< of approach and flare; 0 = motor idle [m/s]
    bool done = false;    ///< at rest, or (without touch-down) at the floor
  };
  /// @param altitude_msl  estimated [m].
  /// @param height_agl    measured [m]: near the ground it counts, not the altitude.
  /// @param still         the vehicle moves too slowly to fly.
  Step step(const Vec2& p, double altitude_msl, std::optional<double> height_agl,
            double ground_speed, bool still, double dt);

  const model::PathCursor& path() const { return path_; }
  const Land& command() const { return command_; }

 private:
  void line_up(const Path& before);

  LandingOptions options_;
  Land command_;
  Vec2 fix_ = Vec2::Zero();  // start of the lead-in
  double course_ = 0;
  double radius_ = 1;
  double tangent_ = 0;  // of the glide slope
  model::PathCursor path_;
  double joined_at_ = 0;  // arc length at the lead-in's start [m]
  double touch_at_ = 0;   // arc length where the glide slope meets the ground [m]
  double rest_at_ = 0;    // arc length at the landing point [m]
  double stop_way_ = 0;   // between the two [m]
  double airspeed_ = 0;   // [m/s]
  double along_ = 0;
  bool idle_ = false;        // the motor, in the flare
  double flare_sink_ = 0;    // when the flare began [m/s]
  double flare_height_ = 0;  // [m]
  double still_for_ = 0;     // [s]
  FlightPhase phase_ = FlightPhase::kFlight;
};

}  // namespace skein::autopilot
