#pragma once

#include <string>

#include "data/vehicle.h"

namespace skein::planning {

/// What is wrong with the limits of an aircraft as planners of tasks use them (airspeed,
/// turn radius, climb and sink rate); empty when nothing is.
std::string limits_fault(const FlightLimits& limits);

/// The same for the range of airspeeds: 0 <= slowest <= airspeed <= fastest.
std::string speeds_fault(const FlightLimits& limits);

/// Words for a wind that no plan can be made in.
std::string too_strong(double wind, double airspeed);

}  // namespace skein::planning
