// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein {

/// Room around the planned position that belongs to a plan: how far its execution may be
/// off. Along the path it is measured in time, across it in metres; ahead of the plan and
/// behind it may differ.
struct SafetyZone {
  double ahead = 5;    ///< of the plan [s]
  double behind = 10;  ///< of the plan [s]
  double across = 30;  ///< off the path, to either side [m]
};

/// How far the execution of a plan is off.
struct ExecutionError {
  double time = 0;    ///< behind the plan, negative = ahead [s]
  double across = 0;  ///< off the path, right positive [m]
};

/// Whether an error lies within the zone.
constexpr bool within(const SafetyZone& zone, const ExecutionError& error) {
  return error.time <= zone.behind && -error.time <= zone.ahead &&
         error.across <= zone.across && -error.across <= zone.across;
}

}  // namespace skein
