// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "skein/data/event/live.h"
#include "skein/record/store/summary.h"
#include "skein/role/recorder.h"

namespace skein::record {

struct RunRecorderOptions {
  Time perimeter_period = Time::from_seconds(10);  ///< perimeters are stored this often
  bool messages = true;             ///< messages are stored; else they are only counted
  std::int64_t max_size_bytes = 0;  ///< largest size of the database; 0 = no limit
  bool overwrite = false;           ///< replace a run that is already in the directory
  /// Told of all metrics as soon as they are known, by the recorder's own thread.
  std::function<void(const MetricSample&)> on_metrics = {};
};

/// Writes a run into `DIR/run.sqlite`, and `DIR/summary.json` at the end.
///
/// The simulation thread only copies and queues; a thread of the recorder's own
/// computes metrics and writes. It commits at least every half second of wall time, so
/// that a process killed at any moment leaves a readable database whose rows end at most
/// one second before. When the disk is slower than the simulation for long, the queue
/// fills and the simulation waits.
///
/// Truth and estimates are stored as often as the caller gives them. Metrics are computed
/// at every PerimeterRecord; the perimeters themselves are stored at most every
/// `perimeter_period` and at the end.
class RunRecorder final : public Recorder {
 public:
  /// Makes the directory where needed, and an empty database in it.
  /// Fails: kBadInput when there is a run already and `overwrite` is off; kUnavailable
  /// when the place cannot be written.
  static Result<std::unique_ptr<RunRecorder>> create(
      const std::filesystem::path& directory, RunInfo info,
      const RunRecorderOptions& options = {});

  /// Finishes what was given so far, without a summary, when close() was not called.
  ~RunRecorder() override;

  void record(const Record& record) override;
  Result<void> step_done(Time time) override;

  /// Keeps a small grid of the ground for the report's map, row by row: row r, column c
  /// is the height above sea level [m] at `low` + spacing * (r, c) (north, east) [m].
  /// Not part of the content hash. Bug: when the sizes do not fit.
  void store_terrain(int rows, int columns, const Vec2& low, double spacing,
                     std::span<const float> heights_msl);

  /// Sets one more number of the summary, such as `deadline_misses`.
  void set_figure(const std::string& name, double value);

  /// Writes everything out, then the summary (also as `summary.json`). Call once.
  /// Fails: kUnavailable as step_done() does; what was committed before stays readable.
  Result<RunSummary> close(bool interrupted = false);

 private:
  struct Parts;
  explicit RunRecorder(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace skein::record
