// SPDX-License-Identifier: Apache-2.0
// Full disks, unwritable places and killed processes.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "sample_run.h"
#include "skein/record/store/run_recorder.h"
#include "skein/record/store/sqlite.h"

namespace skein::record::recorder_fault_test {
namespace {

using Clock = std::chrono::steady_clock;

const RunInfo kInfo{"1.2.3", 1, "fault", "", ""};

double ask(const std::filesystem::path& run, const std::string& sql) {
  Sqlite database = Sqlite::open(run / "run.sqlite", Sqlite::Mode::kRead).value();
  Statement statement = database.prepare(sql).value();
  EXPECT_TRUE(statement.next()) << sql;
  return statement.real(0);
}

std::string integrity(const std::filesystem::path& run) {
  Sqlite database = Sqlite::open(run / "run.sqlite", Sqlite::Mode::kRead).value();
  Statement statement = database.prepare("PRAGMA integrity_check").value();
  EXPECT_TRUE(statement.next());
  return statement.text(0);
}

// Gives rows until the recorder refuses; the error it then states.
Error fill(RunRecorder& recorder) {
  for (int i = 0; i < 3000000; ++i) {
    const Time now = Time::from_ns(std::int64_t{i} * 1000000);
    recorder.record(TruthRecord{now, EntityId{1}, VehicleState{}});
    if (auto done = recorder.step_done(now); !done) return done.error();
  }
  return {};
}

TEST(RunRecorderFaults, AFullDiskEndsTheRunAndKeepsWhatWasWritten) {
  const TemporaryFolder folder("full");
  RunRecorderOptions options;
  options.max_size_bytes = 12 << 20;
  auto recorder = RunRecorder::create(folder.path(), kInfo, options).value();
  const Error error = fill(*recorder);
  EXPECT_EQ(error.code, ErrorCode::kUnavailable);
  EXPECT_NE(error.text().find("full"), std::string::npos) << error.text();
  EXPECT_NE(error.place.find("run.sqlite"), std::string::npos) << error.place;
  EXPECT_FALSE(recorder->close());
  recorder.reset();
  // A row takes about 110 bytes of the 12 MB.
  EXPECT_GT(ask(folder.path(), "SELECT count(*) FROM truth"), 50000);
  EXPECT_EQ(integrity(folder.path()), "ok");
}

TEST(RunRecorderFaults, AFileThatMayNotGrowIsReportedToo) {
  const TemporaryFolder folder("limit");
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{8 << 20, 8 << 20};
    setrlimit(RLIMIT_FSIZE, &limit);
    auto recorder = RunRecorder::create(folder.path(), kInfo);
    if (!recorder) _exit(2);
    const Error error = fill(*recorder.value());
    _exit(error.code == ErrorCode::kUnavailable && !recorder.value()->close() ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  EXPECT_GT(ask(folder.path(), "SELECT count(*) FROM truth"), 10000);
  EXPECT_EQ(integrity(folder.path()), "ok");
}

TEST(RunRecorderFaults, RefusesAPlaceThatCannotBeWritten) {
  const TemporaryFolder folder("place");
  std::ofstream(folder.path() / "file") << "not a directory";
  const auto made = RunRecorder::create(folder.path() / "file" / "run", kInfo);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kUnavailable);
  EXPECT_NE(made.error().place.find("file/run"), std::string::npos);

  // Nobody may write here, not even root.
  const auto system = RunRecorder::create("/proc/skein", kInfo);
  ASSERT_FALSE(system);
  EXPECT_EQ(system.error().code, ErrorCode::kUnavailable);

  std::filesystem::create_directories(folder.path() / "odd" / "run.sqlite" / "x");
  RunRecorderOptions overwrite;
  overwrite.overwrite = true;
  EXPECT_FALSE(RunRecorder::create(folder.path() / "odd", kInfo, overwrite));
}

TEST(RunRecorderFaults, ABugOnTheWritingThreadReachesTheRun) {
  const TemporaryFolder folder("bug");
  auto recorder = RunRecorder::create(folder.path(), kInfo).value();
  recorder->record(TruthRecord{{}, EntityId{1}, {}});
  BoundaryEstimate belief = believed_circle({}, {0, 0}, 100, 5);
  belief.rings[0][7].position.x() = std::nan("");
  recorder->record(PerimeterRecord{{}, EntityId{0}, {circle({0, 0}, 100, 50)}, belief});
  EXPECT_THROW(static_cast<void>(recorder->close()), Bug);
  EXPECT_THROW(static_cast<void>(recorder->step_done({})), Bug);
}

TEST(RunRecorderFaults, NeverReplacesARunUnasked) {
  const TemporaryFolder folder("again");
  {
    auto first = RunRecorder::create(folder.path(), kInfo).value();
    first->record(TruthRecord{{}, EntityId{1}, {}});
    ASSERT_TRUE(first->close());
  }
  const auto second = RunRecorder::create(folder.path(), kInfo);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::kBadInput);
  EXPECT_EQ(ask(folder.path(), "SELECT count(*) FROM truth"), 1);

  RunRecorderOptions overwrite;
  overwrite.overwrite = true;
  { ASSERT_TRUE(RunRecorder::create(folder.path(), kInfo, overwrite)); }
  EXPECT_EQ(ask(folder.path(), "SELECT count(*) FROM truth"), 0);
}

// Each row's time is the wall time since the start: what is missing at the end of a
// killed run can be given in seconds.
void record_wall_time(RunRecorder& recorder, Clock::time_point start, bool fast) {
  for (std::int64_t i = 0;; ++i) {
    const Time now = Time::from_ns((Clock::now() - start).count());
    recorder.record(TruthRecord{now, EntityId{1}, VehicleState{}});
    if (fast && i % 1000 == 0)
      recorder.record(PerimeterRecord{now,
                                      EntityId{0},
                                      {circle({0, 0}, 500, 500)},
                                      believed_circle(now, {0, 0}, 510, 9)});
    if (!recorder.step_done(now)) _exit(3);
    if (!fast) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void kill_after(double seconds, bool fast) {
  const TemporaryFolder folder("kill");
  const Clock::time_point start = Clock::now();
  const pid_t child = fork();
  if (child == 0) {
    auto recorder = RunRecorder::create(folder.path(), kInfo);
    if (!recorder) _exit(2);
    record_wall_time(*recorder.value(), start, fast);
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  kill(child, SIGKILL);
  const double killed = std::chrono::duration<double>(Clock::now() - start).count();
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status)) << status;
  ASSERT_EQ(integrity(folder.path()), "ok");
  EXPECT_GE(ask(folder.path(), "SELECT max(time_s) FROM truth"), killed - 1.0);
  EXPECT_EQ(ask(folder.path(), "SELECT count(*) FROM meta"), 5);
}

TEST(RunRecorderFaults, AKilledSlowRunIsReadableUpToItsLastSecond) {
  for (const double seconds : {0.7, 1.2}) kill_after(seconds, false);
}

TEST(RunRecorderFaults, AKilledFastRunIsReadableUpToItsLastSecond) {
  for (const double seconds : {0.47, 0.91, 1.33}) kill_after(seconds, true);
}

}  // namespace
}  // namespace skein::record::recorder_fault_test
