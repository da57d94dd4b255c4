#pragma once

#include "data/monitoring.h"

namespace skein::monitoring {

/// Time [s] that the aircraft needs to reach `place`, with its turn radius and in the
/// wind it believes in; infinite where that wind keeps it away. Any course on arrival.
double time_to_go(const AircraftStatus& aircraft, const Vec2& place);

}  // namespace skein::monitoring
