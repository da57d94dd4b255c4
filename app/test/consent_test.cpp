// SPDX-License-Identifier: Apache-2.0
// Libraries and programs that a scenario names do not run without consent, by any
// command.
#include <signal.h>

#include <map>
#include <sstream>
#include <tuple>

#include "app/test/program.h"

namespace skein::app {
namespace {

using Words = std::vector<std::string>;

constexpr const char* kLibrary = SKEIN_MARKER_LIBRARY;

class Consent : public Program {
 protected:
  Consent() {
    input_ = "/dev/null";  // nobody is asked
    setenv("SKEIN_MARKER", marker().c_str(), 1);
    setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
  }
  ~Consent() override {
    unsetenv("SKEIN_MARKER");
    unsetenv("XDG_CONFIG_HOME");
  }

  fs::path marker() const { return folder_ / "marker"; }
  bool was_run() {
    const bool there = fs::exists(marker());
    fs::remove(marker());
    return there;
  }

  static std::string library_scenario() {
    return "name: evil\nduration_s: 2\nplugins: ['" + std::string(kLibrary) + "']\n";
  }
  std::string program_scenario() const {
    return "name: evil\nduration_s: 2\naircraft: [{name: mine, " + program_vehicle() +
           "}]\nmissions: []\n";
  }
  std::string program_vehicle() const {
    return "vehicle: {kind: mavlink, endpoint: 'udpin:0', physics: {kind: none, "
           "program: [/bin/sh, -c, 'touch " +
           marker().string() +
           "']}}, plant: {kind: fixed-wing, aircraft: bixler}, sensors: [fire]";
  }
  std::string campaign(const std::string& scenario, const std::string& set = "") const {
    return "name: evil\nscenario: " + scenario + "\nseeds: 1\n" + set +
           "figures: [{figure: simulated_s}]\n";
  }

  // The folder of a finished run, whose scenario is then replaced by another one.
  fs::path run_of(const std::string& name, const std::string& scenario) {
    const fs::path plain = write("plain.yaml", "name: plain\nduration_s: 2\n");
    const Finished made = run({"run", plain.string(), "--out", name});
    EXPECT_EQ(made.status, 0) << made.err;
    write(name + "/scenario.yaml", scenario);
    std::string quoted;
    for (const char c : scenario) quoted += c == '\'' ? "''" : std::string(1, c);
    query(folder_ / name / "run.sqlite",
          "UPDATE meta SET value='" + quoted + "' WHERE name='scenario'");
    return folder_ / name;
  }

  // Runs a command to its end, or until it serves a page.
  Finished attempt(const Words& command) {
    fs::remove(folder_ / "err.txt");  // of the command before
    const pid_t child = start(command);
    for (int k = 0; k < 3000 && !is_serving(); ++k) {
      siginfo_t info{};
      if (waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) ==
              0 &&
          info.si_pid == child)
        break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    if (is_serving()) kill(child, SIGINT);
    return finish(child);
  }
  bool is_serving() {
    return read_file(folder_ / "err.txt").find("The page: ") != std::string::npos;
  }

  // All commands of the program, as it lists them itself.
  Words commands() {
    std::istringstream help(run({"--help"}).out);
    Words all;
    bool inside = false;
    for (std::string line; std::getline(help, line);) {
      if (line.starts_with("Subcommands:")) {
        inside = true;
      } else if (inside && line.size() > 2 && line.starts_with("  ") && line[2] != ' ') {
        all.push_back(line.substr(2, line.find(' ', 2) - 2));
      }
    }
    return all;
  }

  // What is done with a scenario, a campaign and the folder of a run, by every command
  // that takes one. A new command belongs here, or below.
  static std::map<std::string, std::vector<Words>> with_scenarios() {
    return {{"run",
             {{"run", "evil.yaml", "--out", "out"},
              {"run", "evil-run/scenario.yaml", "--out", "out"},
              {"run", "--replay", "evil-run", "--out", "out"}}},
            {"check",
             {{"check", "evil.yaml"},
              {"check", "evil.yaml", "--print"},
              {"check", "evil-run/scenario.yaml"}}},
            {"agent", {{"agent", "evil.yaml", "--entity", "mine-1", "--for", "1"}}},
            {"campaign",
             {{"campaign", "campaign.yaml", "--out", "out"},
              {"campaign", "changing.yaml", "--out", "out", "--scenarios"}}},
            {"study", studies()},
            {"team", {{"team", "messages", "evil-run", "--out", "out"}}},
            {"report", {{"report", "evil-run"}}},
            {"export",
             {{"export", "evil-run", "--what", "tracks", "--out", "tracks.geojson"}}},
            {"replay", {{"replay", "evil-run", "--serve", "0"}}}};
  }
  // Studies that fly a scenario which is shipped.
  static std::vector<Words> studies() {
    std::vector<Words> all;
    for (const char* name : {"tuning", "monitoring", "bridge", "fidelity", "robustness",
                             "wind-following", "ground-starts", "keeping"})
      all.push_back(
          {"study", name, "--seeds", "1", "--set", "duration_s=1", "--out", "out"});
    return all;
  }
  // Those that would fly the scenario, and can do so with consent only. (`check` loads
  // libraries and starts no program; studies want a scenario of another kind first.)
  static bool flies(const Words& use) {
    return (use[0] == "run" && use[1] != "--replay") || use[0] == "campaign";
  }
  // Commands that take neither scenarios nor runs; `fire` writes a scenario.
  static Words without_scenarios() {
    return {"list", "schema", "keys",  "fly",     "plan", "avoid",
            "fire", "link",   "relay", "vehicle", "net",  "completion"};
  }

  void expect_nothing_runs(const std::string& scenario, const std::string& changing) {
    write("evil.yaml", scenario);
    write("campaign.yaml", campaign("evil.yaml"));
    write("plain.yaml", "name: plain\nduration_s: 2\n");
    write("changing.yaml", campaign("plain.yaml", changing));
    fs::create_directories(folder_ / "scenarios");
    for (const char* shipped :
         {"tuning.yaml", "wildfire.yaml", "thesis-no-wind.yaml", "bridge-fire.yaml",
          "robustness.yaml", "wind-following.yaml", "ground-starts.yaml", "keeping.yaml"})
      write(std::string("scenarios/") + shipped, scenario);
    run_of("evil-run", scenario);
    for (const auto& [command, uses] : with_scenarios())
      for (const Words& use : uses) {
        std::string text;
        for (const std::string& word : use) text += " " + word;
        const Finished done = attempt(use);
        EXPECT_FALSE(was_run()) << "by skein" << text;
        if (flies(use)) {
          EXPECT_NE(done.status, 0) << "skein" << text;
          EXPECT_NE(done.err.find("--trust"), std::string::npos)
              << "skein" << text << "\n"
              << done.err;
        }
        fs::remove_all(folder_ / "out");
      }
  }
};

TEST_F(Consent, EveryCommandIsKnownToTakeScenariosOrNot) {
  const Words all = commands();
  EXPECT_GT(all.size(), 15U);
  const auto with = with_scenarios();
  const Words without = without_scenarios();
  for (const std::string& command : all)
    EXPECT_EQ(
        with.contains(command) + std::count(without.begin(), without.end(), command), 1)
        << command << " is new: say in this test whether it takes scenarios or runs";
}

TEST_F(Consent, NoCommandLoadsALibraryOfAScenario) {
  expect_nothing_runs(library_scenario(),
                      "set: [\"plugins=['" + std::string(kLibrary) + "']\"]\n");
}

TEST_F(Consent, NoCommandStartsAProgramOfAScenario) {
  expect_nothing_runs(
      program_scenario(),
      "set: [\"aircraft=[{name: mine, " + program_vehicle() + "}]\", \"missions=[]\"]\n");
}

TEST_F(Consent, TheRefusalSaysWhatToGive) {
  write("evil.yaml", library_scenario());
  const Finished library = run({"check", "evil.yaml"});
  EXPECT_EQ(library.status, 2);
  for (const std::string& part :
       {std::string("evil.yaml:3:11 plugins[0]"), "--plugin " + std::string(kLibrary),
        "--trust " + fs::canonical(folder_).string(),
        (folder_ / "config/skein/trusted-folders").string()})
    EXPECT_NE(library.err.find(part), std::string::npos) << part << "\n" << library.err;
  write("evil.yaml", program_scenario());
  const Finished program = run({"run", "evil.yaml", "--out", "out"});
  EXPECT_EQ(program.status, 2);
  for (const std::string& part :
       {"touch " + marker().string(), "--trust " + fs::canonical(folder_).string()})
    EXPECT_NE(program.err.find(part), std::string::npos) << part << "\n" << program.err;
  EXPECT_FALSE(fs::exists(folder_ / "out")) << "nothing is written";
}

TEST_F(Consent, IsGivenByTheCommandLine) {
  write("evil.yaml", library_scenario());
  run({"check", "evil.yaml", "--plugin", kLibrary});
  EXPECT_TRUE(was_run());
  run({"check", "evil.yaml", "--trust", "."});
  EXPECT_TRUE(was_run());
  write("evil.yaml", program_scenario());
  run({"run", "evil.yaml", "--out", "out", "--trust", "."});
  EXPECT_TRUE(was_run());
  run({"agent", "evil.yaml", "--entity", "mine-1", "--for", "1", "--trust", "."});
  EXPECT_TRUE(was_run());
  write("campaign.yaml", campaign("evil.yaml"));
  run({"campaign", "campaign.yaml", "--out", "campaign", "--trust", "."});
  EXPECT_TRUE(was_run());
  EXPECT_EQ(run({"check", "evil.yaml", "--trust", "nowhere"}).status, 2);
}

// Every study that flies a scenario reads it as a run does; so do campaigns, also where
// only the campaign names the library.
TEST_F(Consent, OfCampaignsAndStudiesIsGivenAlike) {
  write("evil.yaml", library_scenario());
  write("plain.yaml", "name: plain\nduration_s: 2\n");
  write("campaign.yaml", campaign("evil.yaml"));
  write("changing.yaml",
        campaign("plain.yaml", "set: [\"plugins=['" + std::string(kLibrary) + "']\"]\n"));
  for (const char* file : {"campaign.yaml", "changing.yaml"}) {
    const Finished refused = run({"campaign", file, "--out", "out"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("--trust "), std::string::npos) << refused.err;
    EXPECT_FALSE(was_run());
    run({"campaign", file, "--out", "out", "--trust", "."});
    EXPECT_TRUE(was_run()) << file;
  }
  fs::create_directories(folder_ / "scenarios");
  const std::map<std::string, std::string> studies = {
      {"monitoring", "thesis-no-wind"}, {"bridge", "bridge-fire"},
      {"fidelity", "wildfire"},         {"wind-following", "wind-following"},
      {"robustness", "robustness"},     {"ground-starts", "ground-starts"},
      {"keeping", "keeping"},           {"tuning", "tuning"}};
  for (const auto& [study, base] : studies) {
    write("scenarios/" + base + ".yaml", library_scenario());
    const Finished refused = run({"study", study, "--seeds", "1", "--out", "out"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("--trust "), std::string::npos) << study << refused.err;
    EXPECT_FALSE(was_run()) << study;
    run({"study", study, "--seeds", "1", "--out", "out", "--trust", "."});
    EXPECT_TRUE(was_run()) << study;
  }
}

TEST_F(Consent, IsGivenByTheUsersFileAlone) {
  write("evil.yaml", library_scenario());
  fs::create_directories(folder_ / "config/skein");
  const fs::path file = write("config/skein/trusted-folders",
                              "# mine\n/not/there\n" + folder_.string() + "\n");
  fs::permissions(file, fs::perms(0600));
  run({"check", "evil.yaml"});
  EXPECT_TRUE(was_run());
  for (const unsigned mode : {0620U, 0602U}) {
    fs::permissions(file, fs::perms(mode));
    const Finished refused = run({"check", "evil.yaml"});
    EXPECT_NE(refused.err.find("can be written by others"), std::string::npos)
        << refused.err;
    EXPECT_FALSE(was_run());
  }
  fs::permissions(file, fs::perms(0600));
  write("config/skein/trusted-folders", "relative/folder\n");
  EXPECT_NE(run({"check", "evil.yaml"}).err.find("line 1"), std::string::npos);
  EXPECT_FALSE(was_run());
}

// What counts is where files are, not how they are reached.
TEST_F(Consent, DoesNotFollowLinksAndDots) {
  for (const char* name : {"good", "bad", "goods"})
    fs::create_directories(folder_ / name);
  write("bad/evil.yaml", library_scenario());
  write("goods/evil.yaml", library_scenario());
  fs::create_symlink("../bad/evil.yaml", folder_ / "good/link.yaml");
  fs::create_directory_symlink("../bad", folder_ / "good/folder");
  for (const char* file : {"good/link.yaml", "good/folder/evil.yaml",
                           "good/../bad/evil.yaml", "goods/evil.yaml"}) {
    EXPECT_EQ(run({"check", file, "--trust", "good"}).status, 2);
    EXPECT_FALSE(was_run()) << file;
  }
  // A link elsewhere to a trusted file: what it names would be looked for beside the
  // link.
  write("good/relative.yaml", "plugins: [mine.so]\n");
  fs::copy_file(kLibrary, folder_ / "bad/mine.so");
  fs::copy_file(kLibrary, folder_ / "good/mine.so");
  fs::create_symlink("../good/relative.yaml", folder_ / "bad/relative.yaml");
  run({"check", "bad/relative.yaml", "--trust", "good"});
  EXPECT_FALSE(was_run());
  run({"check", "good/relative.yaml", "--trust", "bad/../good"});
  EXPECT_TRUE(was_run());
  // Everybody may put another library in its place.
  fs::permissions(folder_ / "good/mine.so", fs::perms(0666));
  run({"check", "good/relative.yaml", "--trust", "good"});
  EXPECT_FALSE(was_run());
}

// They are known by their bytes, wherever they lie.
TEST_F(Consent, IsThereForShippedScenarios) {
  fs::create_directories(folder_ / "bin");
  const fs::path fake =
      write("bin/arduplane", "#!/bin/sh\ntouch '" + marker().string() + "'\n");
  fs::permissions(fake, fs::perms(0755));
  const std::string path = std::getenv("PATH");
  setenv("PATH", ((folder_ / "bin").string() + ":" + path).c_str(), 1);
  fs::copy(SKEIN_SOURCE_DIR "/scenarios/ardupilot", folder_ / "ardupilot");
  const std::string text =
      read_file(SKEIN_SOURCE_DIR "/scenarios/mixed-ardupilot-physics.yaml");
  write("shipped.yaml", text);
  write("changed.yaml", text + "\n# changed\n");
  for (const auto& [file, runs] :
       {std::tuple("shipped.yaml", true), std::tuple("changed.yaml", false)}) {
    prefix_ = file;
    const pid_t child = start({"run", file, "--out", std::string("out-") + file});
    for (int k = 0; k < 500 && runs && !fs::exists(marker()); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (runs) kill(child, SIGINT);
    const Finished finished = finish(child);
    EXPECT_EQ(was_run(), runs) << file << ": " << finished.err;
  }
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace skein::app
