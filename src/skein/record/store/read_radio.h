// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/base/result.h"
#include "skein/record/figures/radio_statistics.h"
#include "skein/record/store/run_reader.h"
#include "skein/record/store/sqlite.h"

namespace skein::record {

/// Fills in what a stored run says of its messages, radios and links, and adds it to
/// statistics. The run's duration is known.
/// Fails: kBadInput for a table that is not as this version writes it.
Result<void> read_radio(Sqlite& database, RadioStatistics& statistics, StoredRun& run);

}  // namespace skein::record
