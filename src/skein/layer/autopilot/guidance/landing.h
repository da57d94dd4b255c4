// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/layer/autopilot/demand.h"
#include "skein/model/path/path_cursor.h"
#include "skein/model/path/pose.h"

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
  /// The nose is turned along the course below this height, early enough for the rudder
  /// and too late to drift [m]; 0: never. For wheels: a belly slides straighter with its
  /// nose in the wind.
  double align_height = 0.35;
  /// The ground's friction over weight, which stops it; see roll_out().
  double roll_friction = 0.1;
  double brake_friction = 0;  ///< on top at full brake; 0 = no brakes
  /// Airspeed at which it lifts off in the attitude in which it stands [m/s]; 0: the
  /// slowest.
  double lift_off = 0;
  double brake_share = 0.25;  ///< that is planned with; the rest is for touching late
  double too_high = 12;       ///< above the approach: one more circle [m]
  /// false: no wheels or skids; at `floor` above ground it circles the point instead.
  bool touches_down = true;
  double floor = 30;  ///< [m]
};

/// What stops an aircraft on the ground.
struct Stopping {
  double friction = 0.1;  ///< mu, over what the wings do not carry
  double drag = 0.1;      ///< r, over weight at the touch
  double lift_off = 15;   ///< V_l, airspeed at which the wings carry all, standing [m/s]
};

/// Distance over ground [m] from the touch to rest:
///
///   V' = -g (mu max(1 - (V + w)^2 / V_l^2, 0) + r (V + w)^2 / V_a^2)
///
/// by Simpson's rule over the speed; without wind and with V_l = V_a it is
/// V_a^2 / 2g ln(r / mu) / (r - mu).
/// @param airspeed   V_a, at the touch [m/s].
/// @param head_wind  w, below V_a [m/s].
double roll_out(double airspeed, double head_wind, const Stopping& stopping);

/// To rest at a point on the ground: a shortest path into line with the approach (a
/// straight line with a glide slope that ends short of the point by flare and roll-out),
/// circles there while still too high, level flight that slows down, approach, flare,
/// roll-out. Brakes make the roll-out end at the point, if there are any.
class Landing {
 public:
  /// @param from    position and course over ground now.
  /// @param radius  of its turns over ground [m].
  void begin(const Land& command, const model::Pose& from, const Vec2& wind,
             double radius, const FlightLimits& limits, const LandingOptions& options);

  /// The own motion.
  struct View {
    Vec2 p = Vec2::Zero();    ///< [m]
    double altitude_msl = 0;  ///< estimated [m]
    /// Measured [m]: near the ground it counts, not the altitude.
    std::optional<double> height_agl = std::nullopt;
    double climb_rate = 0;    ///< [m/s]
    double ground_speed = 0;  ///< [m/s]
    bool still = false;       ///< it moves too slowly to fly
  };
  struct Step {
    FlightPhase phase = FlightPhase::kFlight;
    model::PathCursor::Place place;
    double altitude_msl = 0, climb_rate = 0;  ///< [m], [m/s]
    double airspeed = 0;  ///< of approach and flare; 0 = motor idle [m/s]
    bool aligns = false;  ///< the nose is to point along the course now
    double braking = 0;   ///< of the roll-out [m/s^2]
    bool done = false;    ///< at rest, or (without touch-down) at the floor
  };
  Step step(const View& now, double dt);

  const model::PathCursor& path() const { return path_; }
  const Land& command() const { return command_; }
  double course() const { return course_; }  ///< of the approach [rad]

 private:
  void line_up(const Path& before);
  double height_of(const View& now) const;
  void descend(const View& now, double height, Step& out);
  void feel_ground(const View& now, double height, double dt);

  LandingOptions options_;
  Land command_;
  Vec2 fix_ = Vec2::Zero();  // start of the lead-in
  double course_ = 0;
  double radius_ = 1;
  double tangent_ = 0;  // of the glide slope
  model::PathCursor path_;
  double joined_at_ = 0;      // arc length at the lead-in's start [m]
  double touch_at_ = 0;       // arc length where the glide slope meets the ground [m]
  double rest_at_ = 0;        // arc length at the landing point [m]
  double stop_distance_ = 0;  // between the two [m]
  double airspeed_ = 0;       // [m/s]
  double along_ = 0;
  bool idle_ = false;        // the motor, in the flare
  double flare_sink_ = 0;    // when the flare began [m/s]
  double flare_height_ = 0;  // [m]
  double still_for_ = 0;     // [s]
  double felt_for_ = 0;      // the ground, in the flare [s]
  FlightPhase phase_ = FlightPhase::kFlight;
};

}  // namespace skein::autopilot
