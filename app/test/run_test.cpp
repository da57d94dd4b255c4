// SPDX-License-Identifier: Apache-2.0
// Runs that are watched, interrupted, killed, repeated, or fill the disk.
#include <algorithm>
#include <csignal>

#include "app/test/program.h"
#include "skein/base/random.h"

namespace skein::app {
namespace {

TEST_F(Program, AFullDiskEndsTheRunAndKeepsWhatWasWritten) {
  const auto file = write("s.yaml", "duration_s: 3000\naircraft: [{count: 6}]");
  const Finished full = run({"run", file.string(), "--out", "full"}, 3'000'000);
  EXPECT_EQ(full.status, 1) << full.err;
  for (const char* text : {"run.sqlite", "s of simulated time)", "Replay: skein run "})
    EXPECT_NE(full.err.find(text), std::string::npos) << text << "\n" << full.err;
  EXPECT_GT(query(folder_ / "full" / "run.sqlite", "select count(*) from truth"), 100);
}

// The fault: a byte that is no UTF-8 ended the run with an internal error.
TEST_F(Program, BytesThatAreNoTextDoNotEndARun) {
  write("s.yaml", "duration_s: 20\naircraft: [{name: scout}]\nmissions: []\n");
  std::string lines = "pause\n";
  lines +=
      std::string("zone on \xff\xfe circle 0,0 50\ntask \xb0 fly_to 5,5\nadd a\0b\n", 52);
  lines += "fault scout-1 sensor \xff\nwind \xff\n\xff\xfe\nmission start \xed\xa0\x80\n";
  RandomStream random(38, 0, Purpose::kTest);
  for (int k = 0; k < 3000; ++k) lines += static_cast<char>(random.bits() % 256);
  input_ = write("orders", lines + "\nzone on last circle 900,900 50\nresume\n");
  const Finished finished = run({"run", "s.yaml", "--commands", "--out", "bytes"});
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_EQ(finished.err.find("internal error"), std::string::npos) << finished.err;
  const fs::path database = folder_ / "bytes" / "run.sqlite";
  EXPECT_EQ(query(database, "select count(*) from zones where name = 'last'"), 1);
  input_.clear();
  EXPECT_EQ(run({"run", "--replay", "bytes"}).status, 0);
  EXPECT_EQ(run({"report", "bytes"}).status, 0);
}

TEST_F(Program, TheLogSaysWhatHappens) {
  write("s.yaml", "duration_s: 60\naircraft: [{count: 2}]\n");
  const Finished quiet = run({"run", "s.yaml", "--out", "quiet"});
  EXPECT_EQ(quiet.err, "");
  const Finished finished = run({"run", "s.yaml", "--out", "logged", "--log", "info"});
  EXPECT_EQ(finished.status, 0);
  EXPECT_NE(finished.err.find("info: 0.0 s, scout-2: joined: "), std::string::npos)
      << finished.err;
  const Finished loud = run({"run", "s.yaml", "--log", "loud"});
  EXPECT_EQ(loud.status, 2);
  EXPECT_NE(loud.err.find("debug,info,warning,error"), std::string::npos) << loud.err;
}

TEST_F(Program, CtrlCLeavesACompleteRun) {
  const auto file = write("s.yaml", "duration_s: 100000");
  const pid_t child = start({"run", file.string(), "--out", "stopped", "--report"});
  ASSERT_TRUE(appears(folder_ / "stopped" / "scenario.yaml"));
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
  kill(child, SIGINT);
  const Finished stopped = finish(child);
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  for (const char* name : {"run.sqlite", "summary.json", "scenario.yaml", "report.html"})
    EXPECT_TRUE(fs::exists(folder_ / "stopped" / name)) << name;
  const auto summary = nlohmann::json::parse(
      read_file(folder_ / "stopped" / "summary.json"), nullptr, false);
  ASSERT_FALSE(summary.is_discarded());
  EXPECT_GT(summary["simulated_s"].get<double>(), 0);
}

TEST_F(Program, AKillLeavesReadableRecordsUpToASecondBefore) {
  const auto file = write("s.yaml", "duration_s: 100000\naircraft: [{count: 3}]");
  RandomStream random(7, 0, Purpose::kTest);
  for (int k = 0; k < 4; ++k) {
    const std::string out = "killed" + std::to_string(k);
    // Ten times real time: rows of the last wall second are ten simulated seconds.
    const pid_t child = start({"run", file.string(), "--out", out, "--speed", "10"});
    ASSERT_TRUE(appears(folder_ / out / "scenario.yaml"));
    const auto begun = std::chrono::steady_clock::now();
    std::this_thread::sleep_for(
        std::chrono::milliseconds(1200 + static_cast<int>(random.uniform(0, 700))));
    kill(child, SIGKILL);
    const double lived_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    EXPECT_EQ(finish(child).status, -SIGKILL);
    const fs::path database = folder_ / out / "run.sqlite";
    EXPECT_EQ(query(database,
                    "select count(*) from pragma_integrity_check where "
                    "integrity_check = 'ok'"),
              1);
    // One second, and half a second more for a busy machine to start the run.
    EXPECT_GT(query(database, "select max(time_s) from truth"), 10 * (lived_s - 1.5));
    EXPECT_EQ(run({"report", out}).status, 0);
  }
}

// Somebody else writes into its folder, or has: it has no page.
TEST_F(Program, ARunThatIsRefusedShowsNoPage) {
  const auto file = write("long.yaml", "name: long\nduration_s: 900\n");
  prefix_ = "first-";
  const pid_t first = start({"run", file.string(), "--out", "run", "--serve", "0"});
  for (int k = 0; k < 3000 && read_file(folder_ / "first-err.txt").find("The page: ") ==
                                  std::string::npos;
       ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  prefix_ = "second-";
  const Finished locked =
      run({"run", file.string(), "--out", "run", "--serve", "0", "--overwrite"});
  EXPECT_EQ(locked.status, 2) << locked.err;
  EXPECT_EQ(locked.err.find("The page: "), std::string::npos) << locked.err;
  prefix_ = "first-";
  kill(first, SIGINT);
  const Finished shown = finish(first);
  EXPECT_NE(shown.err.find("The page: "), std::string::npos) << shown.err;
  prefix_ = "second-";
  const Finished there = run({"run", file.string(), "--out", "run", "--serve", "0"});
  EXPECT_EQ(there.status, 2) << there.err;
  EXPECT_EQ(there.err.find("The page: "), std::string::npos) << there.err;
}

TEST_F(Program, CountsEveryCrossingOnce) {
  // The first readings of both aircraft come later than they were taken, some never.
  const auto file = write("s.yaml",
                          "duration_s: 900\naircraft: [{count: 2}]\n"
                          "radio: {kind: ideal, loss: 0.2}\n");
  const Finished done = run({"run", file.string(), "--out", "run", "--json"});
  ASSERT_EQ(done.status, 0) << done.err;
  const auto summary = nlohmann::json::parse(done.out);
  const fs::path database = folder_ / "run" / "run.sqlite";
  EXPECT_GT(summary.at("crossings"), 5);
  EXPECT_EQ(summary.at("crossings"), query(database, "select count(*) from crossings"));
  EXPECT_EQ(summary.at("crossings"),
            query(database, "select count(*) from events where kind = 'crossing'"));
}

TEST_F(Program, TheHashIsTheSameForAnyThreads) {
  // Two hundred aircraft: with fewer than 32 the phases of a step are not shared out.
  const std::string expected = hash_of("many", 30, {"--threads", "1"});
  EXPECT_EQ(expected.size(), 32u);
  for (const char* threads : {"2", "4"})
    for (int run = 0; run < 2; ++run)  // a race need not show the first time
      EXPECT_EQ(hash_of("many", 30, {"--threads", threads}), expected) << threads;
}

TEST_F(Program, TheHashIsTheSameForAnySpeed) {
  const std::string expected = hash_of("wildfire", 90, {});
  EXPECT_EQ(expected.size(), 32u);
  EXPECT_EQ(hash_of("wildfire", 90, {"--speed", "60"}), expected);
  EXPECT_NE(hash_of("wildfire", 90, {"--seed", "2"}), expected);
}

}  // namespace
}  // namespace skein::app
