// SPDX-License-Identifier: Apache-2.0
// A run of a scenario that is held: stepped, commanded, asked, dropped.
#include "skein/assemble/world/scenario_run.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "skein/assemble/world/run.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::scenario_run_test {
namespace {

namespace fs = std::filesystem;

const char* const kFire = R"(
duration_s: 60
seed: 5
environment:
  terrain: flat
  wind: {kind: uniform, speed_mps: 4}
  phenomena: [{kind: front, rate_mps: 0.2, ignitions: [{point_m: [0, 0], radius_m: 150}]}]
aircraft: [{name: scout, count: 2, start: {placement: ring, distance_m: 400}}]
missions: [{kind: perimeter}]
)";

std::unique_ptr<ScenarioRun> open(const std::vector<std::string>& set = {},
                                  const ScenarioRunOptions& options = {}) {
  KindRegistry kinds;  // is not needed any more
  auto opened = ScenarioRun::open_text(kFire, ".", set, kinds, options);
  if (!opened) throw std::runtime_error(opened.error().text());
  return std::move(opened).value();
}

// As `skein run` has it.
std::string whole(const std::vector<std::string>& set = {}) {
  const KindRegistry kinds;
  std::vector<scenario::Override> overrides;
  for (const std::string& text : set) overrides.push_back({text});
  const auto read =
      scenario::read_scenario_text(kFire, "fire", ".", kinds.table(), overrides);
  EXPECT_TRUE(read.ok()) << read.report();
  const auto summary = run_quietly(*read.scenario, kinds, {});
  EXPECT_TRUE(summary.ok());
  return summary.value().content_hash;
}

void step_to_end(ScenarioRun& run, std::int64_t ticks) {
  while (!run.over()) ASSERT_TRUE(run.step(ticks).ok());
}

TEST(ScenarioRun, HasTheHashOfTheWholeRunHoweverItIsStepped) {
  const std::string expected = whole();
  for (const std::int64_t ticks : {1, 7, 100000}) {
    const auto run = open();
    step_to_end(*run, ticks);
    EXPECT_EQ(run->content_hash(), expected) << ticks;
    EXPECT_FALSE(run->summary().interrupted);
  }
  const auto run = open();
  ASSERT_TRUE(run->run_to_end().ok());
  EXPECT_EQ(run->summary().content_hash, expected);
  ScenarioRunOptions unseen;
  unseen.keeps_view = false;
  const auto other = open({}, unseen);
  ASSERT_TRUE(other->run_to_end().ok());
  EXPECT_EQ(other->content_hash(), expected) << "who looks changes nothing";
}

TEST(ScenarioRun, ACommandInBetweenIsThatOfTheScenario) {
  const std::string planned =
      whole({"commands=[{at_s: 20, do: wind 6 90}, "
             "{at_s: 30, do: \"zone on lake circle 300,0 80\"}]"});
  EXPECT_NE(planned, whole());
  const auto run = open();
  ASSERT_TRUE(run->run_until(Time::from_seconds(20)).ok());
  ASSERT_TRUE(run->command("scenario", "wind 6 90").ok());
  ASSERT_TRUE(run->run_until(Time::from_seconds(30)).ok());
  ASSERT_TRUE(run->command("scenario", "zone on lake circle 300,0 80").ok());
  ASSERT_TRUE(run->run_to_end().ok());
  EXPECT_EQ(run->content_hash(), planned);
}

TEST(ScenarioRun, TakesChangesAsTheCommandLineDoes) {
  const std::vector<std::string> set = {"seed=9", "aircraft[0].count=1", "duration_s=20"};
  const auto run = open(set);
  EXPECT_EQ(run->names(), (std::vector<std::string>{"station", "scout-1"}));
  ASSERT_TRUE(run->run_to_end().ok());
  EXPECT_EQ(run->content_hash(), whole(set));
  EXPECT_EQ(run->run().simulated(), Time::from_seconds(20));
}

TEST(ScenarioRun, TwoInterleavedHaveTheHashesOfEachAlone) {
  const auto one = open(), other = open({"seed=6"});
  while (!one->over() || !other->over()) {
    if (!one->over()) {
      ASSERT_TRUE(one->step(11).ok());
    }
    if (!other->over()) {
      ASSERT_TRUE(other->step(3).ok());
    }
  }
  EXPECT_EQ(one->content_hash(), whole());
  EXPECT_EQ(other->content_hash(), whole({"seed=6"}));
  EXPECT_NE(one->content_hash(), other->content_hash());
}

TEST(ScenarioRun, AnswersByName) {
  const auto run = open();
  EXPECT_FALSE(run->real_time());
  ASSERT_TRUE(run->truth("scout-1").ok());
  EXPECT_NEAR(run->truth("scout-1").value().p_N.head<2>().norm(), 400, 1);
  EXPECT_EQ(run->estimate("scout-1").error().code, ErrorCode::kUnavailable);
  ASSERT_TRUE(run->run_until(Time::from_seconds(40)).ok());
  const auto truth = run->truth("scout-2");
  const auto estimate = run->estimate("scout-2");
  ASSERT_TRUE(truth.ok() && estimate.ok() && run->status("scout-2").ok());
  EXPECT_LT((truth.value().p_N - estimate.value().p_N).norm(), 30);

  const auto beliefs = run->perimeter_beliefs("station");
  ASSERT_TRUE(beliefs.ok());
  ASSERT_EQ(beliefs.value().size(), 1u);
  EXPECT_GT(beliefs.value()[0].time, Time::from_seconds(30)) << "it is the newest";
  EXPECT_FALSE(beliefs.value()[0].truth.empty());
  ASSERT_TRUE(run->perimeter_beliefs("scout-1").ok());
  EXPECT_TRUE(run->perimeter_beliefs("scout-1").value().empty());

  std::set<std::string> kinds;
  for (const Event& event : run->take_events())
    kinds.insert(std::string(event.kind.name()));
  EXPECT_TRUE(kinds.contains("joined"));
  EXPECT_TRUE(run->take_events().empty());
}

TEST(ScenarioRun, ASummaryBeforeTheEndSaysSo) {
  const auto run = open();
  ASSERT_TRUE(run->step(50).ok());
  EXPECT_TRUE(run->summary().interrupted);
  EXPECT_EQ(run->summary().content_hash, run->content_hash());
  EXPECT_EQ(run->summary().number("aircraft"), 2);
  ASSERT_TRUE(run->finish().ok());
  EXPECT_TRUE(run->summary().interrupted);
}

TEST(ScenarioRun, SaysWhatIsWrong) {
  KindRegistry kinds;
  const auto bad = ScenarioRun::open_text("duration_s: -1\nwind: 3\n", ".", {}, kinds);
  ASSERT_FALSE(bad.ok());
  EXPECT_EQ(bad.error().code, ErrorCode::kBadInput);
  const std::string text = bad.error().text();
  EXPECT_NE(text.find("duration_s"), std::string::npos) << text;
  EXPECT_NE(text.find("unknown key"), std::string::npos) << text;
  EXPECT_NE(text.find("2 problems"), std::string::npos) << text;
  EXPECT_FALSE(ScenarioRun::open_text(kFire, ".", {"sede=3"}, kinds).ok());
  EXPECT_FALSE(ScenarioRun::open(fs::path("/nowhere/s.yaml"), {}, kinds).ok());

  const auto run = open({"duration_s=10"});
  const auto fault = run->command("me", "fault scout-9 motor");
  ASSERT_FALSE(fault.ok());
  EXPECT_EQ(fault.error().text(), "fault: there is no aircraft \"scout-9\".");
  EXPECT_FALSE(run->command("me", "make tea").ok());
  EXPECT_EQ(run->truth("scout-9").error().text(),
            "scout-9: is no aircraft or station of the run; it has: station, scout-1, "
            "scout-2.");
  EXPECT_EQ(run->truth("station").error().code, ErrorCode::kUnavailable);
  ASSERT_TRUE(run->run_to_end().ok());
  EXPECT_EQ(run->step().error().code, ErrorCode::kBadInput);
  EXPECT_NE(run->step().error().text().find("the run is over"), std::string::npos);
}

// A library that a scenario names is a program: without consent it is not loaded.
TEST(ScenarioRun, LoadsNoCodeWithoutConsent) {
  KindRegistry kinds;
  const auto opened = ScenarioRun::open_text(
      kFire, ".", {std::string("plugins=[") + SKEIN_FOREIGN_PLUGIN + "]"}, kinds);
  ASSERT_FALSE(opened.ok());
  EXPECT_NE(opened.error().text().find("consent"), std::string::npos)
      << opened.error().text();
}

std::ptrdiff_t entries(const char* folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(ScenarioRun, LeavesNothingBehindWhenItIsDroppedOnTheWay) {
  const fs::path folder = fs::path(testing::TempDir()) / "dropped-run";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  ASSERT_TRUE(open()->step(5).ok());  // what a process opens once
  const auto threads = entries("/proc/self/task"), files = entries("/proc/self/fd");
  for (int k = 0; k < 3; ++k) {
    const auto run = open();
    ASSERT_TRUE(run->step(20).ok());
  }
  EXPECT_LE(entries("/proc/self/task"), threads);
  EXPECT_LE(entries("/proc/self/fd"), files);
  EXPECT_TRUE(fs::is_empty(folder));
  fs::current_path(before);
}

}  // namespace
}  // namespace skein::assemble::scenario_run_test
