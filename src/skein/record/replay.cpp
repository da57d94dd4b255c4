#include "skein/record/replay.h"

#include "skein/record/record_table.h"
#include "skein/record/run_database.h"

namespace skein::record {

Result<void> check_schema(Sqlite& database) {
  std::int64_t schema = 0;
  auto done = for_each_row(database, "PRAGMA user_version",
                           [&](const Statement& row) { schema = row.integer(0); });
  if (done && schema != kSchemaVersion)
    return Error{ErrorCode::kBadInput, "run.sqlite",
                 "its tables are of version " + std::to_string(schema) +
                     ", this program reads version " + std::to_string(kSchemaVersion) +
                     ".",
                 "Use the program that recorded it, or run the scenario again."};
  return done;
}

Result<RecordedRun> read_recorded(const std::filesystem::path& directory) {
  auto opened = Sqlite::open(directory / "run.sqlite", Sqlite::Mode::kRead);
  if (!opened) return opened.error();
  Sqlite database = std::move(opened).value();
  if (auto done = check_schema(database); !done) return done.error();
  RecordedRun run;
  auto done = for_each_record<CommandRecord>(
      database, "ORDER BY rowid",
      [&](CommandRecord command) { run.commands.push_back(std::move(command)); });
  if (!done) return done.error();
  done = for_each_record<VehicleReportRecord>(
      database, "ORDER BY rowid",
      [&](VehicleReportRecord report) { run.reports.push_back(std::move(report)); });
  if (!done) return done.error();
  bool interrupted = false;
  double simulated = 0;
  done = for_each_row(database, "SELECT name, value FROM summary",
                      [&](const Statement& row) {
                        const std::string name = row.text(0);
                        if (name == "content_hash") run.content_hash = row.text(1);
                        if (name == "interrupted") interrupted = row.integer(1) != 0;
                        if (name == "simulated_s") simulated = row.real(1);
                      });
  if (!done) return done.error();
  if (interrupted) run.interrupted = Time::from_seconds(simulated);
  return run;
}

}  // namespace skein::record
