// SPDX-License-Identifier: Apache-2.0
// The study tuning: laps, gains from files, the search and its interruption.
#include <algorithm>
#include <csignal>

#include "app/test/program.h"

namespace skein::app {
namespace {

class TuningProgram : public Program {
 protected:
  nlohmann::json summary(const std::string& folder) const {
    return nlohmann::json::parse(read_file(folder_ / folder / "summary.json"), nullptr,
                                 false);
  }
  std::ptrdiff_t lines(const std::string& file) const {
    const std::string text = read_file(folder_ / file);
    return std::count(text.begin(), text.end(), '\n');
  }
};

TEST_F(TuningProgram, LapsWithSofterGainsAreLessExact) {
  const std::vector<std::string> study = {"study", "tuning",  "--out",
                                          "t",     "--seeds", "3"};
  const Finished done = run(study);
  ASSERT_EQ(done.status, 0) << done.err;
  const auto figures = summary("t");
  EXPECT_EQ(figures.at("state"), "complete");
  EXPECT_EQ(figures.at("runs"), 3);
  for (const std::string set : {"soft", "default", "stiff"})
    EXPECT_EQ(figures.at(set + "/laps"), 3) << set;
  // Measured over 6 seeds: 1.46 +- 0.14, 0.53 +- 0.11 and 0.26 +- 0.11 m.
  EXPECT_LT(figures.at("default/cross_track_rms_m"), 1.0);
  EXPECT_GT(figures.at("soft/cross_track_rms_m"),
            1.5 * figures.at("default/cross_track_rms_m").get<double>());
  EXPECT_GT(figures.at("stiff/effort_deg_per_s"),
            1.2 * figures.at("soft/effort_deg_per_s").get<double>());
  EXPECT_EQ(lines("t/runs.csv"), 1 + 3 * 3);
  EXPECT_NE(done.out.find("Lap by lap"), std::string::npos) << done.out;
  EXPECT_NE(read_file(folder_ / "t" / "report.html").find("lap 2: default"),
            std::string::npos);

  const std::string journal = read_file(folder_ / "t" / "runs.jsonl");
  ASSERT_EQ(run(study).status, 0);
  EXPECT_EQ(read_file(folder_ / "t" / "runs.jsonl"), journal) << "nothing is flown again";
}

TEST_F(TuningProgram, GainsComeFromFilesAndKeepWhatTheseDoNotSay) {
  write("quick.yaml", "lateral: {l2_time_s: 1.2}\n");
  write("same.yaml", "fixed_wing_gains: {}\n");
  const Finished done = run({"study", "tuning", "--out", "t", "--seeds", "3", "--gains",
                             "quick.yaml,same.yaml"});
  ASSERT_EQ(done.status, 0) << done.err;
  const auto figures = summary("t");
  const double normal = figures.at("default/cross_track_rms_m");
  EXPECT_LT(figures.at("quick/cross_track_rms_m"), 0.8 * normal);
  // The same gains over the same flights, only in other laps.
  EXPECT_NEAR(figures.at("same/cross_track_rms_m"), normal, 0.5 * normal);
}

TEST_F(TuningProgram, ErrorsAreReportedBeforeAnythingIsFlown) {
  write("bad.yaml", "lateral: {l2_time_s: -1}\nfixed_wing_gains: {rol_gain_per_s: 3}\n");
  const Finished bad = run({"study", "tuning", "--gains", "bad.yaml"});
  EXPECT_EQ(bad.status, 2);
  EXPECT_NE(bad.err.find("bad.yaml:1"), std::string::npos) << bad.err;
  EXPECT_NE(bad.err.find("roll_gain_per_s"), std::string::npos) << bad.err;
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"--gains", "nowhere.yaml"},
                                             {"--search", "10", "--gains", "bad.yaml"},
                                             {"--search", "0"},
                                             {"--estimators", "qkf"},
                                             {"--set", "aircraft[0].plant=kinematic"},
                                             {"--set", "aircraft[0].autopilot=path"},
                                             {"--set", "aircraft[0].agent=scout"}}) {
    std::vector<std::string> all = {"study", "tuning"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Finished refused = run(all);
    EXPECT_EQ(refused.status, 2) << arguments.back() << refused.err;
    EXPECT_NE(refused.err, "");
  }
  EXPECT_EQ(run({"study", "monitoring", "--search", "10"}).status, 2);
  EXPECT_FALSE(fs::exists(folder_ / "runs"));
}

TEST_F(TuningProgram, LapsThatAreNotCompletedAreCounted) {
  const Finished done =
      run({"study", "tuning", "--out", "t", "--seeds", "1", "--set", "duration_s=150"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_NE(done.out.find("2 of 3 laps were not completed"), std::string::npos)
      << done.out;
  EXPECT_EQ(summary("t").at("soft/laps"), 1);
  EXPECT_EQ(summary("t").at("stiff/cost"), 1000);
  EXPECT_FALSE(summary("t").contains("stiff/cross_track_rms_m"));
}

TEST_F(TuningProgram, ASearchFindsGainsThatCanBeFlownAgain) {
  const std::vector<std::string> study = {"study",    "tuning", "--out",   "s",
                                          "--search", "14",     "--seeds", "2"};
  const Finished done = run(study);
  ASSERT_EQ(done.status, 0) << done.err;
  const auto figures = summary("s");
  EXPECT_EQ(figures.at("search/tried"), 14);
  EXPECT_LT(figures.at("search/cost_found"), figures.at("search/cost_start"));
  EXPECT_EQ(figures.at("default/laps"), 30) << "ten fresh seeds, three laps each";
  EXPECT_TRUE(figures.contains("search/cost_change_ci95"));
  EXPECT_NE(read_file(folder_ / "s" / "report.html").find("Gains found"),
            std::string::npos);

  // Going on where it was: nothing left to fly.
  const std::string gains = read_file(folder_ / "s" / "gains.yaml");
  const auto flown = lines("s/runs.jsonl");
  EXPECT_EQ(flown, 14 * 2 + 2 * 10);
  ASSERT_EQ(run(study).status, 0);
  EXPECT_EQ(lines("s/runs.jsonl"), flown);
  EXPECT_EQ(read_file(folder_ / "s" / "gains.yaml"), gains);

  // The file is one of gains.
  const Finished again =
      run({"study", "tuning", "--out", "t", "--seeds", "2", "--gains", "s/gains.yaml"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(summary("t").at("gains/laps"), 2);
}

TEST_F(TuningProgram, AnInterruptedSearchKeepsTheBestSoFarAndGoesOn) {
  const pid_t child = start({"study", "tuning", "--out", "s", "--search", "100000",
                             "--seeds", "1", "--threads", "1"});
  ASSERT_TRUE(appears(folder_ / "s" / "runs.jsonl"));
  for (int k = 0; k < 3000 && lines("s/runs.jsonl") < 3; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  const Finished stopped = finish(child);
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_NE(stopped.out.find("partial: "), std::string::npos) << stopped.out;
  EXPECT_TRUE(fs::exists(folder_ / "s" / "gains.yaml"));
  EXPECT_GE(summary("s").at("search/tried"), 3);
  EXPECT_EQ(summary("s").at("state").get<std::string>().substr(0, 9), "partial: ");
}

}  // namespace
}  // namespace skein::app
