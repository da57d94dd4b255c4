// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/scenario/scenario.h"

namespace skein::assemble {

struct RadioParts;

/// How often aircraft say what they say again and again: the team's protocol and where
/// they are.
struct RoutinePeriods {
  double query = 1;  ///< TeamTimes::query_period [s]
  double place = 1;  ///< SeparationOptions::place_period [s]
};

/// As often as the radio of a scenario has room for, the same for all of it:
///
///   period = max(1 s, 1 s  n b / (s r)),  at most 20 s and 5 s
///
/// with n aircraft, b = 223 byte/s that each says at periods of one second (measured in
/// scenarios/team-of-ten.yaml), the shared rate r and the share s = 0.2 of it that is for
/// this: with 0.4 ten aircraft still fill the air of `xbee-digimesh`. Valid: all hear
/// each other, and each takes part in both.
/// @param parts  of radios
RoutinePeriods routine_periods(const scenario::Scenario& scenario,
                               const RadioParts& parts);

/// What all radios together may send [bit/s]; 0: they share nothing, or it is not known
/// of the kind.
double shared_rate(const scenario::Choice& radio, const RadioParts& parts);

}  // namespace skein::assemble
