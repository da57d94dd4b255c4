// The program as a user meets it: exit statuses, messages, interrupts, kills, full disks.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "base/random.h"

namespace skein {
namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class Program : public testing::Test {
 protected:
  struct Finished {
    int status = -1;  // exit status, or -signal
    std::string out, err;
  };

  Program() {
    std::string pattern = (fs::temp_directory_path() / "program-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~Program() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  // Starts the program in the scratch folder; `file_limit` bounds the size of its files,
  // `memory_limit` its address space [bytes].
  pid_t start(std::vector<std::string> arguments, rlim_t file_limit = RLIM_INFINITY,
              rlim_t memory_limit = RLIM_INFINITY, int out = -1) {
    arguments.insert(arguments.begin(), SKEIN_PROGRAM);
    const pid_t child = fork();
    if (child != 0) return child;
    if (chdir(folder_.c_str()) != 0) _exit(99);
    if (!freopen("out.txt", "w", stdout) || !freopen("err.txt", "w", stderr)) _exit(99);
    if (out >= 0) dup2(out, STDOUT_FILENO);
    const rlimit limit{file_limit, file_limit}, memory{memory_limit, memory_limit};
    setrlimit(RLIMIT_FSIZE, &limit);
    setrlimit(RLIMIT_AS, &memory);
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    execv(SKEIN_PROGRAM, argv.data());
    _exit(99);
  }

  Finished finish(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    Finished result;
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    result.out = read_file(folder_ / "out.txt");
    result.err = read_file(folder_ / "err.txt");
    return result;
  }

  Finished run(std::vector<std::string> arguments, rlim_t file_limit = RLIM_INFINITY,
               rlim_t memory_limit = RLIM_INFINITY) {
    return finish(start(std::move(arguments), file_limit, memory_limit));
  }

  // With standard output going to an open file.
  Finished run_into(int out, std::vector<std::string> arguments) {
    return finish(start(std::move(arguments), RLIM_INFINITY, RLIM_INFINITY, out));
  }

  // Waits for a file of a program that was started, not for ever.
  static bool appears(const fs::path& file) {
    for (int k = 0; k < 3000 && !fs::exists(file); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return fs::exists(file);
  }

  // The one number that a query gives; NaN when it gives none.
  static double query(const fs::path& database, const std::string& sql) {
    sqlite3* db = nullptr;
    double value = std::numeric_limits<double>::quiet_NaN();
    if (sqlite3_open_v2(database.c_str(), &db, SQLITE_OPEN_READWRITE, nullptr) ==
        SQLITE_OK) {
      sqlite3_exec(
          db, sql.c_str(),
          [](void* to, int, char** values, char**) {
            if (values[0]) *static_cast<double*>(to) = std::atof(values[0]);
            return 0;
          },
          &value, nullptr);
    }
    sqlite3_close(db);
    return value;
  }

  // Of a shipped scenario's first seconds.
  std::string hash_of(const std::string& scenario, int seconds,
                      std::vector<std::string> more) {
    std::vector<std::string> arguments = {
        "run",    SKEIN_SOURCE_DIR "/scenarios/" + scenario + ".yaml",
        "--json", "--overwrite",
        "--out",  "run",
        "--set",  "duration_s=" + std::to_string(seconds)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished finished = run(arguments);
    EXPECT_EQ(finished.status, 0) << finished.err;
    const auto summary = nlohmann::json::parse(finished.out, nullptr, false);
    return summary.is_discarded() ? "" : summary.value("content_hash", "");
  }

  fs::path folder_;
};

TEST_F(Program, SaysHowItIsUsed) {
  EXPECT_EQ(run({"--help"}).status, 0);
  for (const char* command :
       {"run", "check", "list", "schema", "keys", "report", "study", "completion"}) {
    const Finished help = run({command, "--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_NE(help.out.find("--help"), std::string::npos) << command;
    EXPECT_NE(help.out.find("Examples:"), std::string::npos) << command;
  }
  const Finished wrong = run({"run", "x.yaml", "--sped", "3"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(std::count(wrong.err.begin(), wrong.err.end(), '\n'), 2)
      << "the fault does not scroll away above the help:\n"
      << wrong.err;
  EXPECT_EQ(run({}).status, 2);
  EXPECT_EQ(run({"fly"}).status, 2);
  EXPECT_EQ(run({"run"}).status, 2);
  EXPECT_EQ(run({"--version"}).status, 0);
}

TEST_F(Program, ListsKindsAndTheirKeys) {
  const Finished list = run({"list", "estimator"});
  EXPECT_EQ(list.status, 0);
  for (const char* kind : {"qkf", "mle", "map", "ukf", "qkf-a15", "particle",
                           "point-reset", "joint", "ensemble"})
    EXPECT_NE(list.out.find(std::string("  ") + kind + " "), std::string::npos) << kind;
  EXPECT_EQ(run({"list", "elephants"}).status, 2);
  const auto schema = nlohmann::json::parse(run({"schema"}).out, nullptr, false);
  ASSERT_FALSE(schema.is_discarded());
  EXPECT_TRUE(schema["properties"].contains("monitoring"));
}

TEST_F(Program, TheDocumentationOfKeysIsUpToDate) {
  EXPECT_EQ(run({"keys"}).out, read_file(SKEIN_SOURCE_DIR "/docs/scenario-keys.md"))
      << "Renew it: build/release/skein keys > docs/scenario-keys.md";
}

TEST_F(Program, ShippedScenariosAreGood) {
  int checked = 0;
  for (const auto& entry : fs::directory_iterator(SKEIN_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    if (entry.path().filename() == "bridge-fire.yaml" && !fs::exists(SKEIN_SHARED_DATA))
      continue;  // its data is not part of the project
    const Finished check = run({"check", entry.path().string()});
    EXPECT_EQ(check.status, 0) << check.err;
    ++checked;
  }
  EXPECT_GE(checked, 4);
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

TEST_F(Program, RunsNothingAtAllCleanly) {
  const Finished zero =
      run({"run", write("z.yaml", "duration_s: 0").string(), "--report"});
  EXPECT_EQ(zero.status, 0) << zero.err;
  const Finished nobody =
      run({"run", write("n.yaml", "duration_s: 20\naircraft: []").string(), "--out", "n",
           "--report"});
  EXPECT_EQ(nobody.status, 0) << nobody.err;
  EXPECT_TRUE(fs::exists(folder_ / "n" / "report.html"));
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
  const auto file = write("s.yaml",
                          "duration_s: 5\nmonitoring: {estimator: {kind: ensemble, "
                          "members: 200, cell_m: 0.5, max_nodes: 10000000}}\n");
  const Finished big = run({"run", file.string()}, RLIM_INFINITY, 800'000'000);
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

TEST_F(Program, AFullDiskEndsTheRunAndKeepsWhatWasWritten) {
  const auto file = write("s.yaml", "duration_s: 3000\naircraft: [{count: 6}]");
  const Finished full = run({"run", file.string(), "--out", "full"}, 3'000'000);
  EXPECT_EQ(full.status, 1) << full.err;
  for (const char* text : {"run.sqlite", "s of simulated time)", "Replay: skein run "})
    EXPECT_NE(full.err.find(text), std::string::npos) << text << "\n" << full.err;
  EXPECT_GT(query(folder_ / "full" / "run.sqlite", "select count(*) from truth"), 100);
}

TEST_F(Program, TheLogSaysWhatHappens) {
  write("s.yaml", "duration_s: 60\naircraft: [{count: 2}]\n");
  const Finished quiet = run({"run", "s.yaml", "--out", "quiet"});
  EXPECT_EQ(quiet.err, "");
  const Finished told = run({"run", "s.yaml", "--out", "told", "--log", "info"});
  EXPECT_EQ(told.status, 0);
  EXPECT_NE(told.err.find("info: 0.0 s, scout-2: joined: "), std::string::npos)
      << told.err;
  EXPECT_EQ(run({"run", "s.yaml", "--log", "loud"}).status, 2);
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
  EXPECT_EQ(run({"study", "elephants"}).status, 2);
  EXPECT_EQ(run({"study", "monitoring", "--estimators", "elephant"}).status, 2);
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
  // Too large for the memory that the study is given, not too large to be planned.
  const Finished failed =
      run({"study", "monitoring", "--out", "m", "--seeds", "1", "--only-cases", "no-wind",
           "--estimators", "ensemble", "--strategies", "gus", "--threads", "1", "--set",
           ("monitoring.estimator={kind: ensemble, members: 200, cell_m: 0.5, "
            "max_nodes: 10000000}"),
           "--set", "duration_s=10"},
          RLIM_INFINITY, 800'000'000);
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

}  // namespace
}  // namespace skein
