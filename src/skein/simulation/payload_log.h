#pragma once

#include <span>

#include "skein/data/payload.h"
#include "skein/role/autopilot.h"
#include "skein/role/recorder.h"

namespace skein::simulation {

/// Tells a recorder what one payload sensor says in one step.
///
/// Places are those that the aircraft believes: what its autopilot estimates, moved back
/// at its velocity to when the sample was taken. Samples that follow one another and are
/// of one time make one scan. Other samples than those of cameras and ranging sensors are
/// passed over.
///
/// @param sensor  which of the aircraft's payload sensors, from 0.
void log_payload(std::span<const SensorSample> samples, EntityId aircraft,
                 std::uint32_t sensor, const Autopilot& autopilot, Recorder& recorder);

}  // namespace skein::simulation
