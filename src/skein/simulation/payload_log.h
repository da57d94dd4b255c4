// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "skein/data/vehicle/payload.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/role/recorder.h"

namespace skein::simulation {

/// Records what one payload sensor says in one step.
///
/// Places are those that the aircraft believes: what its autopilot estimates, moved back
/// at its velocity to when the sample was taken. Samples that follow one another and are
/// of one time make one scan. Other samples than those of cameras and ranging sensors are
/// passed over.
///
/// @param sensor  which of the aircraft's payload sensors, from 0.
/// @param nav     what its autopilot believes now.
void log_payload(std::span<const SensorSample> samples, EntityId aircraft,
                 std::uint32_t sensor, const NavEstimate& nav, Recorder& recorder);

}  // namespace skein::simulation
