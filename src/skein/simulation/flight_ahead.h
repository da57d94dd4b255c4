// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "skein/base/time.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/flight_path.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein::simulation {

/// How an aircraft will fly by what it is commanded, said whenever that changes: whoever
/// commands it, an agent on board or another program.
///
/// Plans, paths and waypoints lead from here along their points; a course straight on, a
/// circle once around. Turns from one to the next are left out, and of plans what lies
/// within two metres of a straight piece. A circle or a place that moves by less than ten
/// metres is the same. A course that is commanded anew at each step is
/// said again every ten seconds, or when it has turned by more than fifteen degrees; two
/// flights are at least two seconds apart.
class FlightAhead {
 public:
  /// To be called at each step of the agent.
  /// @param command  the one of this step; null: none.
  /// @returns  the path from here, if it is another one than was said last.
  std::optional<FlightPath> step(const AutopilotCommand* command, const NavEstimate& nav,
                                 Time now);

 private:
  // What tells a flight from another one of its kind.
  struct Mark {
    std::size_t kind = 0;
    double a = 0, b = 0, c = 0;  // a place, a time, an altitude, a course...
    bool operator==(const Mark&) const = default;
  };
  static Mark mark_of(const AutopilotCommand& command);
  bool is_another(const AutopilotCommand& command, const Mark& mark, Time now) const;

  std::optional<Mark> said_;
  Time said_at_;
  std::optional<AutopilotCommand> waiting_;  // to be said: too soon after the last
};

}  // namespace skein::simulation
