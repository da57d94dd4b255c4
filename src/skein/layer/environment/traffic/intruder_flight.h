// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/environment/traffic/piloted_motion.h"

namespace skein::environment {

struct IntruderOptions {
  double slowest = 15, fastest = 60;  ///< over ground [m/s]
  double course = 0;                  ///< at the start [rad]
  double distance = 0;  ///< that it keeps behind the other; 0: it meets it [m]
  double above = 0;     ///< above the other [m]
  double lead = 10;     ///< it aims so far ahead of the other, at most [s]
  PilotedLimits limits;
};

/// An intruder that follows an aircraft, whatever that one does: it aims at where the
/// other is going to be, and stays behind it once it is there.
class IntruderFlight final : public TrafficAircraft {
 public:
  /// @param begin  at time 0, in N [m].
  /// @param whom   it follows; while that one is not there it flies straight on.
  IntruderFlight(const Vec3& begin, const IntruderOptions& options, EntityId whom);

  void advance(const TrafficView& view) override;
  TrafficState state() const override { return state_; }

 private:
  void aim(const NoticedAircraft& other);

  IntruderOptions options_;
  EntityId whom_;
  PilotedMotion motion_;
  PilotedSetpoint setpoint_;
  Time now_;
  TrafficState state_;
};

}  // namespace skein::environment
