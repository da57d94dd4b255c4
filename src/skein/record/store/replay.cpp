// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/replay.h"

#include <cmath>

#include "skein/record/store/record_table.h"
#include "skein/record/store/run_database.h"

namespace skein::record {

namespace {

// What is given again comes from outside, as it did the first time.
template <class T>
void check_given(const T& record, const Statement& row) {
  if (std::abs(record.time.seconds()) > kLongestRun)
    row.refuse(1, "a time of a run, up to 4e6 s");
  if constexpr (std::is_same_v<T, CommandRecord>) {
    T copy = record;
    if (!walk::has_sound_numbers(copy)) row.refuse(0, "a row without undefined numbers");
  }
}

}  // namespace

Result<RecordedRun> read_recorded(const std::filesystem::path& directory) {
  auto opened = Sqlite::open(directory / "run.sqlite", Sqlite::Mode::kRead);
  if (!opened) return opened.error();
  Sqlite database = std::move(opened).value();
  if (auto done = check_store(database); !done) return done.error();
  RecordedRun run;
  auto done = for_each_record<CommandRecord>(
      database, "ORDER BY rowid",
      [&](CommandRecord command) { run.commands.push_back(std::move(command)); },
      check_given<CommandRecord>);
  if (!done) return done.error();
  done = for_each_record<VehicleReportRecord>(
      database, "ORDER BY rowid",
      [&](VehicleReportRecord report) { run.reports.push_back(std::move(report)); },
      check_given<VehicleReportRecord>);
  if (!done) return done.error();
  done = for_each_row(
      database, "SELECT value FROM meta WHERE name = 'version'",
      [&](const Statement& row) { run.version = row.text(0); }, "table meta");
  if (!done) return done.error();
  bool interrupted = false;
  double simulated = 0, steps = 1;
  done = for_each_row(
      database, "SELECT name, value FROM summary",
      [&](const Statement& row) {
        const std::string name = row.text(0);
        if (name == "content_hash") run.content_hash = row.text(1);
        if (name == "interrupted") interrupted = row.integer(1) != 0;
        if (name == "steps") steps = row.real(1);
        if (name != "simulated_s") return;
        simulated = row.real(1);
        if (simulated < 0 || simulated > kLongestRun)
          row.refuse(1, "the end of a run, from 0 to 4e6 s");
      },
      "table summary");
  if (!done) return done.error();
  // One that was interrupted before its first step is done again without a step.
  if (interrupted)
    run.interrupted = steps > 0 ? Time::from_seconds(simulated) : Time::from_ns(-1);
  return run;
}

}  // namespace skein::record
