// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "skein/base/result.h"
#include "skein/layer/hmi/serve/live_feed.h"
#include "skein/record/store/record_stream.h"

namespace skein::serve {

/// Shows a stored run again to those who watch, who may pause it, go to other times and
/// change its speed; ends when `stop` says so. A run that is over stands at its end.
///
/// @param speed  recorded over wall time.
/// Fails: when the records cannot be read.
Result<void> play_again(record::RecordStream& recorded, hmi::LiveFeed& feed, double speed,
                        const std::atomic<bool>& stop);

}  // namespace skein::serve
