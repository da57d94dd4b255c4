// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/data/vehicle/vehicle.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/flight_check.h"
#include "skein/layer/reasoning/avoidance/separator/separator.h"
#include "skein/layer/reasoning/trajectory/flight_context.h"
#include "skein/layer/reasoning/trajectory/flight_intent.h"

namespace skein::reasoning {

/// Whose circles are looked at, and what is known of the others.
struct HoldSituation {
  Time now;
  const FlightContext& context;  ///< with the limits that plans are made with
  const Separator& separator;
  double duration = 150;  ///< of the flights that are looked at [s]
  /// The circle that was flown, or said, until now: flown on if it is free.
  std::optional<Circling> before = {};
};

/// The circle that an aircraft flies where it is asked to circle: the first of these
/// whose flight comes too near to nobody's and whose circle is apart from all in which
/// others stay.
///
///   the circle that is asked for
///   the same, one or two levels higher or lower
///   others around it, from one to five radii away, in eight directions
///   the nearer of these, a level higher or lower
///
/// Where there is none, the first whose flight is free for as long as flights are known,
/// else the first whose circle is apart, else the circle that is asked for: what comes
/// too near then is solved as any conflict.
///
/// @param from   where and how the aircraft flies when it begins.
/// @param begin  when that is [s].
/// @param check  of zones and ground.
Circling place_to_hold(const Circling& requested, const NavEstimate& from, double begin,
                       const HoldSituation& situation, FlightCheck& check);

}  // namespace skein::reasoning
