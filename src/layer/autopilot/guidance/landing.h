#pragma once

#include <optional>

#include "data/autopilot.h"
#include "layer/autopilot/demand.h"
#include "model/path/path_cursor.h"
#include "model/path/pose.h"

namespace skein::autopilot {

struct LandingOptions {
  double glide_slope = 0.09;     ///< of the approach [rad]
  double height = 40;            ///< above ground at which the approach begins [m]
  double lead_in = 4;            ///< level flight in line before it [s]
  double airspeed = 1.1;         ///< of the approach, over the slowest airspeed
  double flare_height = 4;       ///< above ground [m]
  double touch_down_sink = 0.4;  ///< at the ground [m/s]
  double too_high = 12;          ///< above the approach: one more circle [m]
  /// false: no wheels or skids; at `floor` above ground it circles the point instead.
  bool touches_down = true;
  double floor = 30;  ///< [m]
};

/// Down to a point on the ground: a shortest path into line with the approach (a
/// straight line with a glide slope), circles there while still too high, approach,
/// flare, roll-out.
class Landing {
 public:
  /// @param from    position and course over ground now.
  /// @param radius  of its turns over ground [m].
  void begin(const Land& command, const model::Pose& from, const Vec2& wind,
             double ground_speed, double radius, const LandingOptions& options);

  struct Step {
    FlightPhase phase = FlightPhase::kFlight;
    model::PathCursor::Place place;
    double altitude_msl = 0, climb_rate = 0;  ///< [m], [m/s]
    bool done = false;  ///< at rest, or (without touch-down) at the floor
  };
  /// @param height  above the landing point's ground, measured or by altitude [m].
  /// @param still   the vehicle moves too slowly to fly.
  Step step(const Vec2& p, double height, double ground_speed, bool still, double dt);

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
  double touch_at_ = 0;   // arc length at the landing point [m]
  double along_ = 0;
  double flare_sink_ = 0;  // when the flare began [m/s]
  double still_for_ = 0;   // [s]
  FlightPhase phase_ = FlightPhase::kFlight;
};

}  // namespace skein::autopilot
