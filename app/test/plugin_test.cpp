// SPDX-License-Identifier: Apache-2.0
// Kinds of the example's plugin, as a user meets them.
#include <algorithm>

#include "app/test/program.h"

namespace skein::app {
namespace {

constexpr const char* kPlugin = SKEIN_EXAMPLE_PLUGIN;

class PluginProgram : public Program {
 protected:
  // A short scenario that names the plugin, with kinds of it, and `more`.
  fs::path scenario(const std::string& more = "") {
    return write("mine.yaml",
                 "name: mine\nduration_s: 60\nplugins: ['" + std::string(kPlugin) +
                     "']\n" + "aircraft: [{sensors: [gnss, air-data, radiometer]}]\n" +
                     "missions: [{kind: perimeter, strategy: gus, estimator: circle}]\n" +
                     more);
  }
  static std::string hash_of(const fs::path& run) {
    return nlohmann::json::parse(read_file(run / "summary.json")).at("content_hash");
  }
};

TEST_F(PluginProgram, KindsStandBesideOurs) {
  const Finished list = run({"list", "estimator", "--plugin", kPlugin});
  EXPECT_EQ(list.status, 0) << list.err;
  EXPECT_NE(list.out.find("circle"), std::string::npos);
  EXPECT_NE(list.out.find("joint"), std::string::npos);
  EXPECT_EQ(run({"list", "estimator"}).out.find("circle"), std::string::npos);
  for (const char* command : {"schema", "keys"})
    EXPECT_NE(run({command, "--plugin", kPlugin}).out.find("shape_sd_m"),
              std::string::npos)
        << command;
}

TEST_F(PluginProgram, KeepsItsContract) {
  const Finished verified = run({"list", "--verify", "--plugin", kPlugin});
  EXPECT_EQ(verified.status, 0) << verified.out;
  EXPECT_EQ(verified.out,
            "agent smoke-watch: keeps its contract.\n"
            "estimator circle: keeps its contract.\n"
            "sensor radiometer: keeps its contract.\n"
            "task expanding_square: keeps its contract.\n");
}

TEST_F(PluginProgram, ARunSaysWhatRepeatsIt) {
  const Finished first =
      run({"run", scenario().string(), "--out", "first", "--trust", "."});
  ASSERT_EQ(first.status, 0) << first.err;
  const Finished again =
      run({"run", "first/scenario.yaml", "--out", "again", "--plugin", kPlugin});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(hash_of(folder_ / "first"), hash_of(folder_ / "again"));

  // The plugin of the command line is the scenario's from then on.
  const fs::path plain = write(
      "plain.yaml", "duration_s: 60\nmissions: [{kind: perimeter, estimator: circle}]\n");
  ASSERT_EQ(run({"check", plain.string()}).status, 2);
  const Finished given =
      run({"run", plain.string(), "--plugin", kPlugin, "--out", "given"});
  ASSERT_EQ(given.status, 0) << given.err;
  const Finished replay =
      run({"run", "given/scenario.yaml", "--out", "replay", "--trust", "given"});
  ASSERT_EQ(replay.status, 0) << replay.err;
  EXPECT_EQ(hash_of(folder_ / "given"), hash_of(folder_ / "replay"));
}

TEST_F(PluginProgram, WrongKeysAndKindsAreReportedLikeOurs) {
  const Finished range = run({"check", scenario().string(), "--trust", ".", "--set",
                              "aircraft[0].sensors[2]={kind: radiometer, share: 2}"});
  EXPECT_EQ(range.status, 2);
  EXPECT_NE(range.err.find("2 must be above 0 and below 1"), std::string::npos)
      << range.err;
  const Finished kind = run({"check", scenario().string(), "--trust", ".", "--set",
                             "missions[0].estimator=cirkle"});
  EXPECT_EQ(kind.status, 2);
  EXPECT_NE(kind.err.find("Did you mean \"circle\"?"), std::string::npos) << kind.err;
}

TEST_F(PluginProgram, TasksStandBesideOurs) {
  const Finished list = run({"list", "task", "--plugin", kPlugin});
  EXPECT_NE(list.out.find("expanding_square"), std::string::npos) << list.out;
  EXPECT_NE(list.out.find("orbit"), std::string::npos) << list.out;
  const Finished words = run({"keys", "tasks", "--plugin", kPlugin});
  EXPECT_NE(
      words.out.find("`expanding_square NORTH,EAST [spacing m] [legs N] [flown N]`"),
      std::string::npos)
      << words.out;
}

// Where a task of the plugin's kind is written wrongly, and what is wrong with it.
TEST_F(PluginProgram, WrongTasksAreReportedLikeOurs) {
  const fs::path file =
      write("wrong.yaml",
            "name: wrong\nplugins: ['" + std::string(kPlugin) + "']\n" +
                "missions:\n  - kind: tasks\n    tasks:\n"
                "      - {task: \"expanding_square 0,0 spacing 0\"}\n"
                "      - {task: \"expanding_circle 0,0\"}\n"
                "commands:\n  - {at_s: 5, do: \"task uav-1 expanding_square legs 3\"}\n");
  const Finished checked = run({"check", file.string(), "--trust", "."});
  EXPECT_EQ(checked.status, 2);
  for (const char* said :
       {"wrong.yaml:6:16 missions[0].tasks[0].task: the spacing is from 1 m to 10000 m.",
        "wrong.yaml:7:16 missions[0].tasks[1].task: \"expanding_circle\" is no task.",
        "wrong.yaml:9:19 commands[0].do: expanding_square: it needs a place."})
    EXPECT_NE(checked.err.find(said), std::string::npos) << said << "\n" << checked.err;
}

// One from a list, one that an operator commands, two that a team shares.
TEST_F(PluginProgram, ItsTaskIsFlownAloneAndByATeam) {
  std::string text = read_file(SKEIN_SOURCE_DIR "/example/my_kinds/search.yaml");
  const std::string plugin = "build/my_kinds.so";
  text.replace(text.find(plugin), plugin.size(), kPlugin);
  write("search.yaml", text);
  const Finished flown =
      run({"run", "search.yaml", "--trust", ".", "--out", "run", "--json"});
  ASSERT_EQ(flown.status, 0) << flown.err;
  const auto done_by = [&](const std::string& name) {
    return query(
        folder_ / "run/run.sqlite",
        "select count(*) from events join entities using (entity_id) where "
        "events.kind = 'task-done' and text like '%expanding_square%' and name = '" +
            name + "'");
  };
  EXPECT_EQ(done_by("lone-1"), 1);
  EXPECT_EQ(done_by("lone-2"), 1);
  EXPECT_EQ(done_by("team-1") + done_by("team-2"), 2);
  // Each of its corners is passed by who flew it.
  for (const char* corner : {"+ 300 - north_m", "+ 420 - north_m"})
    EXPECT_LT(query(folder_ / "run/run.sqlite",
                    "select min(abs(" + std::string(corner) +
                        ") + abs(300 - east_m)) from truth join entities using "
                        "(entity_id) where name = 'lone-1'"),
              60)
        << corner;
}

TEST_F(PluginProgram, StudiesTakePlugins) {
  const Finished study =
      run({"study", "monitoring", "--plugin", kPlugin, "--only-cases", "no-wind",
           "--estimators", "circle", "--strategies", "sweep", "--seeds", "1", "--set",
           "duration_s=60", "--set", "record.metrics_period_s=5", "--out", "study"});
  EXPECT_EQ(study.status, 0) << study.err;
  EXPECT_NE(study.out.find("circle"), std::string::npos) << study.out;
}

TEST_F(PluginProgram, WhatIsNoPluginIsRefused) {
  const Finished missing = run({"list", "--plugin", "nowhere.so"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_NE(missing.err.find("nowhere.so"), std::string::npos) << missing.err;
  const fs::path text = write("text.so", "no library");
  const Finished scenario_says = run(
      {"check", write("bad.yaml", "name: x\nplugins: [text.so]\nradio: none").string(),
       "--trust", "."});
  EXPECT_EQ(scenario_says.status, 2);
  EXPECT_NE(scenario_says.err.find("bad.yaml:2:11 plugins[0]"), std::string::npos)
      << scenario_says.err;
  EXPECT_EQ(scenario_says.err.find("unknown kind"), std::string::npos)
      << "kinds are not known without the plugin: " << scenario_says.err;
}

}  // namespace
}  // namespace skein::app
