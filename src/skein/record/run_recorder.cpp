#include "skein/record/run_recorder.h"

#include <map>
#include <system_error>
#include <utility>

#include "skein/record/content_hash.h"
#include "skein/record/run_writer.h"
#include "skein/record/summary_recorder.h"

namespace skein::record {

namespace fs = std::filesystem;

struct RunRecorder::Parts {
  Parts(fs::path place, RunInfo run, RunDatabase database,
        const RunRecorderOptions& options)
      : directory(std::move(place)),
        info(std::move(run)),
        writer(std::move(database), options.perimeter_period, options.messages) {}

  fs::path directory;
  RunInfo info;
  ContentHash hash;
  RunWriter writer;
  std::map<std::string, double> extra;
  Time now;
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
};

RunRecorder::RunRecorder(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

RunRecorder::~RunRecorder() = default;

Result<std::unique_ptr<RunRecorder>> RunRecorder::create(const fs::path& directory,
                                                         RunInfo info,
                                                         RunRecorderOptions options) {
  std::error_code failed;
  fs::create_directories(directory, failed);
  if (failed)
    return Error{ErrorCode::kUnavailable, directory.string(),
                 "the directory cannot be made: " + failed.message(),
                 "choose another place"};
  const fs::path file = directory / "run.sqlite";
  if (fs::exists(file, failed)) {
    if (!options.overwrite)
      return Error{ErrorCode::kBadInput, directory.string(),
                   "there is a run in this directory already",
                   "choose another directory, or allow to overwrite"};
    // The log belongs to the old database: left behind, it would be played into the new.
    for (const char* name : {"run.sqlite", "run.sqlite-wal", "run.sqlite-shm",
                             "summary.json", "report.html"}) {
      fs::remove(directory / name, failed);
      if (failed)
        return Error{ErrorCode::kUnavailable, (directory / name).string(),
                     "the old run cannot be removed: " + failed.message(), ""};
    }
  }
  auto database = RunDatabase::create(file, info, options.max_size_bytes);
  if (!database) return database.error();
  return std::unique_ptr<RunRecorder>(new RunRecorder(std::make_unique<Parts>(
      directory, std::move(info), std::move(database).value(), options)));
}

void RunRecorder::entity(EntityId id, const std::string& name, const std::string& kind) {
  parts_->hash.entity(id, name, kind);
  parts_->writer.push(EntityRow{id, name, kind});
}

void RunRecorder::truth(Time time, EntityId id, const VehicleState& state) {
  parts_->hash.truth(time, id, state);
  parts_->writer.push(TruthRow(time, id, state));
}

void RunRecorder::estimate(EntityId id, const NavEstimate& estimate,
                           const AutopilotStatus& status) {
  parts_->hash.estimate(id, estimate, status);
  parts_->writer.push(EstimateRow(id, estimate, status));
}

void RunRecorder::reading(const FireReading& reading) {
  parts_->hash.reading(reading);
  parts_->writer.push(reading);
}

void RunRecorder::message(const Message& message, Time arrived, bool lost) {
  parts_->hash.message(message, arrived, lost);
  parts_->writer.push(MessageRow{message.from, message.to, message.number, message.sent,
                                 arrived, message.size_bytes,
                                 static_cast<int>(message.content.index()), lost});
  if (const auto* task = std::get_if<Task>(&message.content))
    parts_->writer.push(std::make_unique<TaskRow>(
        TaskRow{message.sent, arrived, message.from, message.to, *task, lost}));
}

void RunRecorder::perimeter(Time time, const geo::Region& truth, EntityId believer,
                            const BoundaryEstimate& belief) {
  parts_->hash.perimeter(time, truth, believer, belief);
  // Measured: a comparison takes as long as one row for every two points.
  std::size_t points = 0;
  for (const auto& ring : truth) points += ring.size();
  for (const auto& ring : belief.rings) points += ring.size();
  parts_->writer.push(
      std::make_unique<PerimeterRow>(PerimeterRow{time, believer, truth, belief}),
      1 + points / 2);
}

void RunRecorder::event(const Event& event) {
  parts_->hash.event(event);
  parts_->writer.push(event);
}

void RunRecorder::crossing(const Crossing& crossing) {
  parts_->hash.crossing(crossing);
  parts_->writer.push(crossing);
}

void RunRecorder::zone(Time time, const ZoneChange& change) {
  parts_->hash.zone(time, change);
  parts_->writer.push(std::make_unique<ZoneRow>(ZoneRow{time, change}));
}

void RunRecorder::object(const GroundObject& object) {
  parts_->hash.object(object);
  parts_->writer.push(std::make_unique<GroundObject>(object));
}

void RunRecorder::detection(const Detection& detection) {
  parts_->hash.detection(detection);
  parts_->writer.push(detection);
}

void RunRecorder::footprint(const Footprint& footprint) {
  parts_->hash.footprint(footprint);
  parts_->writer.push(footprint);
}

void RunRecorder::ranges(const RangeScan& scan) {
  parts_->hash.ranges(scan);
  parts_->writer.push(scan);
}

Result<void> RunRecorder::step_done(Time time) {
  parts_->now = time;
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
  const RunSummary summary = make_summary(
      parts_->info, parts_->hash, parts_->writer.statistics(), parts_->extra, parts_->now,
      std::chrono::steady_clock::now() - parts_->started, interrupted);
  if (auto done = parts_->writer.database().finish(summary); !done) return done.error();
  if (auto done = write_summary(summary, parts_->directory / "summary.json"); !done)
    return done.error();
  return summary;
}

}  // namespace skein::record
