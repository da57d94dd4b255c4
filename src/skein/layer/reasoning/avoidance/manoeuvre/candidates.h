#pragma once

#include <span>
#include <vector>

#include "skein/data/separation.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/manoeuvred_flight.h"

namespace skein::reasoning {

/// A flight that somebody else has said it will fly.
struct KnownFlight {
  const FlightPlan* plan = nullptr;  ///< not null
  Separation separation;             ///< to be kept between it and the own aircraft
};

/// A manoeuvre that an aircraft can fly, and what it is worth to it.
struct Candidate {
  Manoeuvre manoeuvre;
  FlightPlan flight;
  double cost = 0;  ///< [s]
};

/// How good a cost is, from 1 for none to 0 from 120 s on: u = max(0, 1 - cost / 120 s).
double utility(double cost);

/// What an aircraft may do about a conflict, with the cost of each:
///
///   |arrival - the plan's| + 0.05 s/m (metres up and down more than the plan's)
///     + for each third flight that it meets 10^4 s where that is before the conflict,
///       60 s within 30 s of it, 8 s later, until `look_until`.
///
/// @param others  flights of all but the two of the conflict.
std::vector<Candidate> candidates(const ConflictOfFlight& conflict, double strength,
                                  std::span<const KnownFlight> others, double look_until);

}  // namespace skein::reasoning
