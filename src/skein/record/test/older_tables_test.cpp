// SPDX-License-Identifier: Apache-2.0
#include "skein/record/store/older_tables.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "sample_run.h"
#include "skein/record/store/record_stream.h"
#include "skein/record/store/replay.h"
#include "skein/record/store/run_database.h"
#include "skein/record/store/run_reader.h"
#include "skein/record/store/run_recorder.h"
#include "skein/record/store/run_views.h"
#include "skein/record/store/sqlite.h"

namespace skein::record::older_tables_test {
namespace {

namespace fs = std::filesystem;

constexpr EntityId kOne{1}, kTwo{2};

// A run that was cut off: what its figures are is made of its rows.
void make_run(const fs::path& folder) {
  auto recorder =
      RunRecorder::create(folder, {"0.1.0", 5, "older", "seed: 5\n", ""}).value();
  const auto at = [](double time) { return Time::from_seconds(time); };
  recorder->record(EntityRecord{kOne, "a", "aircraft"});
  recorder->record(EntityRecord{kTwo, "b", "aircraft"});
  recorder->record(TeamLeadRecord{at(0), kOne, {"M", kOne, {}, TeamReason::kSelected}});
  const Event events[] = {
      {at(1), kOne, EventKind::kTeamTask, "3: measure", {.team_task = 3}},
      {at(2), kTwo, EventKind::kTeamTask, "3: measure", {.team_task = 3}},
      {at(3), kOne, EventKind::kTeamTask, "group 4: watch"},
      {at(5), kOne, EventKind::kFailsafe, "motor: none", {.value = 0}},
      {at(6), kOne, EventKind::kFailsafe, "link: return", {.value = 1}},
      {at(7), kOne, EventKind::kFailsafe, "over", {.value = 0}},
      {at(8), kTwo, EventKind::kTaskDone, "team task 3: measure", {.team_task = 3}},
      {at(8), kOne, EventKind::kTaskDone, "task 7: fly_to", {.task = 7}},
      {at(9), kOne, EventKind::kOverConfident, "60 %", {.value = 0.6}},
      {at(9), kOne, EventLabel::named("my-smoke"), "of a plugin"}};
  for (const Event& event : events) recorder->record(event);
  ASSERT_TRUE(recorder->step_done(at(10)));
  ASSERT_TRUE(recorder->close());
  auto database = Sqlite::open(folder / "run.sqlite", Sqlite::Mode::kCreate).value();
  ASSERT_TRUE(database.execute("DELETE FROM summary;"));
}

void change(const fs::path& folder, const std::string& sql) {
  auto database = Sqlite::open(folder / "run.sqlite", Sqlite::Mode::kCreate).value();
  const auto done = database.execute(sql);
  ASSERT_TRUE(done) << done.error().text();
}

// As Skein 0.1 (15) and 0.2 (16) have made it.
void make_older(const fs::path& folder, int version) {
  std::string sql = "PRAGMA user_version=" + std::to_string(version) + ";";
  for (const char* column : {"other_id", "task", "team_task", "value", "threshold"})
    sql += std::string("ALTER TABLE events DROP COLUMN ") + column + ";";
  if (version < 16) sql += "DROP TABLE separation_losses;";
  change(folder, sql);
}

TEST(OlderTables, AreReadAsThoseOfNow) {
  const TemporaryFolder folder("older_tables");
  make_run(folder.path() / "now");
  const auto now = read_run(folder.path() / "now", {});
  ASSERT_TRUE(now.ok()) << now.error().text();
  const auto& figures = now.value().summary.numbers;
  EXPECT_EQ(figures.at("failsafes"), 1);
  EXPECT_EQ(figures.at("team_tasks_done"), 1);
  EXPECT_EQ(figures.at("team_double_max_s"), 1) << "from 2 to 3 s";
  EXPECT_TRUE(figures.contains("over_confident_s"));
  for (const int version : {15, 16}) {
    SCOPED_TRACE(version);
    const fs::path older = folder.path() / std::to_string(version);
    make_run(older);
    make_older(older, version);
    const auto run = read_run(older, {});
    ASSERT_TRUE(run.ok()) << run.error().text();
    EXPECT_EQ(run.value().summary.numbers, figures);
    ASSERT_EQ(run.value().events.size(), now.value().events.size());
    for (std::size_t k = 0; k < run.value().events.size(); ++k)
      EXPECT_EQ(run.value().events[k].kind, now.value().events[k].kind);
    EXPECT_TRUE(std::ranges::any_of(run.value().events, [](const Event& event) {
      return event.kind.name() == "my-smoke";
    }));
    EXPECT_TRUE(RunViews::open(older).ok());
    EXPECT_TRUE(read_recorded(older).ok());
    auto stream = RecordStream::open(older);
    ASSERT_TRUE(stream.ok()) << stream.error().text();
    std::vector<Event> seen;
    ASSERT_TRUE(stream.value().advance(
        Time::from_seconds(20), {[&](Time, const Record& record) {
                                   if (const auto* event = std::get_if<Event>(&record))
                                     seen.push_back(*event);
                                 },
                                 [](Time, const MetricSample&) {}}));
    ASSERT_EQ(seen.size(), 10u);
    EXPECT_EQ(seen[0].numbers.team_task, 3u);
    EXPECT_EQ(seen[2].numbers.team_task, std::nullopt);
    EXPECT_EQ(seen[4].numbers.value, 1);
  }
}

TEST(OlderTables, OfOtherVersionsAreRefusedWithThoseThatAreRead) {
  const TemporaryFolder folder("other_tables");
  make_run(folder.path() / "run");
  for (const int version : {kOldestSchema - 1, kSchemaVersion + 1}) {
    change(folder.path() / "run", "PRAGMA user_version=" + std::to_string(version) + ";");
    const auto run = read_run(folder.path() / "run", {});
    ASSERT_FALSE(run.ok());
    EXPECT_NE(run.error().text().find("version " + std::to_string(version)),
              std::string::npos);
    EXPECT_NE(run.error().text().find("15 to 17"), std::string::npos);
  }
}

// What a version had may not be missing there.
TEST(OlderTables, ThatAreDamagedAreRefused) {
  const TemporaryFolder folder("damaged_tables");
  make_run(folder.path() / "run");
  change(folder.path() / "run", "DROP TABLE separation_losses;");
  EXPECT_FALSE(read_run(folder.path() / "run", {}).ok());
  make_run(folder.path() / "events");
  make_older(folder.path() / "events", 16);
  change(folder.path() / "events", "PRAGMA user_version=17;");
  EXPECT_FALSE(read_run(folder.path() / "events", {}).ok());
}

}  // namespace
}  // namespace skein::record::older_tables_test
