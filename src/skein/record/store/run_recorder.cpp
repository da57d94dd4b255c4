// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/run_recorder.h"

#include <map>
#include <system_error>
#include <utility>

#include "skein/base/folder_lock.h"
#include "skein/record/store/run_writer.h"
#include "skein/record/store/summary_recorder.h"

namespace skein::record {

namespace fs = std::filesystem;

namespace {

// What a run has left. Its log belongs to the old database: left behind, it would be
// played into the new.
Result<void> remove_run(const fs::path& directory) {
  for (const char* name :
       {"run.sqlite", "run.sqlite-journal", "run.sqlite-wal", "run.sqlite-shm",
        "scenario.yaml", "summary.json", "report.html"}) {
    const fs::path file = directory / name;
    std::error_code failed;
    const fs::file_type type = fs::symlink_status(file, failed).type();
    if (type == fs::file_type::not_found) continue;
    const bool ours = type == fs::file_type::regular || type == fs::file_type::symlink;
    if (ours && fs::remove(file, failed)) continue;
    return Error{ErrorCode::kUnavailable, file.string(),
                 "the old run cannot be removed: " +
                     (ours ? failed.message() : std::string("it is no regular file")),
                 ""};
  }
  return {};
}

}  // namespace

struct RunRecorder::Parts {
  Parts(fs::path place, FolderLock own, RunInfo run, RunDatabase database,
        const RunRecorderOptions& options)
      : directory(std::move(place)),
        lock(std::move(own)),
        info(std::move(run)),
        writer(std::move(database), options.perimeter_period, options.messages,
               options.on_metrics) {}

  fs::path directory;
  FolderLock lock;  // outlives what is written
  RunInfo info;
  RunWriter writer;
  std::map<std::string, double> extra;
  Time now;
  std::uint64_t steps = 0;
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
};

RunRecorder::RunRecorder(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

RunRecorder::~RunRecorder() = default;

Result<std::unique_ptr<RunRecorder>> RunRecorder::create(
    const fs::path& directory, RunInfo info, const RunRecorderOptions& options) {
  std::error_code failed;
  fs::create_directories(directory, failed);
  if (failed)
    return Error{ErrorCode::kUnavailable, directory.string(),
                 "the directory cannot be made: " + failed.message(),
                 "choose another place"};
  auto lock = FolderLock::take(directory, "a run");
  if (!lock) return lock.error();
  const fs::path file = directory / "run.sqlite";
  if (fs::symlink_status(file, failed).type() != fs::file_type::not_found) {
    if (!options.overwrite)
      return Error{ErrorCode::kBadInput, directory.string(),
                   "there is a run in this directory already",
                   "choose another directory, or allow to overwrite"};
    if (auto removed = remove_run(directory); !removed) return removed.error();
  }
  auto database = RunDatabase::create(file, info, options.max_size_bytes);
  if (!database) return database.error();
  return std::unique_ptr<RunRecorder>(new RunRecorder(
      std::make_unique<Parts>(directory, std::move(lock).value(), std::move(info),
                              std::move(database).value(), options)));
}

namespace {

// The time that it takes to write a record, in units of an ordinary row. Measured: a
// comparison of boundaries takes as long as one row for every two points.
std::size_t work_of(const Record& record) {
  const auto* perimeter = std::get_if<PerimeterRecord>(&record);
  if (!perimeter) return 1;
  std::size_t points = 0;
  for (const auto& ring : perimeter->truth) points += ring.size();
  for (const auto& ring : perimeter->belief.rings) points += ring.size();
  return 1 + points / 2;
}

}  // namespace

void RunRecorder::record(const Record& record) {
  parts_->writer.push(record, work_of(record));
}

Result<void> RunRecorder::step_done(Time time) {
  parts_->now = time;
  ++parts_->steps;
  return parts_->writer.status();
}

void RunRecorder::store_terrain(int rows, int columns, const Vec2& low, double spacing,
                                std::span<const float> heights_msl) {
  SKEIN_CHECK(rows > 0 && columns > 0 && spacing > 0, rows, columns, spacing);
  SKEIN_CHECK(heights_msl.size() ==
                  static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns),
              heights_msl.size(), rows, columns);
  parts_->writer.push(std::make_unique<TerrainRow>(
      TerrainRow{rows, columns, low, spacing, {heights_msl.begin(), heights_msl.end()}}));
}

void RunRecorder::set_figure(const std::string& name, double value) {
  parts_->extra[name] = value;
}

Result<RunSummary> RunRecorder::close(bool interrupted) {
  if (auto done = parts_->writer.finish(); !done) return done.error();
  const RunSummary summary =
      make_summary(parts_->info, parts_->writer.hash(), parts_->writer.statistics(),
                   parts_->extra, {parts_->now, parts_->steps},
                   std::chrono::steady_clock::now() - parts_->started, interrupted);
  if (auto done = parts_->writer.database().finish(summary); !done) return done.error();
  if (auto done = write_summary(summary, parts_->directory / "summary.json"); !done)
    return done.error();
  return summary;
}

}  // namespace skein::record
