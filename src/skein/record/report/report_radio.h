// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "skein/record/store/run_reader.h"

namespace skein::record {

/// What the page is told of radios: `time_s`, `load_mean`, `load_max` packed, `radios`
/// and `links` (see RunData in web/report/data.ts). Null where the radio has no medium.
nlohmann::ordered_json radio_json(const StoredRun& run);

}  // namespace skein::record
