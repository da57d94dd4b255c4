// SPDX-License-Identifier: Apache-2.0
#include "app/team/rehearsal/script.h"

#include <gtest/gtest.h>

namespace skein::rehearsal::script_test {
namespace {

std::string script_with(const std::string& events, const std::string& more = "") {
  return R"([{"id": "a", "aircraft": [3, 1], "tasks": 2, "events": [)" + events +
         R"(], "end_s": 90)" + more + "}]";
}

std::string problem_of(const std::string& text) {
  const auto read = read_team_scripts(text, "s.json");
  return read ? "none" : read.error().text();
}

TEST(TeamScripts, AreRead) {
  const auto read =
      read_team_scripts(script_with(R"({"t_s": 5, "what": "join", "aircraft": 7},
                     {"t_s": 6, "what": "partition", "parts": [[1, 7], [3]]},
                     {"t_s": 7.5, "what": "heal"},
                     {"t_s": 9, "what": "crash", "aircraft": 3})",
                                    R"(, "expect": [{"t_s": 30, "groups": [
                     {"master": 1, "members": [7, 1], "mission": "M"}]}])"),
                        "s.json");
  ASSERT_TRUE(read) << read.error().text();
  const TeamScript& script = read.value().front();
  EXPECT_EQ(script.aircraft, (std::vector<EntityId>{{3}, {1}}));
  ASSERT_EQ(script.events.size(), 4u);
  EXPECT_EQ(script.events[1].parts.size(), 2u);
  EXPECT_EQ(script.events[2].time, 7.5);
  EXPECT_EQ(script.expect[0].groups[0].members, (std::vector<EntityId>{{1}, {7}}));
}

TEST(TeamScripts, AreRefusedWithTheReason) {
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(problem_of(text).find(part), std::string::npos) << problem_of(text);
  };
  has("{}", "must be a list");
  has(script_with(R"({"t_s": 5, "what": "fly"})"),
      "must be crash, join, partition or heal");
  has(script_with(R"({"t_s": 5, "what": "crash"})"), "lacks the key \"aircraft\"");
  has(script_with(R"({"t_s": 5, "what": "crash", "aircraft": 9})"), "9 is not there");
  has(script_with(R"({"t_s": 5, "what": "join", "aircraft": 3})"), "3 is there already");
  has(script_with(R"({"t_s": 5, "what": "heal"})"), "there is no partition");
  has(script_with(R"({"t_s": 5, "what": "heal", "parts": []})"), "must not have the key");
  has(script_with(R"({"t_s": 5, "what": "partition", "parts": [[1]]})"),
      "every aircraft");
  has(script_with(R"({"t_s": 5, "what": "crash", "aircraft": 1},
                     {"t_s": 4, "what": "crash", "aircraft": 3})"),
      "before the one before it");
  has(script_with("", R"(, "ends": 4)"), "unknown key \"ends\"");
  has(R"([{"id": "a", "aircraft": [1, 1], "tasks": 0, "events": [], "end_s": -1}])",
      "1 is there twice");
}

}  // namespace
}  // namespace skein::rehearsal::script_test
