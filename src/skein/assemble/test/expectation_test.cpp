// SPDX-License-Identifier: Apache-2.0
// Scenario tests: every file of scenarios/expect/ names a scenario, changes to it, and
// what its summary must say, with the reason of each bound; by each of `seeds` where
// there are some, else by the scenario's. `key_file` is the key of the scenario that is
// given a file with a team's key, which nobody else can read.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/world/run.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::expectation_test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> expectation_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(SKEIN_SOURCE_DIR "/scenarios/expect"))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class Expectation : public testing::TestWithParam<fs::path> {};

void run_and_judge(const YAML::Node& file, const std::vector<std::string>& set) {
  std::vector<scenario::Override> overrides;
  for (const std::string& text : set) overrides.push_back({text});
  const fs::path path =
      fs::path(SKEIN_SOURCE_DIR) / "scenarios" / file["scenario"].as<std::string>();
  const auto read = scenario::read_scenario(path, kind_table(), overrides);
  ASSERT_TRUE(read.ok()) << read.report();
  const auto summary = run_quietly(*read.scenario, KindRegistry(), {});
  ASSERT_TRUE(summary.ok()) << summary.error().text();
  ASSERT_TRUE(file["expect"].size() > 0);
  for (const auto& bound : file["expect"]) {
    const auto name = bound["figure"].as<std::string>();
    const auto because = bound["because"].as<std::string>();
    const auto value = summary.value().number(name);
    ASSERT_TRUE(value) << name << " is not in the summary";
    if (bound["at_most"]) {
      EXPECT_LE(*value, bound["at_most"].as<double>()) << name << ": " << because;
    }
    if (bound["at_least"]) {
      EXPECT_GE(*value, bound["at_least"].as<double>()) << name << ": " << because;
    }
  }
}

// A file with a key, of the name of a test, for its owner alone.
fs::path key_file(const std::string& name) {
  const fs::path file = fs::path(testing::TempDir()) / (name + ".key");
  std::ofstream(file) << std::string(64, '7') << '\n';
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  return file;
}

TEST_P(Expectation, Holds) {
  const YAML::Node file = YAML::LoadFile(GetParam().string());
  if (file["needs"] &&
      !fs::exists(fs::path(SKEIN_SHARED_DATA) / file["needs"].as<std::string>()))
    GTEST_SKIP() << "the data " << file["needs"] << " is not here";
  std::vector<std::string> set;
  for (const auto& text : file["set"]) set.push_back(text.as<std::string>());
  if (file["key_file"])
    set.push_back(file["key_file"].as<std::string>() + "=" +
                  key_file(GetParam().stem().string()).string());
  if (!file["seeds"]) return run_and_judge(file, set);
  for (const auto& seed : file["seeds"]) {
    SCOPED_TRACE("seed " + seed.as<std::string>());
    std::vector<std::string> seeded = set;
    seeded.push_back("seed=" + seed.as<std::string>());
    run_and_judge(file, seeded);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Expectation, testing::ValuesIn(expectation_files()),
                         [](const auto& file) {
                           std::string name = file.param.stem().string();
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace skein::assemble::expectation_test
