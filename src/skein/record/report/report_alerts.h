// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "skein/record/store/run_reader.h"

namespace skein::record {

/// What a run's page shows of alerts: `alerts` and `recommendations` as they were
/// recorded, and `bands`, by aircraft rows of
///
///   time, level, advised track, speed, vertical speed, recovery, tracks, speeds,
///   vertical speeds, altitudes
///
/// in degrees and SI, null where there is none; the last four are lists of from, to and
/// the number of the region, one after the other.
nlohmann::ordered_json alerts_json(const StoredRun& run);

}  // namespace skein::record
