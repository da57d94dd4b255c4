// SPDX-License-Identifier: Apache-2.0
// Folders of runs: who may write into them, what is said of damaged and unfinished ones,
// and where commands write what they make.
#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <cctype>
#include <csignal>
#include <set>
#include <sstream>

#include "app/test/program.h"

namespace skein::app {
namespace {

constexpr const char* kShort = "duration_s: 40\naircraft: [{count: 2}]\n";
constexpr rlim_t kMemory = 1500ul << 20;  // of address space, most of it never touched

std::vector<std::string> readers(const std::string& run) {
  return {"report " + run, "team messages " + run,
          "export " + run + " --what tracks --out t.geojson",
          "run --replay " + run + " --out again-" + run};
}

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), {}};
}

TEST_F(Program, ARowOutOfAllBoundsIsNamedByEveryReader) {
  write("s.yaml", kShort);
  ASSERT_EQ(run({"run", "s.yaml", "--out", "bad"}).status, 0);
  query(folder_ / "bad/run.sqlite",
        "update truth set rowid = 9223372036854775807 where rowid = 100");
  std::vector<std::string> all = readers("bad");
  all.push_back("replay bad --serve 0");
  for (const std::string& line : all) {
    const Finished read =
        run(words_of(line), RLIM_INFINITY, kMemoryCanBeLimited ? kMemory : RLIM_INFINITY);
    EXPECT_EQ(read.status, 2) << line << "\n" << read.err;
    for (const char* word : {"table truth", "9223372036854775807", "100000000000"})
      EXPECT_NE(read.err.find(word), std::string::npos) << line << "\n" << read.err;
  }
}

TEST_F(Program, ReplayEndsAtTheFirstCtrlC) {
  write("s.yaml", kShort);
  ASSERT_EQ(run({"run", "s.yaml", "--out", "r"}).status, 0);
  const pid_t child = start({"replay", "r", "--serve", "0"});
  const fs::path err = folder_ / "err.txt";
  for (int k = 0; k < 3000 && read_file(err).find("The page") == std::string::npos; ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGINT);
  EXPECT_EQ(finish(child).status, 0);
}

TEST_F(Program, TwoRunsInOneFolderAreImpossible) {
  write("s.yaml", "duration_s: 100000\naircraft: [{count: 1}]\n");
  write("t.yaml", kShort);
  prefix_ = "first-";
  const pid_t first =
      start({"run", "s.yaml", "--out", "r", "--seed", "1", "--speed", "real"});
  ASSERT_TRUE(appears(folder_ / "r/scenario.yaml"));
  prefix_ = "";
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, std::vector<std::string>{"--overwrite"}}) {
    std::vector<std::string> arguments = {"run", "t.yaml", "--out", "r", "--seed", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished second = run(arguments);
    EXPECT_EQ(second.status, 2);
    EXPECT_NE(second.err.find("process " + std::to_string(first)), std::string::npos)
        << second.err;
  }
  // Who reads is not kept out.
  EXPECT_EQ(run({"report", "r", "--out", "r.html"}).status, 0);
  EXPECT_EQ(
      run({"export", "r", "--what", "tracks", "--at", "0", "--out", "t.geojson"}).err,
      run({"export", "r", "--what", "tracks", "--at", "0", "--out", "t.geojson"}).err);
  kill(first, SIGINT);
  prefix_ = "first-";
  EXPECT_EQ(finish(first).status, 130);
  prefix_ = "";
  const auto summary = nlohmann::json::parse(read_file(folder_ / "r/summary.json"));
  EXPECT_EQ(summary["seed"], 1);
  EXPECT_NE(read_file(folder_ / "r/scenario.yaml").find("seed: 1\n"), std::string::npos);
  EXPECT_EQ(query(folder_ / "r/run.sqlite",
                  "select count(*) from meta where name = 'seed' and value = '1'"),
            1);
  // A run that was killed keeps nobody out.
  prefix_ = "second-";
  const pid_t killed = start({"run", "s.yaml", "--out", "k", "--speed", "real"});
  ASSERT_TRUE(appears(folder_ / "k/scenario.yaml"));
  kill(killed, SIGKILL);
  finish(killed);
  prefix_ = "";
  EXPECT_EQ(run({"run", "t.yaml", "--out", "k", "--overwrite"}).status, 0);
}

TEST_F(Program, TwoCampaignsInOneFolderAreImpossible) {
  write("s.yaml", "duration_s: 20000\naircraft: [{count: 6}]\n");
  write("c.yaml",
        "name: c\nscenario: s.yaml\nseeds: 4\nfigures: [{figure: accidents}]\n");
  prefix_ = "first-";
  const pid_t first = start({"campaign", "c.yaml", "--out", "f"});
  ASSERT_TRUE(appears(folder_ / "f/runs.jsonl")) << read_file(folder_ / "first-err.txt");
  prefix_ = "";
  const Finished second = run({"campaign", "c.yaml", "--out", "f"});
  EXPECT_EQ(second.status, 2) << second.err;
  EXPECT_NE(second.err.find("process " + std::to_string(first)), std::string::npos)
      << second.err;
  const Finished third = run({"run", "s.yaml", "--out", "f"});
  EXPECT_EQ(third.status, 2) << third.err;
  kill(first, SIGKILL);
  prefix_ = "first-";
  finish(first);
}

TEST_F(Program, FoldersOfRunsThatHardlyBeganAreNamedRightly) {
  fs::create_directory(folder_ / "nothing");
  fs::create_directory(folder_ / "empty");
  write("empty/run.sqlite", "");
  fs::create_directory(folder_ / "early");
  write("early/scenario.yaml", kShort);
  fs::create_directory(folder_ / "bare");
  write("s.yaml", kShort);
  ASSERT_EQ(run({"run", "s.yaml", "--out", "whole"}).status, 0);
  fs::copy(folder_ / "whole/run.sqlite", folder_ / "bare/run.sqlite");
  const auto expect = [&](const std::string& line, const std::string& text) {
    const Finished read = run(words_of(line));
    EXPECT_EQ(read.status, 2) << line;
    EXPECT_NE(read.err.find(text), std::string::npos) << line << "\n" << read.err;
  };
  for (const std::string& line : readers("nothing")) {
    if (line.starts_with("team")) continue;
    expect(line, "neither run.sqlite nor scenario.yaml");
  }
  expect("report empty", "ended before anything was recorded");
  expect("report early", "ended before it began");
  expect("run --replay early --out x", "ended before it began");
  expect("run --replay bare --out x", "without their scenario.yaml");
  expect("export bare --what tracks --out t.geojson", "without their scenario.yaml");
  expect("replay bare --serve 0", "without their scenario.yaml");
  EXPECT_EQ(run({"report", "bare"}).status, 0) << "what there is is shown";
}

TEST_F(Program, ARunOfAnotherVersionIsDoneAgainByThatOnly) {
  write("s.yaml", "duration_s: 2\naircraft: [{count: 1}]\n");
  ASSERT_EQ(run({"run", "s.yaml", "--out", "old"}).status, 0);
  EXPECT_EQ(run({"run", "--replay", "old", "--out", "same"}).status, 0);
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((folder_ / "old/run.sqlite").c_str(), &database), SQLITE_OK);
  sqlite3_exec(database, "UPDATE meta SET value = '0.1.0+gabc' WHERE name = 'version'",
               nullptr, nullptr, nullptr);
  sqlite3_close(database);
  const Finished again = run({"run", "--replay", "old", "--out", "again"});
  EXPECT_EQ(again.status, 2);
  EXPECT_NE(again.err.find("recorded by Skein 0.1.0+gabc; that version does it again"),
            std::string::npos)
      << again.err;
  EXPECT_FALSE(fs::exists(folder_ / "again"));
  EXPECT_EQ(run({"report", "old"}).status, 0);
}

TEST_F(Program, ARunThatWasInterruptedBeforeItsFirstStepIsDoneAgain) {
  write("s.yaml", "duration_s: 600\naircraft: [{count: 2}]\n");
  // The signal comes when the records have been opened, before or after the first step;
  // both are done again.
  bool seen = false;
  for (int k = 0; k < 40 && !seen; ++k) {
    const pid_t child =
        start({"run", "s.yaml", "--out", "i", "--overwrite", "--speed", "real"});
    while (!fs::exists(folder_ / "i/run.sqlite")) std::this_thread::yield();
    kill(child, SIGINT);
    const Finished stopped = finish(child);
    if (stopped.status != 130) continue;  // not yet caught, or over
    const auto summary =
        nlohmann::json::parse(read_file(folder_ / "i/summary.json"), nullptr, false);
    if (summary.is_discarded()) continue;
    seen = summary.at("steps") == 0;
    const Finished again = run({"run", "--replay", "i", "--out", "again", "--overwrite"});
    EXPECT_NE(again.err.find("The same content hash"), std::string::npos)
        << again.err << summary.dump(1);
  }
  EXPECT_TRUE(seen) << "no run was interrupted that early";
}

TEST_F(Program, LeavesDevicesAndPipesAlone) {
  write("s.yaml", kShort);
  write("nodes.csv", "name,north_m,east_m,altitude_m\na,0,0,10\nb,50,0,10\n");
  ASSERT_EQ(run({"run", "s.yaml", "--out", "r"}).status, 0);
  // A device of its own: the test may be run by root.
  const fs::path device = folder_ / "null";
  const bool made = ::mknod(device.c_str(), S_IFCHR | 0666, ::makedev(1, 3)) == 0;
  const int probe = made ? ::open(device.c_str(), O_WRONLY) : -1;
  if (probe < 0) GTEST_SKIP() << "no device can be made here";
  ::close(probe);
  fs::create_symlink("null", folder_ / "link.html");
  fs::create_symlink("null", folder_ / "link.geojson");
  fs::create_symlink("null", folder_ / "link.svg");
  for (const std::string& line :
       {std::string("report r --out null"), std::string("report r --out link.html"),
        std::string("export r --what tracks --out link.geojson"),
        std::string("team messages r --out null"),
        std::string("plan connect --from 0,0,0 --to 500,100,90 --airspeed 20 "
                    "--turn-radius 60 --out link.svg")}) {
    const Finished done = run(words_of(line));
    EXPECT_EQ(done.status, 0) << line << "\n" << done.err;
    EXPECT_TRUE(fs::is_character_file(device)) << line;
  }
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.html"));
  // Nothing is left beside them.
  for (const fs::directory_entry& each : fs::directory_iterator(folder_))
    EXPECT_EQ(each.path().filename().string().find(".skein"), std::string::npos)
        << each.path();
  // Standard output goes on behind what is written into it.
  const int log = ::open((folder_ / "log").c_str(), O_RDWR | O_CREAT | O_APPEND, 0600);
  ASSERT_EQ(::write(log, "before\n", 7), 7);
  EXPECT_EQ(run_into(log, {"team", "messages", "r", "--out", "/dev/stdout"}).status, 0);
  ::close(log);
  const std::string text = read_file(folder_ / "log");
  EXPECT_TRUE(text.starts_with("before\nphase,from_s")) << text.substr(0, 100);
  EXPECT_NE(text.find("Each message is as long"), std::string::npos);
}

// All numbers of JSON text; what is none stands as null.
void no_infinite_text(const std::string& text, const std::string& what) {
  for (const char* word : {"nan", "inf", "NaN", "Infinity", "-nan", "-inf"}) {
    const std::string name = word;
    for (std::size_t at = text.find(name); at != std::string::npos;
         at = text.find(name, at + 1)) {
      const auto is_letter = [&](std::size_t k) {
        return k < text.size() && (std::isalpha(static_cast<unsigned char>(text[k])) ||
                                   text[k] == '_' || text[k] == '.');
      };
      // A word of its own, as a number would stand.
      if ((at > 0 && is_letter(at - 1)) || is_letter(at + name.size())) continue;
      ADD_FAILURE() << what << ": " << text.substr(at > 30 ? at - 30 : 0, 80);
      return;
    }
  }
}

// Of all cells of all tables how many are infinite.
int infinite_cells(const fs::path& file, std::string& where) {
  sqlite3* database = nullptr;
  int count = 0;
  if (sqlite3_open_v2(file.c_str(), &database, SQLITE_OPEN_READONLY, nullptr) !=
      SQLITE_OK)
    return -1;
  const auto list = [&](const std::string& sql) {
    std::vector<std::string> all;
    sqlite3_exec(
        database, sql.c_str(),
        [](void* to, int, char** values, char**) {
          static_cast<std::vector<std::string>*>(to)->push_back(values[0] ? values[0]
                                                                          : "");
          return 0;
        },
        &all, nullptr);
    return all;
  };
  for (const std::string& table :
       list("select name from sqlite_master where type = 'table'"))
    for (const std::string& column :
         list("select name from pragma_table_info('" + table + "')")) {
      const auto found = list("select count(*) from " + table + " where " + column +
                              " in (9e999, -9e999)");
      const int here = found.empty() ? 0 : std::atoi(found[0].c_str());
      if (here > 0) where += table + "." + column + " ";
      count += here;
    }
  sqlite3_close(database);
  return count;
}

void expect_finite(const fs::path& folder) {
  std::string where;
  EXPECT_EQ(infinite_cells(folder / "run.sqlite", where), 0) << folder << ": " << where;
  no_infinite_text(read_file(folder / "summary.json"),
                   (folder / "summary.json").string());
  const std::string page = read_file(folder / "report.html");
  const auto begin = page.find("id=\"data\">");
  ASSERT_NE(begin, std::string::npos);
  const std::string data =
      page.substr(begin + 10, page.find("</script>", begin) - begin - 10);
  const auto parsed = nlohmann::json::parse(data, nullptr, false);
  EXPECT_FALSE(parsed.is_discarded()) << folder;
}

TEST_F(Program, NoTableAndNoFileHasAnInfiniteNumberInAStorm) {
  const fs::path storm = fs::path(SKEIN_SHARED_DATA) / "borders/summary-inf-wind60.yaml";
  if (!fs::exists(storm)) GTEST_SKIP() << "needs " << storm;
  const Finished flown =
      run({"run", storm.string(), "--out", "r", "--report", "--set", "duration_s=60"});
  ASSERT_EQ(flown.status, 0) << flown.err;
  expect_finite(folder_ / "r");
  for (const char* word : {"inf", "nan"})
    EXPECT_EQ(flown.out.find(std::string(" ") + word), std::string::npos) << flown.out;
}

// The first seconds of what is shipped: of a few, of all with SKEIN_ALL_SCENARIOS=1.
TEST_F(Program, NoShippedScenarioRecordsAnInfiniteNumber) {
  const std::set<std::string> few = {"wildfire", "tasks",   "zones",         "tracking",
                                     "team",     "survey",  "keeping",       "formation",
                                     "crossing", "spoofed", "thesis-no-wind"};
  const bool all = std::getenv("SKEIN_ALL_SCENARIOS") != nullptr;
  std::size_t flown = 0;
  for (const fs::directory_entry& each :
       fs::directory_iterator(SKEIN_SOURCE_DIR "/scenarios")) {
    const fs::path& file = each.path();
    const std::string name = file.stem().string();
    // Vehicles and flight models elsewhere would be waited for.
    if (file.extension() != ".yaml" || name.starts_with("mixed") ||
        name == "flightgear" || (!all && !few.contains(name)))
      continue;
    const Finished done =
        run({"run", file.string(), "--out", name, "--report", "--set", "duration_s=5"});
    EXPECT_EQ(done.status, 0) << file << done.err;
    if (done.status != 0) continue;
    ++flown;
    expect_finite(folder_ / name);
    fs::remove_all(folder_ / name);
  }
  EXPECT_GE(flown, few.size());
}

// The documents say which version of the tables the program writes.
TEST_F(Program, TheVersionOfTheTablesIsWhatTheDocumentsSay) {
  write("s.yaml", "duration_s: 1\naircraft: [{count: 1}]\n");
  ASSERT_EQ(run({"run", "s.yaml", "--out", "r"}).status, 0);
  const int version =
      static_cast<int>(query(folder_ / "r/run.sqlite", "pragma user_version"));
  const std::string text = read_file(SKEIN_SOURCE_DIR "/docs/records.md");
  EXPECT_NE(text.find("`PRAGMA user_version` is " + std::to_string(version) + ":"),
            std::string::npos)
      << "docs/records.md: the version is " << version;
}

}  // namespace
}  // namespace skein::app
