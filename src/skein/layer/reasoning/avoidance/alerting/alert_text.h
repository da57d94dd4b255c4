// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "skein/data/traffic/alert.h"

namespace skein::reasoning {

/// An alert as a controller would say it: "traffic, 2 o'clock, 1.2 km, 40 m above, turn
/// right 080"; of what is to be flown the track, else the vertical speed, else the speed.
///
/// @param track           the own one, over ground [rad].
/// @param vertical_speed  the own one, up [m/s].
std::string spoken(const TrafficAlert& alert, double track, double vertical_speed);

}  // namespace skein::reasoning
