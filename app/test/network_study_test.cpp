// SPDX-License-Identifier: Apache-2.0
// skein study network: the radio medium beside a packet-level simulator and theory.
#include <csignal>
#include <map>

#include "app/test/program.h"

namespace skein::app {
namespace {

using Figures = std::map<std::string, double>;

Figures figures_of(const fs::path& folder) {
  Figures figures;
  const auto summary =
      nlohmann::json::parse(read_file(folder / "summary.json"), nullptr, false);
  if (summary.is_object())
    for (const auto& [name, value] : summary.items())
      if (value.is_number()) figures[name] = value;
  return figures;
}

TEST_F(Program, StudyNetworkGridAgreesWithAPacketLevelSimulator) {
  const Finished done =
      run({"study", "network", "grid", "--nodes", "4,9,16", "--duration", "200"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_NE(done.out.find("cs91, RTS/CTS"), std::string::npos) << done.out;
  const fs::path folder = folder_ / "runs/study-network-grid";
  Figures figures = figures_of(folder);
  EXPECT_EQ(figures["runs"], 54);
  for (const std::string profile : {"nn4", "nn8", "cs91"})
    for (const std::string access : {"basic", "rts"})
      for (const std::string nodes : {"4", "9", "16"}) {
        const std::string cell = profile + "/" + access + "/" + nodes;
        ASSERT_TRUE(figures.contains(cell + "/delay_mean_off_percent")) << cell;
        // What is wanted for the same traffic is 3.5 %, 6 %, 0.3 points and 0.5 %. Other
        // traffic adds at most as much as the reference's own seeds scatter (nn4/basic/9:
        // 2.3 % and 8 % in a single seed).
        EXPECT_NEAR(figures[cell + "/delay_mean_off_percent"], 0, 5) << cell;
        EXPECT_NEAR(figures[cell + "/delay_p95_off_percent"], 0, 12) << cell;
        EXPECT_NEAR(figures[cell + "/loss_off_points"], 0, 0.3) << cell;
        EXPECT_NEAR(figures[cell + "/goodput_off_percent"], 0, 0.5) << cell;
      }
  const std::string page = read_file(folder / "report.html");
  EXPECT_NE(page.find("Mean delay, basic access"), std::string::npos);
  EXPECT_EQ(page.find("src=\"http"), std::string::npos) << "needs no network";
}

TEST_F(Program, StudyNetworkCellAgreesWithTheory) {
  const Finished done =
      run({"study", "network", "cell", "--seeds", "2", "--out", "cell"});
  ASSERT_EQ(done.status, 0) << done.err;
  Figures figures = figures_of(folder_ / "cell");
  for (const std::string access : {"basic", "rts"})
    for (const std::string stations : {"2", "5", "10", "20", "50"}) {
      const std::string cell = "cell/" + access + "/" + stations;
      EXPECT_NEAR(figures.at(cell + "/bianchi_off_percent"), 0, 3) << cell;
      // ns-3 was asked about the first three.
      if (const auto off = figures.find(cell + "/goodput_off_percent");
          off != figures.end()) {
        EXPECT_NEAR(off->second, 0, 2) << cell;
      }
    }
  EXPECT_TRUE(figures.contains("cell/basic/10/goodput_off_percent"));
}

TEST_F(Program, StudyNetworkHiddenAgreesWithAPacketLevelSimulator) {
  const Finished done = run({"study", "network", "hidden", "--out", "hidden"});
  ASSERT_EQ(done.status, 0) << done.err;
  Figures figures = figures_of(folder_ / "hidden");
  for (const std::string profile : {"nn4", "nn8", "cs91"})
    for (const std::string access : {"basic", "rts"}) {
      const std::string cell = profile + "/" + access + "/3";
      EXPECT_NEAR(figures.at(cell + "/goodput_off_percent"), 0, 3) << cell;
      EXPECT_NEAR(figures.at(cell + "/loss_off_points"), 0, 1) << cell;
    }
}

TEST_F(Program, StudyNetworkIsTheSameForAnyNumberOfThreads) {
  for (const char* threads : {"1", "4"})
    ASSERT_EQ(run({"study", "network", "grid", "--nodes", "4,9", "--duration", "20",
                   "--threads", threads, "--out", std::string("t") + threads})
                  .status,
              0);
  const std::string rows = read_file(folder_ / "t1/runs.csv");
  EXPECT_TRUE(rows.starts_with("profile,access,nodes,seed,content_hash,")) << rows;
  EXPECT_EQ(rows.find("cpu_s"), std::string::npos) << "differs from run to run";
  EXPECT_EQ(rows, read_file(folder_ / "t4/runs.csv"));
  EXPECT_EQ(read_file(folder_ / "t1/summary.json"),
            read_file(folder_ / "t4/summary.json"));
}

TEST_F(Program, StudyNetworkKeepsWhatIsDoneWhenItIsInterrupted) {
  // The small grids are done at once; hundreds of large ones take minutes.
  const std::vector<std::string> study = {
      "study", "network", "grid", "--nodes",   "2,400", "--seeds",    "100", "--profiles",
      "cs91",  "--out",   "cut",  "--threads", "2",     "--duration", "100"};
  const pid_t child = start(study);
  ASSERT_TRUE(appears(folder_ / "cut/runs.jsonl"));
  for (int k = 0; k < 3000 && fs::file_size(folder_ / "cut/runs.jsonl") == 0; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  const Finished cut = finish(child);
  EXPECT_EQ(cut.status, 130) << cut.err;
  EXPECT_NE(cut.out.find("partial: "), std::string::npos) << cut.out;
  EXPECT_NE(read_file(folder_ / "cut/runs.csv").find("\ncs91,basic,2,"),
            std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "cut/report.html"));
}

TEST_F(Program, StudyNetworkSaysWhatIsWrong) {
  const auto expect = [&](std::vector<std::string> more, const std::string& part) {
    std::vector<std::string> arguments = {"study", "network"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.status, 2) << finished.out;
    EXPECT_NE(finished.err.find(part), std::string::npos) << finished.err;
  };
  expect({},
         "the study network needs an experiment. There are: grid cell hidden mixed "
         "obstacle.");
  expect({"gird"}, "there is no experiment \"gird\"");
  expect({"grid", "--nodes", "1"}, "--nodes: 1 is no number of nodes from 2 to 2500.");
  expect({"grid", "--nodes", "4,x"}, "--nodes");
  expect({"grid", "--profiles", "nn5"}, "there is no radio \"nn5\"");
  expect({"grid", "--duration", "0"}, "--duration");
  expect({"cell", "--duration", "1"}, "lasts longer than 1 s");
  expect({"cell", "--profiles", "nn4"}, "--profiles has no meaning for the experiment");
  expect({"hidden", "--nodes", "4"}, "--nodes has no meaning for the experiment hidden.");
  expect({"grid", "--set", "a=1"}, "--set");
  EXPECT_FALSE(fs::exists(folder_ / "runs"));
  const Finished other = run({"study", "estimators", "grid"});
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("grid"), std::string::npos) << other.err;
}

}  // namespace
}  // namespace skein::app
