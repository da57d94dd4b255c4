// SPDX-License-Identifier: Apache-2.0
// How the program answers: help, lists, problems of scenarios, what it refuses.
#include <fcntl.h>

#include <algorithm>
#include <sstream>

#include "app/test/program.h"
#include "skein/base/random.h"

namespace skein::app {
namespace {

TEST_F(Program, SaysHowItIsUsed) {
  EXPECT_EQ(run({"--help"}).status, 0);
  for (const char* command : {"run", "check", "list", "schema", "keys", "fly", "plan",
                              "avoid", "report", "team", "study", "completion"}) {
    const Finished help = run({command, "--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_NE(help.out.find("--help"), std::string::npos) << command;
    EXPECT_NE(help.out.find("Examples:"), std::string::npos) << command;
  }
  const Finished wrong = run({"run", "x.yaml", "--sped", "3"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(std::count(wrong.err.begin(), wrong.err.end(), '\n'), 2)
      << "the error does not scroll away above the help:\n"
      << wrong.err;
  EXPECT_EQ(run({}).status, 2);
  EXPECT_EQ(run({"fly"}).status, 2);
  EXPECT_EQ(run({"run"}).status, 2);
  EXPECT_EQ(run({"--version"}).status, 0);
}

TEST_F(Program, CompletesAllItsCommands) {
  std::istringstream help(run({"--help"}).out);
  const std::string completion = run({"completion"}).out;
  const std::string begin = "commands=\"";
  const std::size_t at = completion.find(begin) + begin.size();
  const std::string completed =
      " " + completion.substr(at, completion.find('"', at) - at) + " ";
  std::string line;
  while (std::getline(help, line) && line != "Subcommands:") {
  }
  int commands = 0;
  for (std::string name; std::getline(help, line) && !line.empty(); ++commands) {
    ASSERT_TRUE(std::istringstream(line) >> name) << line;
    EXPECT_NE(completed.find(" " + name + " "), std::string::npos) << name;
  }
  EXPECT_GE(commands, 20);
}

TEST_F(Program, ListsKindsAndTheirKeys) {
  const Finished list = run({"list", "estimator"});
  EXPECT_EQ(list.status, 0);
  for (const char* kind : {"qkf", "mle", "map", "ukf", "qkf-a15", "particle",
                           "point-reset", "joint", "ensemble", "adaptive"})
    EXPECT_NE(list.out.find(std::string("  ") + kind + " "), std::string::npos) << kind;
  EXPECT_EQ(run({"list", "elephants"}).status, 2);
  const auto schema = nlohmann::json::parse(run({"schema"}).out, nullptr, false);
  ASSERT_FALSE(schema.is_discarded());
  EXPECT_TRUE(schema["properties"].contains("missions"));
}

TEST_F(Program, TheDocumentationOfKeysIsUpToDate) {
  EXPECT_EQ(run({"keys", "campaign"}).out,
            read_file(SKEIN_SOURCE_DIR "/docs/campaign-keys.md"))
      << "Renew it: build/release/skein keys campaign > docs/campaign-keys.md";
  EXPECT_EQ(run({"keys"}).out, read_file(SKEIN_SOURCE_DIR "/docs/scenario-keys.md"))
      << "Renew it: build/release/skein keys > docs/scenario-keys.md";
  EXPECT_EQ(run({"keys", "records"}).out,
            read_file(SKEIN_SOURCE_DIR "/docs/record-tables.md"))
      << "Renew it: build/release/skein keys records > docs/record-tables.md";
  EXPECT_EQ(run({"keys", "events"}).out, read_file(SKEIN_SOURCE_DIR "/docs/events.md"))
      << "Renew it: build/release/skein keys events > docs/events.md";
  EXPECT_EQ(run({"keys", "tasks"}).out, read_file(SKEIN_SOURCE_DIR "/docs/task-kinds.md"))
      << "Renew it: build/release/skein keys tasks > docs/task-kinds.md";
  EXPECT_EQ(run({"schema", "records"}).out,
            read_file(SKEIN_SOURCE_DIR "/web/common/records.ts"))
      << "Renew it: build/release/skein schema records > web/common/records.ts";
  EXPECT_EQ(run({"schema", "wire"}).out,
            read_file(SKEIN_SOURCE_DIR "/web/common/wire_table.ts"))
      << "Renew it: build/release/skein schema wire > web/common/wire_table.ts";
}

TEST_F(Program, ShippedScenariosAreGood) {
  int checked = 0;
  for (const auto& entry : fs::directory_iterator(SKEIN_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    if (entry.path().filename() == "bridge-fire.yaml") continue;  // the next test
    const Finished check = run({"check", entry.path().string()});
    EXPECT_EQ(check.status, 0) << check.err;
    ++checked;
  }
  EXPECT_GE(checked, 4);
}

TEST_F(Program, TheShippedScenarioOfAGivenFireIsGood) {
  const fs::path data = SKEIN_SHARED_DATA "/fires/bridge_2021";
  if (!fs::exists(data)) GTEST_SKIP() << "no " << data;
  const Finished check = run({"check", SKEIN_SOURCE_DIR "/scenarios/bridge-fire.yaml"});
  EXPECT_EQ(check.status, 0) << check.err;
}

TEST_F(Program, ReportsEveryProblemOfAScenarioWithItsPlace) {
  const auto file = write("bad.yaml",
                          "sed: 1\nduration_s: -5\naircraft:\n  - count: two\n"
                          "    plant: {kind: kinematic, airspeed_kmh: 70}\n");
  const Finished check = run({"check", file.string()});
  EXPECT_EQ(check.status, 2);
  for (const char* text :
       {"bad.yaml:1:1", "Did you mean \"seed\"?", "bad.yaml:2:13", "bad.yaml:4:12",
        "airspeed_mps", "4 problems; nothing was run."})
    EXPECT_NE(check.err.find(text), std::string::npos) << text << "\n" << check.err;
  EXPECT_EQ(run({"run", file.string()}).status, 2);
  EXPECT_FALSE(fs::exists(folder_ / "runs"));
}

TEST_F(Program, AnswersForMissingHugeAndBinaryScenarios) {
  EXPECT_EQ(run({"check", "nothing.yaml"}).status, 2);
  std::string huge = "name: x\naircraft:\n";
  while (huge.size() < 10'000'000) huge += "  - {name: a, cuont: 2}\n";
  const Finished answer = run({"check", write("huge.yaml", huge).string()});
  EXPECT_EQ(answer.status, 2);
  EXPECT_NE(answer.err.find("416666 elements"), std::string::npos) << answer.err;
  EXPECT_NE(answer.err.find("nothing was run."), std::string::npos);
  std::string binary;
  RandomStream random(1, 0, Purpose::kTest);
  for (int i = 0; i < 5000; ++i) binary += static_cast<char>(random.bits() & 255);
  EXPECT_EQ(run({"check", write("binary.yaml", binary).string()}).status, 2);
}

TEST_F(Program, SaysThatARunHasNoTimeOrNoAircraft) {
  const auto timeless = write("z.yaml", "duration_s: 0").string();
  for (const char* command : {"check", "run"}) {
    const Finished zero = run({command, timeless});
    EXPECT_EQ(zero.status, 2);
    EXPECT_NE(zero.err.find("duration_s: 0 must be above 0"), std::string::npos)
        << zero.err;
  }
  const auto empty = write("n.yaml", "duration_s: 20\naircraft: []").string();
  const Finished checked = run({"check", empty});
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_NE(checked.err.find("no aircraft: "), std::string::npos) << checked.err;
  const Finished nobody = run({"run", empty, "--out", "n", "--report"});
  EXPECT_EQ(nobody.status, 0) << nobody.err;
  EXPECT_NE(nobody.err.find("no aircraft: "), std::string::npos) << nobody.err;
  EXPECT_TRUE(fs::exists(folder_ / "n" / "report.html"));
}

TEST_F(Program, ShowsControlCharactersOfFilesByTheirNumbers) {
  const std::string name = "n\u202eo\u009b31m\u0085w";
  const auto file = write("c\x1b[31m.yaml", "name: " + name + "\n" + name + ": 1\n");
  const Finished refused = run({"check", file.string()});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("c\\x1b[31m.yaml:2:1"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("\\u202e"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("\\u009b31m\\u0085w"), std::string::npos) << refused.err;
  const auto fine = write("f.yaml", "duration_s: 1\nname: " + name);
  const Finished done = run({"run", fine.string(), "--out", "r", "--log", "info"});
  EXPECT_EQ(done.status, 0) << done.err;
  const Finished argument = run({"check", "--\x1b[31m"});
  EXPECT_EQ(argument.status, 2);
  for (const std::string& text :
       {refused.err, done.out, done.err, argument.err, argument.out})
    for (const char* steers : {"\x1b", "\u202e", "\u009b", "\u0085"})
      EXPECT_EQ(text.find(steers), std::string::npos) << text;
  // What other programs read stays as it is.
  const Finished printed = run({"check", fine.string(), "--print"});
  EXPECT_NE(printed.out.find("n\u202eo\u009b31m"), std::string::npos) << printed.out;
}

TEST_F(Program, ListsNamesInAColumnOfTheirOwn) {
  const Finished list = run({"list"});
  EXPECT_EQ(list.status, 0);
  std::istringstream lines(list.out);
  for (std::string line; std::getline(lines, line);) {
    if (line.ends_with(":") && line[0] != ' ') continue;
    const std::size_t end = line.find("  ", 2);
    ASSERT_NE(end, std::string::npos) << line;
    EXPECT_EQ(line.find(' ', 2), end) << "the name runs into its help: " << line;
  }
}

TEST_F(Program, RefusesAnAircraftInsideTerrain) {
  const auto file = write("t.yaml",
                          "environment: {terrain: {kind: flat, elevation_m: 500}}\n"
                          "aircraft: [{start: {altitude_msl_m: 100}}]");
  const Finished refused = run({"run", file.string()});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("inside terrain"), std::string::npos) << refused.err;
}

TEST_F(Program, RefusesDamagedData) {
  // A raster cut off in the middle, and a wind table with a hole in it.
  write("cut.tif", std::string("II*\0\x08\0\0\0", 8));
  const Finished raster =
      run({"check", write("r.yaml",
                          "environment: {terrain: {kind: raster, file: "
                          "cut.tif}}")
                        .string()});
  EXPECT_EQ(raster.status, 2);
  EXPECT_NE(raster.err.find("cut.tif"), std::string::npos) << raster.err;
  write("wind.csv", "t_s,speed_mps,from_deg\n0,5,200\n60,nan,210\n");
  const Finished wind = run(
      {"check",
       write("w.yaml", "environment: {wind: {kind: series, file: wind.csv}}").string()});
  EXPECT_EQ(wind.status, 2);
  EXPECT_NE(wind.err.find("wind.csv"), std::string::npos) << wind.err;
}

TEST_F(Program, SaysWhenTheFolderCannotBeWritten) {
  const auto file = write("s.yaml", "duration_s: 5");
  write("occupied", "a file where the folder should be");
  const Finished refused = run({"run", file.string(), "--out", "occupied/run"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("occupied"), std::string::npos) << refused.err;
  EXPECT_EQ(run({"run", file.string(), "--out", "a"}).status, 0);
  const Finished again = run({"run", file.string(), "--out", "a"});
  EXPECT_EQ(again.status, 2) << "a run that is there is not replaced unasked";
}

TEST_F(Program, AResultThatIsLostIsAFailure) {
  const auto file = write("s.yaml", "duration_s: 2").string();
  const auto rows =
      write("cases.csv", "kind,mu,sigma,lower,upper,sigma_v\nTN,0,1,0,inf,\n").string();
  const std::vector<std::vector<std::string>> commands = {
      {"--help"},
      {"--version"},
      {"list"},
      {"schema"},
      {"keys"},
      {"completion"},
      {"check", file, "--print"},
      {"run", file, "--json"},
      {"study"},
      {"study", "estimators", "--cases", rows}};
  for (const auto& command : commands) {
    const int device = open("/dev/full", O_WRONLY);
    ASSERT_GE(device, 0);
    const Finished full = run_into(device, command);
    close(device);
    EXPECT_EQ(full.status, 1) << command[0];
    EXPECT_NE(full.err.find("standard output cannot be written"), std::string::npos)
        << command[0] << full.err;
  }
}

TEST_F(Program, AReaderThatHasGoneIsNoFailure) {
  for (const char* command : {"list", "schema", "keys"}) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    close(ends[0]);
    const Finished cut = run_into(ends[1], {command});
    close(ends[1]);
    EXPECT_EQ(cut.status, 0) << command;
    EXPECT_EQ(cut.err, "") << command;
  }
}

TEST_F(Program, StaysWithinItsFolderWhateverTheName) {
  const std::vector<std::pair<const char*, const char*>> names = {
      {"../../evil", "evil"}, {"/tmp/evil", "tmp-evil"}, {"", "run"},
      {"..", "run"},          {".hidden", "hidden"},     {"Feuer 1.5", "Feuer-1.5"}};
  for (const auto& [name, folder] : names) {
    const auto file =
        write("s.yaml", "duration_s: 1\nname: \"" + std::string(name) + "\"\n");
    EXPECT_EQ(run({"run", file.string()}).status, 0);
    EXPECT_TRUE(fs::exists(folder_ / "runs" / folder / "summary.json") ||
                fs::exists(folder_ / "runs" / (std::string(folder) + "-2")))
        << name;
  }
  EXPECT_FALSE(fs::exists(folder_.parent_path() / "evil"));
  EXPECT_FALSE(fs::exists("/tmp/evil"));
}

TEST_F(Program, SaysWhenMemoryIsNotEnough) {
  if (!kMemoryCanBeLimited) GTEST_SKIP() << "needs a limit of memory";
  const auto file =
      write("s.yaml",
            "duration_s: 5\nmissions: [{kind: perimeter, estimator: {kind: ensemble, "
            "members: 200, cell_m: 5, max_nodes: 200000}}]\n");
  const Finished big = run({"run", file.string()}, RLIM_INFINITY, 350'000'000);
  EXPECT_EQ(big.status, 1) << big.err;
  EXPECT_NE(big.err.find("not enough memory"), std::string::npos) << big.err;
}

TEST_F(Program, SaysWhenAFolderOrScenarioMayNotBeRead) {
  if (geteuid() == 0) GTEST_SKIP() << "permissions do not bind the superuser";
  const auto file = write("s.yaml", "duration_s: 1");
  fs::create_directory(folder_ / "runs");
  fs::permissions(folder_ / "runs", fs::perms::none);
  const Finished refused = run({"run", file.string()});
  EXPECT_EQ(refused.status, 1) << refused.err;
  EXPECT_NE(refused.err.find("runs"), std::string::npos) << refused.err;
  fs::permissions(folder_ / "runs", fs::perms::owner_all);
  fs::permissions(file, fs::perms::none);
  const Finished secret = run({"check", file.string()});
  EXPECT_EQ(secret.status, 2);
  EXPECT_NE(secret.err.find("cannot be read"), std::string::npos) << secret.err;
}

}  // namespace
}  // namespace skein::app
