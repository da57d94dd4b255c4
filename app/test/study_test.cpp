// SPDX-License-Identifier: Apache-2.0
// Studies: going on after an interrupt, running again what changed, checking rows.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <map>
#include <set>
#include <sstream>

#include "app/test/program.h"

namespace skein::app {
namespace {

TEST_F(Program, StudiesGoOnAfterAnInterrupt) {
  const std::vector<std::string> study = {
      "study",        "monitoring",   "--out",        "m",   "--seeds",      "2",
      "--only-cases", "no-wind",      "--estimators", "qkf", "--strategies", "gus",
      "--set",        "duration_s=60"};
  const Finished first = run(study);
  EXPECT_EQ(first.status, 0) << first.err;
  EXPECT_TRUE(fs::exists(folder_ / "m" / "report.html"));
  const auto summary = nlohmann::json::parse(read_file(folder_ / "m" / "summary.json"));
  EXPECT_EQ(summary.at("runs"), 2);
  EXPECT_GT(summary.at("no-wind/gus/qkf/perf_run_mean_m"), 0);
  const auto journal = read_file(folder_ / "m" / "runs.jsonl");
  EXPECT_EQ(run(study).status, 0);
  EXPECT_EQ(read_file(folder_ / "m" / "runs.jsonl"), journal) << "nothing was run again";
  EXPECT_EQ(summary.at("state"), "complete");
  const Finished unknown = run({"study", "elephants"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("there is no study \"elephants\". There are: estimators"),
            std::string::npos)
      << unknown.err;
  EXPECT_EQ(run({"study", "monitoring", "--estimators", "elephant"}).status, 2);
}

// Two that meet head-on in a cross wind, and two that never do.
constexpr const char* kMeetings =
    "case,wind_north_mps,wind_east_mps,aircraft,start_north_m,start_east_m,start_down_m,"
    "goal_north_m,goal_east_m,goal_down_m,airspeed_mps\n"
    "head-on-1,0,4,1,0,0,-200,4000,0,-200,20\n"
    "head-on-1,0,4,2,4000,10,-198,0,10,-198,18\n"
    "apart-1,0,0,1,0,0,-200,2000,0,-200,20\n"
    "apart-1,0,0,2,0,900,-200,2000,900,-200,20\n";

TEST_F(Program, StudiesHowAircraftKeepApart) {
  const auto file = write("meetings.csv", kMeetings).string();
  const auto rows = [&](const std::string& method, const std::string& out) {
    const Finished done = run({"study", "avoidance", "--cases", file, "--method", method,
                               "--loss", "0.3", "--out", out});
    EXPECT_EQ(done.status, 0) << done.err;
    std::map<std::string, std::vector<std::string>> all;
    std::istringstream lines(read_file(folder_ / out));
    for (std::string line; std::getline(lines, line);) {
      std::vector<std::string> cells;
      std::istringstream row(line);
      for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
      all[cells.at(0)] = cells;
    }
    return all;
  };
  const auto none = rows("none", "none.csv");
  EXPECT_EQ(none.at("head-on-1").at(4), "1") << "they meet where nothing is done";
  for (const std::string method : {"auto", "negotiated", "priority", "rule"}) {
    const auto kept = rows(method, method + ".csv");
    EXPECT_EQ(kept.at("head-on-1").at(4), "0") << method;
    EXPECT_EQ(kept.at("head-on-1").at(9), "2") << method << ": both arrive";
    EXPECT_EQ(kept.at("apart-1").at(4), "0");
    EXPECT_LT(std::abs(std::stod(kept.at("apart-1").at(7))), 0.5) << "nothing to be done";
  }
  const Finished bad =
      run({"study", "avoidance", "--cases", write("bad.csv", "case,aircraft\n").string(),
           "--out", "b.csv"});
  EXPECT_NE(bad.status, 0);
  EXPECT_NE(bad.err.find("start_north_m"), std::string::npos) << bad.err;
  EXPECT_EQ(run({"study", "avoidance"}).status, 2);
}

TEST_F(Program, AStudyReportsEachRun) {
  const Finished finished =
      run({"study", "monitoring", "--out", "m", "--seeds", "1", "--only-cases", "no-wind",
           "--estimators", "qkf", "--strategies", "gus", "--set", "duration_s=10",
           "--log", "info"});
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_NE(finished.err.find("info: no-wind/gus/qkf/1: done in "), std::string::npos)
      << finished.err;
}

TEST_F(Program, AStudyRunsAgainWhatItsDataChanged) {
  write("wind.csv", "t_s,speed_mps,from_deg\n0,5,200\n60,6,210\n");
  const std::vector<std::string> study = {
      "study",        "monitoring",
      "--out",        "m",
      "--seeds",      "1",
      "--only-cases", "no-wind",
      "--estimators", "point-reset",
      "--strategies", "gus",
      "--set",        "duration_s=20",
      "--set",        "environment.wind={kind: series, file: wind.csv}"};
  const auto lines = [this] {
    const std::string journal = read_file(folder_ / "m" / "runs.jsonl");
    return std::count(journal.begin(), journal.end(), '\n');
  };
  EXPECT_EQ(run(study).status, 0);
  EXPECT_EQ(run(study).status, 0);
  EXPECT_EQ(lines(), 1) << "nothing has changed";
  write("wind.csv", "t_s,speed_mps,from_deg\n0,5,200\n60,9,210\n");
  EXPECT_EQ(run(study).status, 0);
  EXPECT_EQ(lines(), 2) << "the wind has";
}

TEST_F(Program, AFailedRunOfAStudyCanBeReplayed) {
  if (!kMemoryCanBeLimited) GTEST_SKIP() << "needs a limit of memory";
  // Too large for the memory that the study is given, not too large to be planned.
  const Finished failed =
      run({"study", "monitoring", "--out", "m", "--seeds", "1", "--only-cases", "no-wind",
           "--estimators", "ensemble", "--strategies", "gus", "--threads", "1", "--set",
           ("missions[0].estimator={kind: ensemble, members: 200, cell_m: 5, "
            "max_nodes: 200000}"),
           "--set", "duration_s=10"},
          RLIM_INFINITY, 350'000'000);
  EXPECT_EQ(failed.status, 1) << failed.err;
  EXPECT_NE(failed.err.find("not enough memory"), std::string::npos) << failed.err;
  EXPECT_NE(failed.err.find("Replay: skein run m/failed-no-wind-gus-ensemble-1.yaml"),
            std::string::npos)
      << failed.err;
  EXPECT_NE(failed.out.find("partial: 0 of 1 runs, 1 failed"), std::string::npos)
      << failed.out;
  EXPECT_TRUE(fs::exists(folder_ / "m" / "failed-no-wind-gus-ensemble-1.yaml"));
}

TEST_F(Program, AnInterruptedStudySaysThatItIsPartial) {
  const pid_t child =
      start({"study", "monitoring", "--out", "m", "--seeds", "100", "--only-cases",
             "no-wind", "--estimators", "qkf", "--strategies", "gus", "--threads", "1"});
  ASSERT_TRUE(appears(folder_ / "m" / "runs.jsonl"));
  for (int k = 0; k < 3000 && fs::file_size(folder_ / "m" / "runs.jsonl") == 0; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  const Finished stopped = finish(child);
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_NE(stopped.out.find("partial: "), std::string::npos) << stopped.out;
  EXPECT_NE(stopped.out.find(" of 100 runs"), std::string::npos) << stopped.out;
  EXPECT_NE(stopped.out.find("(n = "), std::string::npos) << stopped.out;
  const auto summary = nlohmann::json::parse(read_file(folder_ / "m" / "summary.json"));
  EXPECT_EQ(summary.at("state").get<std::string>().substr(0, 9), "partial: ");
}

TEST_F(Program, EachStudyHasHelpWithItsOwnOptionsOnly) {
  const Finished list = run({"study"});
  ASSERT_EQ(list.status, 0);
  std::istringstream lines(list.out);
  int studies = 0;
  for (std::string line; std::getline(lines, line); ++studies) {
    const std::string name = line.substr(0, line.find(' '));
    const Finished help = run({"study", name, "--help"});
    EXPECT_EQ(help.status, 0) << name;
    // Options that one study alone has.
    for (const auto& [option, owner] :
         std::map<std::string, std::string>{{"--gains", "tuning"},
                                            {"--nodes", "network"},
                                            {"--method", "avoidance"},
                                            {"--updates", "estimators"},
                                            {"--data", "bridge"}}) {
      EXPECT_EQ(help.out.find(option) != std::string::npos, name == owner)
          << name << " " << option;
    }
  }
  EXPECT_EQ(studies, 11);
}

TEST_F(Program, AStudyThatIsRefusedLeavesNothing) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"study", "estimators", "--seeds", "3"},
           {"study", "estimators", "--data", "nowhere"},
           {"study", "estimators", "--strategies", "foo"},
           {"study", "monitoring", "--data", "nowhere"},
           {"study", "bridge", "--only-cases", "no-wind"},
           {"study", "bridge", "--data", "nowhere"},
           {"study", "estimators", "--cases", "a.csv", "--updates", "b.csv"},
           {"study", "monitoring", "--estimators", "elephant"}}) {
    const Finished refused = run(arguments);
    EXPECT_EQ(refused.status, 2) << arguments[2] << refused.err;
    EXPECT_NE(refused.err, "");
  }
  EXPECT_FALSE(fs::exists(folder_ / "runs"));
}

TEST_F(Program, EstimatorsStudyComparesWhatIsShipped) {
  ASSERT_EQ(run({"study", "estimators", "--out", "e"}).status, 0);
  const auto summary = nlohmann::json::parse(read_file(folder_ / "e" / "summary.json"));
  EXPECT_LT(summary.at("mean_above/qkf_max_error_m"), 1e-8);
  // 1,000 samples where they are many, the Gaussian update where they run out; a bound
  // with noise of 0.1 sigma moves the mean by less than that.
  EXPECT_LT(summary.at("mean_above/particle_max_error_m"), 0.25);
  EXPECT_LT(summary.at("mean_below/particle_max_error_m"), 0.25);
}

TEST_F(Program, EstimatorsStudyChecksRows) {
  const auto rows =
      write("cases.csv", "kind,mu,sigma,lower,upper,sigma_v\nTN,0,1,0,inf,\n");
  const Finished good = run({"study", "estimators", "--cases", rows.string()});
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_NE(good.out.find("0.79788456080"), std::string::npos) << good.out;
  write("bad.csv", "kind,mu,sigma,lower,upper,sigma_v\nTN,0,-1,0,inf,\n");
  const Finished bad = run({"study", "estimators", "--cases", "bad.csv"});
  EXPECT_EQ(bad.status, 2);
  EXPECT_NE(bad.err.find("bad.csv:2"), std::string::npos) << bad.err;
}

TEST_F(Program, ACampaignFliesEveryCombinationUnderTheSameConditions) {
  write("base.yaml",
        "name: base\nduration_s: 20\nenvironment: {phenomena: []}\n"
        "aircraft: [{name: a}]\nmissions: []\n");
  write(
      "c.yaml",
      "name: pairs\nabout: [What for]\nscenario: base.yaml\nseeds: 2\n"
      "axes:\n"
      "  - {name: speed, variants: [{name: slow, set: "
      "[\"aircraft[0].plant.airspeed_mps=15\"]}, {name: fast}]}\n"
      "  - {name: radio, variants: [{name: fine}, {name: bad, set: [radio.loss=0.5]}]}\n"
      "draws:\n"
      "  - {key: environment.wind.speed_mps, between: [1, 9]}\n"
      "  - {key: environment.wind.from_deg, among: [\"10\", \"20\"]}\n"
      "figures: [{figure: simulated_s, digits: 0, extreme: least}]\n");
  const Finished first = run({"campaign", "c.yaml", "--out", "c"});
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_NE(first.out.find("slow   bad"), std::string::npos) << first.out;
  const auto summary = nlohmann::json::parse(read_file(folder_ / "c" / "summary.json"));
  EXPECT_EQ(summary.at("runs"), 8);
  EXPECT_EQ(summary.at("slow/fine/simulated_s"), 20);
  const std::string csv = read_file(folder_ / "c" / "runs.csv");
  EXPECT_EQ(csv.rfind("speed,radio,seed,content_hash", 0), 0u) << csv;
  EXPECT_TRUE(fs::exists(folder_ / "c" / "report.html"));

  EXPECT_EQ(run({"campaign", "c.yaml", "--out", "c"}).status, 0);
  const std::string journal = read_file(folder_ / "c" / "runs.jsonl");
  EXPECT_EQ(std::count(journal.begin(), journal.end(), '\n'), 8)
      << "nothing was run again";

  const Finished one = run({"campaign", "c.yaml", "--out", "one", "--only", "slow,bad",
                            "--seeds", "1", "--first-seed", "2", "--scenarios"});
  EXPECT_EQ(one.status, 0) << one.err;
  const std::string row = read_file(folder_ / "one" / "runs.csv");
  const std::string hash = row.substr(row.find("slow,bad,2,"), 30);
  EXPECT_NE(csv.find(hash), std::string::npos) << "seed 2 is the same run in both";

  EXPECT_EQ(run({"check", "one/scenarios/0001-slow-bad-2.yaml"}).status, 0);

  // What was drawn is the same for a seed in every cell, and within its range.
  EXPECT_EQ(run({"campaign", "c.yaml", "--out", "e", "--scenarios"}).status, 0);
  std::map<std::string, std::set<std::string>> speeds;  // by seed
  for (const auto& entry : fs::directory_iterator(folder_ / "e" / "scenarios")) {
    const std::string text = read_file(entry.path());
    const auto value = [&](const std::string& key) {
      const auto at = text.find("\n" + key) + key.size() + 1;
      return text.substr(at, text.find('\n', at) - at);
    };
    const std::string speed = value("    speed_mps: ");
    EXPECT_GE(std::stod(speed), 1) << speed;
    EXPECT_LE(std::stod(speed), 9) << speed;
    speeds[value("seed: ")].insert(speed);
  }
  ASSERT_EQ(speeds.size(), 2u);
  for (const auto& [seed, all] : speeds) EXPECT_EQ(all.size(), 1u) << seed;
  EXPECT_NE(*speeds.begin()->second.begin(), *speeds.rbegin()->second.begin());

  const Finished odd = run({"campaign", "c.yaml", "--out", "d", "--only", "slower"});
  EXPECT_EQ(odd.status, 2);
  EXPECT_NE(odd.err.find("slow fast fine bad"), std::string::npos) << odd.err;
  EXPECT_FALSE(fs::exists(folder_ / "d")) << "what is refused leaves nothing behind";
  write("typo.yaml",
        "name: x\nscenario: base.yaml\nseeds: 1\nfigures: [{figure: perff}]\n");
  const Finished typo = run({"campaign", "typo.yaml", "--out", "t"});
  EXPECT_NE(typo.err.find("no run has the figure perff"), std::string::npos) << typo.err;
  write("bad.yaml", "name: x\nscenario: base.yaml\nfigures: []\nseed: 3\n");
  const Finished bad = run({"campaign", "bad.yaml"});
  EXPECT_EQ(bad.status, 2);
  EXPECT_NE(bad.err.find("bad.yaml:4"), std::string::npos) << bad.err;
}

}  // namespace
}  // namespace skein::app
