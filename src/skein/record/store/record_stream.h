// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "skein/base/result.h"
#include "skein/data/event/live.h"
#include "skein/data/event/record.h"
#include "skein/record/store/rows.h"
#include "skein/record/store/summary.h"

namespace skein::record {

/// The records of a stored run as they came, for those who watch it again.
///
/// Messages come without what they said, but orders; perimeters with the digits that the
/// database keeps. Reads ahead in small pieces: a long run needs no more memory.
class RecordStream {
 public:
  /// Receives a record, or metrics of a mission, and when it came; what there was from
  /// the start comes before time 0.
  struct Listener {
    std::function<void(Time, const Record&)> record;
    std::function<void(Time, const MetricSample&)> metrics;
  };

  /// Opens the run in `directory`; one that is still being written, or was cut off, too.
  /// Fails: kNotFound without a database; kBadInput when it is damaged or of another
  ///        kind.
  static Result<RecordStream> open(const std::filesystem::path& directory);
  RecordStream(RecordStream&&) noexcept;
  RecordStream& operator=(RecordStream&&) noexcept;
  ~RecordStream();

  const RunInfo& info() const;
  /// The time of the last step.
  Time end() const;
  /// The ground as it was stored for maps; null: it was not.
  const TerrainRow* terrain() const;

  /// Goes to a time: advance() tells all that has happened until then anew, but of the
  /// motions of vehicles only the newest.
  /// Fails: as open().
  Result<void> seek(Time time);

  /// Tells what comes next, up to and including `until`, in order of time.
  /// Fails: as open().
  Result<void> advance(Time until, const Listener& listener);

 private:
  struct Parts;
  explicit RecordStream(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace skein::record
