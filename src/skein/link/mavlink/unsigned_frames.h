// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/link/mavlink/frame.h"

namespace skein::mavlink {

/// What frames that are not signed may do where they are taken in.
enum class UnsignedFrames {
  kAll,        ///< whatever signed ones may
  kTelemetry,  ///< report and ask, but not command (changes_nothing())
  kNothing,    ///< they do not count
};

/// Whether a frame reports or asks only: telemetry, heartbeats, clocks, what a ground
/// station asks for to show a vehicle, its parameters and its missions. False for
/// commands, setpoints, sticks, parameters that are set, missions that are uploaded, file
/// transfer, sensor data that stand for a vehicle's own, and for what is not known here.
bool changes_nothing(const Frame& frame);

}  // namespace skein::mavlink
