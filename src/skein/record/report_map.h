#pragma once

#include <nlohmann/json_fwd.hpp>

#include "skein/record/run_reader.h"

namespace skein::record {

/// What the report's map shows of a run, packed as web/report/data.ts describes: places
/// in 16 bits over the run's extent, rings without the points that do not matter.
/// Null when the run has neither positions nor perimeters.
nlohmann::ordered_json map_json(const StoredRun& run);

}  // namespace skein::record
