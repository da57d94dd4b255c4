// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "skein/base/result.h"
#include "skein/record/store/rows.h"
#include "skein/record/store/sqlite.h"
#include "skein/record/store/summary.h"

namespace skein::record {

inline constexpr double kMaxAfterEnd = 1;  ///< of a record, after its run's end [s]

/// What a run database says of its run as a whole.
/// Fails: what the database says.
Result<RunInfo> read_info(Sqlite& database);

/// The ground as it was stored for maps; null: it was not, or makes no sense.
/// Fails: what the database says.
Result<std::unique_ptr<TerrainRow>> read_terrain(Sqlite& database);

}  // namespace skein::record
