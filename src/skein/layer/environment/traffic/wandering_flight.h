// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/base/random.h"
#include "skein/layer/environment/traffic/piloted_motion.h"

namespace skein::environment {

struct WanderingOptions {
  double slowest = 25, fastest = 60;   ///< over ground [m/s]
  double radius = 5000;                ///< of the disc that its waypoints lie in [m]
  double lowest = 100, highest = 600;  ///< altitudes, above mean sea level [m]
  double mean_leg = 120;               ///< time between two changes of mind, mean [s]
  PilotedLimits limits;
};

/// A pilot that ignores everybody: flies towards random waypoints around where it began,
/// turns, climbs and changes its speed on the way whenever it likes.
///
/// Moves in steps of its own, in between straight on: the same flight whatever the steps
/// of the run.
class WanderingFlight final : public TrafficAircraft {
 public:
  /// @param begin    at time 0, in N [m].
  /// @param traffic  its number: each has a random stream of its own.
  WanderingFlight(const Vec3& begin, const WanderingOptions& options, std::uint64_t seed,
                  std::uint32_t traffic);

  void advance(const TrafficView& view) override;
  TrafficState state() const override { return state_; }

 private:
  void decide();
  void step();

  WanderingOptions options_;
  RandomStream random_;
  Vec2 home_, waypoint_ = Vec2::Zero();
  PilotedSetpoint setpoint_;
  PilotedMotion motion_;
  double now_ = 0, leg_end_ = 0;  // [s]
  std::int64_t steps_ = 0;        // that motion_ is ahead of time 0
  Vec3 from_;                     // where the last step began
  TrafficState state_;
};

}  // namespace skein::environment
