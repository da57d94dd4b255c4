// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/base/time.h"
#include "skein/data/vehicle/vehicle_request.h"
#include "skein/geo/local_frame.h"
#include "skein/link/mavlink/messages.h"

namespace skein::autopilot_client {

/// What stands around a vehicle, as autopilots are told of it: centimetres, in the body's
/// frame, one more than the largest where nothing is in range. Ranges end at 650 m.
mavlink::ObstacleDistance coded(const ObstacleDistances& obstacles, Time now);

/// A position in place of a receiver's, with the accuracies that belong to it. The
/// altitude is above mean sea level.
/// @param unix_ns  since 1970, of the position.
mavlink::GpsInput coded(const PositionFix& fix, const geo::LocalFrame& frame,
                        std::int64_t unix_ns);

}  // namespace skein::autopilot_client
