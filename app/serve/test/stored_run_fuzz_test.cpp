// SPDX-License-Identifier: Apache-2.0
// Runs whose database was damaged: rows, cells, tables and bytes. Every reader has an
// answer, soon, and in little memory.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "app/serve/pack_run.h"
#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/world/run.h"
#include "skein/base/random.h"
#include "skein/exchange/gis/boundary_features.h"
#include "skein/layer/hmi/serve/live_state.h"
#include "skein/link/vehicle_links/vehicle_feed.h"
#include "skein/record/figures/message_load.h"
#include "skein/record/report/report.h"
#include "skein/record/store/record_stream.h"
#include "skein/record/store/replay.h"
#include "skein/record/store/run_recorder.h"
#include "skein/record/store/run_views.h"
#include "skein/record/test/sample_run.h"
#include "skein/scenario/scenario_file.h"

namespace skein::serve::stored_run_fuzz_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScenario =
    "name: stored\n"
    "duration_s: 150\n"
    "start_utc: 2026-08-01T10:00:00Z\n"
    "origin: {latitude_deg: 37, longitude_deg: -122}\n"
    "environment:\n"
    "  terrain: flat\n"
    "  wind: {kind: uniform, speed_mps: 3, from_deg: 250}\n"
    "  phenomena: [{kind: front, rate_mps: 0.06, age_s: 2000}]\n"
    "  zones: [{name: field, centre_m: [900, 300], radius_m: 80}]\n"
    "  objects: [{name: car, position_m: [300, 200]}]\n"
    "radio: medium\n"
    "aircraft: [{name: scout, count: 2, start: {distance_m: 500}}]\n"
    "commands:\n"
    "  - {at_s: 20, do: 'task scout-1 fly_to 300.125,-200.375'}\n"
    "  - {at_s: 40, do: 'wind 2.5 133.7'}\n"
    "missions:\n"
    "  - kind: perimeter\n"
    "    prior: {radius_m: 150, radius_sd_m: 60, rate_mps: 0.05, rate_sd_mps: 0.03}\n"
    "    forecast: {horizons_s: [30, 60], period_s: 30}\n";

std::optional<scenario::Scenario> read_kept_scenario(const std::string& text) {
  auto outcome = scenario::read_scenario_text(text, "test", ".", assemble::kind_table());
  if (!outcome.ok()) ADD_FAILURE() << outcome.report();
  return std::move(outcome.scenario);
}

// --- Readers ------------------------------------------------------------------------

// An answer is all that is asked for; that it is a bug of the program is none.
template <class T>
void take_answer(const char* reader, const Result<T>& answer) {
  if (answer || answer.error().code != ErrorCode::kInternal) return;
  std::fprintf(stderr, "%s: %s\n", reader, answer.error().text().c_str());
  ::_exit(3);
}

void show_again(const fs::path& folder) {
  auto stream = record::RecordStream::open(folder);
  take_answer("replay", stream);
  if (!stream) return;
  hmi::LiveState state;  // of whoever watches
  const record::RecordStream::Listener listener{
      [&state](Time, const Record& record) { state.take(record); },
      [](Time, const MetricSample&) {}};
  for (const double share : {0.0, 0.5, 1.0, 0.2}) {
    const Time time = Time::from_seconds(share * stream.value().end().seconds());
    auto done = stream.value().seek(time);
    if (done) done = stream.value().advance(time, listener);
    take_answer("replay", done);
    if (!done) return;
  }
}

void export_all(const fs::path& folder) {
  const auto run = record::RunViews::open(folder);
  take_answer("export", run);
  if (!run) return;
  const auto last = run.value().last();
  take_answer("export", last);
  if (!last) return;
  take_answer("export", run.value().ended());
  take_answer("export", run.value().start_utc());
  take_answer("export", run.value().paths(last.value()));
  take_answer("export", run.value().zones(last.value()));
  const auto frame = geo::LocalFrame::at({37, -122, 0});
  for (const auto& beliefs :
       {run.value().beliefs(last.value()), run.value().forecasts(last.value())}) {
    take_answer("export", beliefs);
    if (!beliefs) continue;
    std::vector<exchange::GisFeature> features;
    for (const record::StoredBelief& belief : beliefs.value())
      for (const exchange::BoundaryLevel& level : exchange::prediction_levels())
        features.push_back(
            exchange::boundary_feature({belief.who.mission, belief.boundary, belief.made},
                                       level, [](Time) { return std::string(); }));
    if (!features.empty())
      take_answer("export", exchange::write_gis(features, "belief", frame.value(),
                                                folder / "belief.geojson"));
  }
}

void do_again(const fs::path& folder) {
  const auto recorded = record::read_recorded(folder);
  take_answer("run --replay", recorded);
  if (!recorded) return;
  const auto scenario = read_kept_scenario(kScenario);
  const assemble::KindRegistry kinds;
  auto built = assemble::build(*scenario, kinds, recorded.value().reports);
  take_answer("run --replay", built);
  if (!built) return;
  assemble::Build& ready = built.value();
  ready.options.threads = 1;
  ready.options.commands = recorded.value().commands;
  ready.options.duration = Time::from_seconds(60);
  ready.feed.reset();
  take_answer("run --replay", assemble::LinkedRun(ready, {}).run().run_to_end());
}

void read_all(const fs::path& folder) {
  const std::vector<fs::path> runs = {folder};
  take_answer("report", record::write_report(runs, folder / "report.html", report_map));
  show_again(folder);
  export_all(folder);
  take_answer("team messages", record::read_sent_messages(folder));
  do_again(folder);
}

// --- Damage -------------------------------------------------------------------------

class Database {
 public:
  explicit Database(const fs::path& file) {
    sqlite3_open_v2(file.c_str(), &database_, SQLITE_OPEN_READWRITE, nullptr);
  }
  ~Database() { sqlite3_close(database_); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  // What is refused changes nothing.
  void execute(const std::string& sql) {
    sqlite3_exec(database_, sql.c_str(), nullptr, nullptr, nullptr);
  }
  std::vector<std::string> list(const std::string& sql) {
    std::vector<std::string> all;
    sqlite3_exec(
        database_, sql.c_str(),
        [](void* to, int, char** values, char**) {
          if (values[0]) static_cast<std::vector<std::string>*>(to)->push_back(values[0]);
          return 0;
        },
        &all, nullptr);
    return all;
  }

 private:
  sqlite3* database_ = nullptr;
};

constexpr std::array kCells = {"NULL",
                               "0",
                               "-1",
                               "1",
                               "1e300",
                               "-1e300",
                               "9e999",
                               "-9e999",
                               "1e-310",
                               "4e6",
                               "1e10",
                               "9223372036854775807",
                               "-9223372036854775808",
                               "4294967296",
                               "2147483648",
                               "''",
                               "'text'",
                               "'NaN'",
                               "x''",
                               "x'00ff'",
                               "zeroblob(3000000)",
                               "CAST(x'fffe41' AS TEXT)",
                               "randomblob(72)",
                               "'[[[[[[[['",
                               "'{\"kind\":\"hold\"}'",
                               "CAST(x'0000c07f' AS BLOB)",
                               "printf('%.*c', 100000, 'x')"};

class Mutator {
 public:
  Mutator(std::uint64_t number, fs::path file)
      : random_(number, 0, Purpose::kTest), file_(std::move(file)) {}

  // What was done, for whoever has to look at it.
  std::string damage() {
    std::string said;
    const int times = 1 + pick(3);
    for (int k = 0; k < times; ++k) said += (k ? "; " : "") + damage_once();
    return said;
  }

 private:
  int pick(int count) {
    return std::min(count - 1, static_cast<int>(random_.uniform(0, count)));
  }
  template <class List>
  std::string one_of(const List& list) {
    return list[static_cast<std::size_t>(pick(static_cast<int>(list.size())))];
  }

  std::string damage_once() {
    const int kind = pick(10);
    if (kind >= 8) return change_bytes();
    std::string sql;
    {
      Database database(file_);
      auto tables = database.list(
          "SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name");
      if (tables.empty()) return "no tables";
      // Rather those with rows.
      std::string table = one_of(tables);
      for (int k = 0;
           k < 6 && database.list("SELECT 1 FROM " + table + " LIMIT 1").empty(); ++k)
        table = one_of(tables);
      sql = kind < 6 ? change_rows(database, table) : change_tables(table);
      database.execute(sql);
    }
    return sql;
  }

  std::string change_rows(Database& database, const std::string& table) {
    const auto columns =
        database.list("SELECT name FROM pragma_table_info('" + table + "')");
    if (columns.empty()) return "no columns";
    const std::string row = " WHERE rowid IN (SELECT rowid FROM " + table +
                            " ORDER BY random() LIMIT " + std::to_string(1 + pick(3)) +
                            ")";
    switch (pick(6)) {
      case 0:
        return "UPDATE " + table + " SET rowid = " +
               one_of(std::array{"9223372036854775807", "-1", "0", "1000000000000",
                                 "50000000000", "rowid + 1000000"}) +
               " WHERE rowid = (SELECT rowid FROM " + table +
               " ORDER BY random() LIMIT 1)";
      case 1:
        return "DELETE FROM " + table + row;
      case 2:
        return "UPDATE " + table + " SET time_s = time_s * " +
               one_of(std::array{"1e5", "-1", "0", "1e9", "0.5"}) +
               one_of(std::array<std::string, 2>{"", row});
      case 3:
        return "INSERT INTO " + table + " SELECT * FROM " + table;
      default:
        return "UPDATE " + table + " SET " + one_of(columns) + " = " + one_of(kCells) +
               one_of(std::array<std::string, 3>{"", row, row});
    }
  }

  std::string change_tables(const std::string& table) {
    switch (pick(6)) {
      case 0:
        return "DROP TABLE " + table;
      case 1:
        return "ALTER TABLE " + table + " RENAME TO other_table; CREATE VIEW " + table +
               " AS WITH RECURSIVE endless(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM "
               "endless) SELECT n AS rowid, n AS time_s FROM endless";
      case 2:
        return "ALTER TABLE " + table + " RENAME COLUMN time_s TO other_s";
      case 3:
        return "PRAGMA user_version = " + std::to_string(pick(40));
      case 4:
        return "ALTER TABLE " + table + " ADD COLUMN more REAL";
      default:
        return "PRAGMA writable_schema = ON; UPDATE sqlite_master SET rootpage = " +
               std::to_string(1 + pick(60)) + " WHERE name = '" + table + "'";
    }
  }

  std::string change_bytes() {
    std::ifstream in(file_, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    in.close();
    if (bytes.empty()) return "empty";
    const auto size = static_cast<int>(bytes.size());
    std::string said;
    switch (pick(4)) {
      case 0:
        bytes.resize(static_cast<std::size_t>(pick(size)));
        said = "cut to " + std::to_string(bytes.size());
        break;
      case 1: {
        // A page in place of another.
        constexpr int kPage = 4096;
        const int pages = std::max(1, size / kPage);
        const int from = pick(pages), to = pick(pages);
        if (size >= pages * kPage)
          bytes.replace(static_cast<std::size_t>(to * kPage), kPage,
                        bytes.substr(static_cast<std::size_t>(from * kPage), kPage));
        said = "page " + std::to_string(from) + " over " + std::to_string(to);
        break;
      }
      default: {
        const int count = 1 + pick(20);
        const int reach = pick(2) == 0 ? std::min(size, 4096) : size;
        for (int k = 0; k < count; ++k)
          bytes[static_cast<std::size_t>(pick(reach))] = static_cast<char>(pick(256));
        said = std::to_string(count) + " bytes";
      }
    }
    std::ofstream(file_, std::ios::binary) << bytes;
    return said;
  }

  RandomStream random_;
  fs::path file_;
};

// --- Both ---------------------------------------------------------------------------

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr rlim_t kMaxCpu = 60;        // [s]
constexpr long kMaxMemory = 4 << 20;  // [KiB]
#else
// Of processor time, which other programs do not take from it. All readers together.
constexpr rlim_t kMaxCpu = 8;
constexpr long kMaxMemory = 700 << 10;
#endif

// In a process of its own. @returns what it said of itself; empty: all went well.
std::string in_own_process(const std::function<void()>& work) {
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit cpu{kMaxCpu, kMaxCpu + 1};
    ::setrlimit(RLIMIT_CPU, &cpu);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    try {
      work();
    } catch (const std::exception& error) {
      std::fprintf(stderr, "threw: %s\n", error.what());
      ::_exit(4);
    }
    ::_exit(0);
  }
  int status = 0;
  rusage used{};
  ::wait4(child, &status, 0, &used);
  if (WIFSIGNALED(status))
    return "killed by signal " + std::to_string(WTERMSIG(status)) +
           (WTERMSIG(status) == SIGXCPU ? ": it takes too long" : "");
  if (WEXITSTATUS(status) != 0)
    return "ended with " + std::to_string(WEXITSTATUS(status));
  if (used.ru_maxrss > kMaxMemory)
    return "took " + std::to_string(used.ru_maxrss) + " KiB";
  return {};
}

void make_run(const fs::path& folder) {
  const auto scenario = read_kept_scenario(kScenario);
  const assemble::KindRegistry kinds;
  auto built = assemble::build(*scenario, kinds);
  if (!built) throw std::runtime_error(built.error().text());
  assemble::Build& ready = built.value();
  auto recorder = record::RunRecorder::create(
      folder, {"test", scenario->seed, scenario->name, kScenario, scenario->start_utc});
  if (!recorder) throw std::runtime_error(recorder.error().text());
  constexpr float kHeights[] = {1, 2.1F, 3, 4};
  recorder.value()->store_terrain(2, 2, {-1200, -1200}, 2400, kHeights);
  if (!assemble::LinkedRun(ready, {recorder.value().get()}).run().run_to_end() ||
      !recorder.value()->close())
    throw std::runtime_error("no run");
}

// How many; more are for a long run of this test (docs/records.md).
int cases() {
  const char* asked = std::getenv("SKEIN_STORED_RUN_CASES");
  return asked ? std::max(1, std::atoi(asked)) : 60;
}
std::uint64_t first_case() {
  const char* asked = std::getenv("SKEIN_STORED_RUN_FIRST");
  return asked ? std::strtoull(asked, nullptr, 10) : 1;
}

TEST(StoredRun, HasAnAnswerWhateverIsInIt) {
  const record::TemporaryFolder folder("stored_run");
  const fs::path good = folder.path() / "good";
  ASSERT_EQ(in_own_process([&] { make_run(good); }), "");
  ASSERT_EQ(in_own_process([&] {
              const std::vector<fs::path> runs = {good};
              const auto report =
                  record::write_report(runs, good / "report.html", report_map);
              if (!report) throw std::runtime_error(report.error().text());
              if (const auto again = record::read_recorded(good); !again)
                throw std::runtime_error(again.error().text());
              read_all(good);
            }),
            "");
  const fs::path bad = folder.path() / "bad";
  for (int k = 0; k < cases(); ++k) {
    const std::uint64_t number = first_case() + static_cast<std::uint64_t>(k);
    fs::remove_all(bad);
    fs::create_directory(bad);
    fs::copy_file(good / "run.sqlite", bad / "run.sqlite");
    const std::string damage = Mutator(number, bad / "run.sqlite").damage();
    EXPECT_EQ(in_own_process([&] { read_all(bad); }), "")
        << "case " << number << ": " << damage;
  }
}

// Each names the table, the row and the column, and what is allowed.
TEST(StoredRun, SaysWhatMakesNoSense) {
  const record::TemporaryFolder folder("stored_words");
  const fs::path good = folder.path() / "good";
  ASSERT_EQ(in_own_process([&] { make_run(good); }), "");
  struct Case {
    const char* damage;
    std::vector<const char*> words;
  };
  const std::vector<Case> all = {
      {"UPDATE truth SET rowid = 9223372036854775807 WHERE rowid = 50",
       {"table truth", "rowid", "9223372036854775807", "100000000000"}},
      {"UPDATE truth SET north_m = 9e999 WHERE rowid = 7",
       {"table truth, row 7", "column north_m", "Inf", "a number from"}},
      {"UPDATE estimates SET time_s = 'soon' WHERE rowid = 7",
       {"table estimates, row 7", "column time_s", "soon", "a number from"}},
      {"UPDATE truth SET time_s = 5000 WHERE rowid = 7",
       {"table truth, row 7", "column time_s", "5000", "end of the run"}},
      {"UPDATE truth SET entity_id = 77 WHERE rowid = 9",
       {"table truth, row 9", "column entity_id", "77", "entity of the run"}},
      {"UPDATE summary SET value = 1e300 WHERE name = 'simulated_s'",
       {"summary", "1.0e+300", "number"}},
      {"UPDATE perimeters SET data = x'00112233' WHERE rowid = 1",
       {"table perimeters, row 1", "column data", "a blob of 4 bytes", "multiple of"}},
      {"UPDATE messages SET cause = 'magic' WHERE rowid = 3",
       {"table messages, row 3", "column cause", "magic"}},
      {"DROP TABLE crossings", {"has no table crossings"}},
      {"ALTER TABLE truth RENAME COLUMN charge TO fuel",
       {"table truth", "has no column charge"}},
      {"ALTER TABLE truth RENAME TO t2; CREATE VIEW truth AS SELECT * FROM t2",
       {"has no table truth"}}};
  for (const Case& each : all) {
    const fs::path bad = folder.path() / "bad";
    fs::remove_all(bad);
    fs::create_directory(bad);
    fs::copy_file(good / "run.sqlite", bad / "run.sqlite");
    Database(bad / "run.sqlite").execute(each.damage);
    const std::vector<fs::path> runs = {bad};
    const auto report = record::write_report(runs, bad / "report.html", report_map);
    ASSERT_FALSE(report) << each.damage;
    EXPECT_EQ(report.error().code, ErrorCode::kBadInput);
    for (const char* word : each.words)
      EXPECT_NE(report.error().text().find(word), std::string::npos)
          << each.damage << "\n"
          << report.error().text();
    EXPECT_FALSE(fs::exists(bad / "report.html"));
  }
}

// Numbers of rows that are missing, and one far behind the others, are no reason to
// search for ever.
TEST(StoredRun, IsShownAgainThoughRowsAreMissing) {
  const record::TemporaryFolder folder("stored_gaps");
  const fs::path run = folder.path() / "run";
  ASSERT_EQ(in_own_process([&] { make_run(run); }), "");
  Database(run / "run.sqlite")
      .execute(
          "DELETE FROM truth WHERE rowid % 3 = 1;"
          "UPDATE truth SET rowid = 90000000000 + rowid WHERE rowid = "
          "(SELECT max(rowid) FROM truth)");
  EXPECT_EQ(in_own_process([&] {
              show_again(run);
              auto stream = record::RecordStream::open(run);
              if (!stream) throw std::runtime_error(stream.error().text());
              std::size_t rows = 0;
              const auto done = stream.value().advance(
                  stream.value().end(),
                  {[&](Time, const Record& record) {
                     rows += std::holds_alternative<TruthRecord>(record);
                   },
                   [](Time, const MetricSample&) {}});
              if (!done) throw std::runtime_error(done.error().text());
              if (rows < 100) throw std::runtime_error("rows are lost");
            }),
            "");
}

}  // namespace
}  // namespace skein::serve::stored_run_fuzz_test
