// SPDX-License-Identifier: Apache-2.0
// The example's program that holds a run, beside the program.
#include <cstdio>

#include "app/test/program.h"

namespace skein::app {
namespace {

// All that it says, with what follows its name; its exit status comes last.
std::string hold(const std::string& arguments) {
  const std::string command = SKEIN_HOLD_A_RUN " " + arguments;
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string said;
  char part[512];
  while (pipe && std::fgets(part, sizeof part, pipe)) said += part;
  return said + "exit " + std::to_string(pipe ? WEXITSTATUS(pclose(pipe)) : -1);
}

constexpr const char* kScenario = SKEIN_SOURCE_DIR "/example/my_kinds/held.yaml";

TEST_F(Program, HeldRunsHaveTheHashOfTheirCommands) {
  const Finished whole = run({"run", kScenario, "--json", "--out", "whole", "--set",
                              "commands=[{at_s: 30, do: wind 6 90}]"});
  ASSERT_EQ(whole.status, 0) << whole.err;
  const std::string hash = nlohmann::json::parse(whole.out).value("content_hash", "none");
  const std::string held = hold(kScenario);
  EXPECT_NE(held.find("content hash " + hash + "\nexit 0"), std::string::npos) << held;
  EXPECT_NE(held.find(" 30.0 s  "), std::string::npos) << held;
  EXPECT_NE(held.find("and believes"), std::string::npos) << held;
  // Changes are those of --set.
  const Finished other = run({"run", kScenario, "--json", "--out", "other", "--set",
                              "seed=4", "--set", "duration_s=20"});
  EXPECT_NE(hold(std::string(kScenario) + " seed=4 duration_s=20")
                .find(nlohmann::json::parse(other.out).value("content_hash", "none")),
            std::string::npos);
}

TEST_F(Program, WhoHoldsARunIsToldWhatIsWrong) {
  const std::string wrong = hold(std::string(kScenario) + " sede=4 2>&1");
  EXPECT_NE(wrong.find("sede"), std::string::npos) << wrong;
  EXPECT_TRUE(wrong.ends_with("exit 1")) << wrong;
}

}  // namespace
}  // namespace skein::app
