// SPDX-License-Identifier: Apache-2.0
// Scenarios with wrong values anywhere: whatever a key is given, there is an answer.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/base/random.h"
#include "skein/scenario/parse.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::mutated_scenario_test {
namespace {

using scenario::Node;

constexpr std::array kValues = {"",
                                "''",
                                "null",
                                "0",
                                "-0",
                                "-1",
                                "1",
                                "0.0005",
                                "1e-308",
                                "1e308",
                                ".nan",
                                "-.inf",
                                "0x10",
                                "99999999999999999999",
                                "1e7",
                                "10000",
                                "true",
                                "'0'",
                                "[]",
                                "{}",
                                "[0, 0]",
                                "[[]]",
                                "[null]",
                                "soon",
                                "[1,2]",
                                "{kind: 0}",
                                "[[0,0],[0,0],[0,0]]",
                                "{at_s: 1}"};

// All keys and elements below a node, as overrides name them.
void add_paths(const Node& node, const std::string& path, std::vector<std::string>& to) {
  if (!path.empty()) to.push_back(path);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    add_paths(node.items[i],
              node.kind == Node::Kind::kList ? path + "[" + std::to_string(i) + "]"
              : path.empty()                 ? node.keys[i].text
                                             : path + "." + node.keys[i].text,
              to);
}

std::vector<std::string> paths_of(const std::string& text) {
  scenario::Problems problems({"test"});
  const auto root = scenario::parse_yaml(text, 0, "a scenario", problems);
  EXPECT_TRUE(root.has_value());
  std::vector<std::string> paths;
  if (root) add_paths(*root, "", paths);
  return paths;
}

TEST(MutatedScenario, AlwaysGetsAnAnswer) {
  const scenario::KindTable kinds = kind_table();
  RandomStream random(41, 0, Purpose::kTest);
  const auto any = [&](const auto& list) { return list[random.bits() % list.size()]; };
  int read = 0, refused = 0;
  const auto expect_answer = [&](const std::string& text,
                                 const std::vector<scenario::Override>& changes) {
    const auto outcome = scenario::read_scenario_text(text, "test", "/", kinds, changes);
    EXPECT_EQ(outcome.ok(), outcome.report().empty()) << outcome.report();
    ++read;
    refused += outcome.ok() ? 0 : 1;
  };
  for (const auto& entry :
       std::filesystem::directory_iterator(SKEIN_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    const auto good = scenario::read_scenario(entry.path(), kinds);
    if (!good.ok()) continue;  // needs data that are not here
    const std::string text = write_scenario(*good.scenario, kinds);
    const std::vector<std::string> paths = paths_of(text);
    const auto change = [&](const std::string& path) {
      return scenario::Override{path + "=" + any(kValues)};
    };
    // Of scenarios with many aircraft, whose keys are the same ones again, some keys.
    constexpr std::size_t kMaxPaths = 100;
    const std::size_t stride = 1 + paths.size() / kMaxPaths;
    for (std::size_t at = 0; at < paths.size(); at += stride) {
      const std::string& path = paths[at];
      for (int k = 0; k < 3; ++k) expect_answer(text, {change(path)});
      expect_answer(text, {change(path), change(any(paths)), change(any(paths))});
    }
  }
  EXPECT_GT(read, 4000);
  EXPECT_GT(refused, read / 2);
  EXPECT_LT(refused, read);
}

TEST(MutatedScenario, EveryPeriodMayBeAnything) {
  const scenario::KindTable kinds = kind_table();
  for (const char* path :
       {"step_s", "duration_s", "environment.period_s", "aircraft[0].agent_period_s",
        "aircraft[0].flight_step_s", "stations[0].agent_period_s", "record.rate_hz",
        "record.metrics_period_s", "record.perimeter_period_s"})
    for (const char* value : kValues) {
      const auto outcome = scenario::read_scenario_text(
          "name: x", "test", "/", kinds,
          std::vector<scenario::Override>{{std::string(path) + "=" + value}});
      EXPECT_EQ(outcome.ok(), outcome.report().empty()) << path << "=" << value;
    }
}

}  // namespace
}  // namespace skein::assemble::mutated_scenario_test
