// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/team/separation_message.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein::reasoning {

/// What an aircraft can fly, as it says it to others.
FlownLimits said_limits(const FlightLimits& limits);

/// The limits that its flights are made with, by itself too: with what was said all make
/// the same flights.
FlightLimits limits_of(const FlownLimits& said);

/// Whether there can be an aircraft like that.
bool are_possible(const FlownLimits& said);

}  // namespace skein::reasoning
