// SPDX-License-Identifier: Apache-2.0
// Paths in files, commands that are started, and what recorded scenarios say.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "skein/scenario/file_path.h"
#include "skein/scenario/named_files.h"
#include "skein/scenario/scenario_file.h"
#include "skein/scenario/test/fake_kinds.h"

namespace skein::scenario::test {
namespace {

namespace fs = std::filesystem;

class NamedPathTest : public testing::Test {
 protected:
  NamedPathTest() : before_(fs::current_path()) {
    std::string pattern = (fs::temp_directory_path() / "paths-XXXXXX").string();
    folder_ = fs::canonical(mkdtemp(pattern.data()));
    for (const char* name : {"beside", "working"}) fs::create_directories(folder_ / name);
    fs::current_path(folder_ / "working");
  }
  ~NamedPathTest() override {
    fs::current_path(before_);
    fs::remove_all(folder_);
  }
  void touch(const char* name) { std::ofstream(folder_ / name) << "x"; }
  NamedPath find(std::string_view text) {
    return find_file(text, folder_ / "beside", {});
  }

  fs::path before_, folder_;
};

TEST_F(NamedPathTest, StartsBesideTheFile) {
  touch("beside/a.csv");
  touch("working/a.csv");
  EXPECT_EQ(find("a.csv").path, (folder_ / "beside/a.csv").string());
  EXPECT_EQ(find("a.csv").problem, "");
  EXPECT_EQ(find("../working/a.csv").path, (folder_ / "working/a.csv").string());
  EXPECT_EQ(find_file("a.csv", {}, {}).path, (folder_ / "working/a.csv").string());
}

TEST_F(NamedPathTest, WhatIsInTheWorkingFolderOnlyIsNamedWithTheEdit) {
  touch("working/b.csv");
  const NamedPath named = find("b.csv");
  EXPECT_EQ(named.problem,
            "\"" + (folder_ / "beside/b.csv").string() + "\" does not exist.");
  EXPECT_NE(named.hint.find((folder_ / "working/b.csv").string()), std::string::npos);
  EXPECT_NE(named.hint.find("Write \"../working/b.csv\""), std::string::npos)
      << named.hint;
  EXPECT_EQ(find("nowhere.csv").hint, "");
}

TEST_F(NamedPathTest, OfACommandTheProgramIsAFileWhenItHasASlash) {
  const fs::path beside = folder_ / "beside";
  EXPECT_EQ(find_program("arduplane", beside).path, "arduplane");
  EXPECT_EQ(find_program("/usr/bin/arduplane", beside).path, "/usr/bin/arduplane");
  EXPECT_EQ(find_program("{skein}", beside).path, "{skein}");
  EXPECT_EQ(find_program("{folder}/x", beside).path, "{folder}/x");
  EXPECT_EQ(find_program("./fly", beside).path, (beside / "fly").string());
  touch("working/fly");
  EXPECT_NE(find_program("./fly", beside).problem, "");
}

TEST_F(NamedPathTest, AnOrderNamesItsPlanAbsolutely) {
  touch("beside/file.csv");
  const fs::path beside = folder_ / "beside";
  EXPECT_EQ(find_file_of_order("task uav-1 plan file file.csv", beside).path,
            "task uav-1 plan file " + (beside / "file.csv").string());
  EXPECT_EQ(find_file_of_order("task uav-1 goto 1,2", beside).path,
            "task uav-1 goto 1,2");
  EXPECT_NE(find_file_of_order("task uav-1 plan file none.csv", beside).problem, "");
}

struct Launcher {
  std::vector<std::string> program;
  std::string plane = "shipped";
};

KindTable launching_kinds() {
  KindTable kinds = fake_kinds();
  kinds.add("radio", "launcher", "Starts something.",
            Fields<Launcher>()
                .program("program", &Launcher::program, "What it starts.")
                .file("plane", &Launcher::plane, "By name or file.", {.or_name = true}));
  return kinds;
}

TEST_F(NamedPathTest, CommandsAndFilesOfAScenarioAreFound) {
  touch("beside/own.yaml");
  const KindTable kinds = launching_kinds();
  const auto read = read_scenario_text(
      "radio: {kind: launcher, program: [./fly, -x, '{name}'], plane: own.yaml}", "test",
      folder_ / "beside", kinds);
  ASSERT_TRUE(read.ok()) << read.report();
  const auto commands = named_commands(*read.scenario, kinds);
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0], (std::vector<std::string>{(folder_ / "beside/fly").string(),
                                                   "-x", "{name}"}));
  EXPECT_EQ(named_files(*read.scenario, kinds),
            std::vector<std::string>{(folder_ / "beside/own.yaml").string()});
  const auto by_name = read_scenario_text("radio: launcher", "test", folder_, kinds);
  ASSERT_TRUE(by_name.ok());
  EXPECT_TRUE(named_files(*by_name.scenario, kinds).empty());
  EXPECT_TRUE(named_commands(*by_name.scenario, kinds).empty());
}

TEST_F(NamedPathTest, ARecordedScenarioIsReadWithoutWhatItNames) {
  const std::string text =
      "name: there\norigin: {latitude_deg: 10, longitude_deg: 20}\n"
      "plugins: [/nowhere/kinds.so]\nradio: {kind: of-the-plugin, power_w: 1}\n"
      "links: {key_file: /nowhere/key}\n";
  EXPECT_FALSE(read_scenario_text(text, "run", "/", fake_kinds()).ok());
  const auto read = read_recorded_scenario_text(text, "run", "/", fake_kinds());
  ASSERT_TRUE(read.ok()) << read.report();
  EXPECT_EQ(read.scenario->origin.latitude_deg, 10);
  EXPECT_EQ(read.scenario->radio.kind, "of-the-plugin");
}

TEST_F(NamedPathTest, TheSourceIsWhereTheFileTrulyIs) {
  std::ofstream(folder_ / "beside/s.yaml") << "name: x\n";
  fs::create_symlink("../beside/s.yaml", folder_ / "working/link.yaml");
  const auto read = read_scenario("link.yaml", fake_kinds());
  ASSERT_TRUE(read.ok()) << read.report();
  EXPECT_EQ(read.scenario->source.file, folder_ / "beside/s.yaml");
  EXPECT_EQ(read.scenario->source.folder, folder_ / "working");
  EXPECT_EQ(*read.scenario->source.text, "name: x\n");
}

}  // namespace
}  // namespace skein::scenario::test
