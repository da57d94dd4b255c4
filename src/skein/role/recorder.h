// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/base/result.h"
#include "skein/base/time.h"
#include "skein/data/event/record.h"

namespace skein {

/// Keeps or watches what happens in a run. Called by the simulation thread only, in a
/// defined order; everything that is given counts for the content hash.
class Recorder {
 public:
  virtual ~Recorder() = default;

  /// Something happened. EntityRecords come before anything else about their entities,
  /// GroundObjects, and zones in force from the start, before the first step; Crossings
  /// may come later than they happened.
  virtual void record(const Record& record) = 0;

  /// Called at the end of every step; may write out what has gathered.
  /// Fails: kUnavailable when the records can no longer be written (disk full...).
  virtual Result<void> step_done(Time /*time*/) { return {}; }
};

}  // namespace skein
