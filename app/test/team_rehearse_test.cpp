// SPDX-License-Identifier: Apache-2.0
// skein team: what it answers and what it refuses.
#include <algorithm>

#include "app/test/program.h"

namespace skein::app {
namespace {

constexpr const char* kScripts = R"([{"id": "a", "aircraft": [4, 1], "tasks": 2,
"events": [{"t_s": 60, "what": "crash", "aircraft": 1}], "end_s": 100}])";

TEST_F(Program, RehearsesATeam) {
  const auto file = write("scripts.json", kScripts).string();
  const Finished done = run({"team", "rehearse", "--scripts", file, "--out", "r.csv"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_NE(done.out.find("expectations met: 2 of 2"), std::string::npos) << done.out;
  EXPECT_NE(done.out.find("0 violations"), std::string::npos) << done.out;
  const std::string rows = read_file(folder_ / "r.csv");
  EXPECT_EQ(rows.find("id,t_s,aircraft,master,mission,members\n"), 0u);
  EXPECT_NE(rows.find("\na,30,4,1,M,1 4\n"), std::string::npos);
  EXPECT_NE(rows.find("\na,95,4,4,M,4\n"), std::string::npos);
  EXPECT_EQ(rows.find("\na,61,1,"), std::string::npos) << "it has crashed";
  const Finished again = run({"team", "rehearse", "--scripts", file, "--out", "s.csv"});
  EXPECT_EQ(again.out, done.out);
  EXPECT_EQ(read_file(folder_ / "s.csv"), rows);
}

TEST_F(Program, RehearsesByChance) {
  const Finished done = run({"team", "rehearse", "--random", "5", "--seed", "3"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(done.out.find("5 scripts"), 0u) << done.out;
  EXPECT_EQ(done.out.find("first not met"), std::string::npos) << done.out;
}

TEST_F(Program, RefusesBadScripts) {
  EXPECT_EQ(run({"team"}).status, 2);
  EXPECT_EQ(run({"team", "rehearse"}).status, 2);
  EXPECT_EQ(run({"team", "rehearse", "--scripts", "missing.json"}).status, 2);
  EXPECT_EQ(run({"team", "rehearse", "--random", "1", "--loss", "1.5"}).status, 2);
  const auto bad = write("bad.json", R"([{"id": "a", "aircraft": [1], "tasks": 1,
    "events": [{"t_s": 9, "what": "crash", "aircraft": 2}], "end_s": 20}])");
  const Finished refused = run({"team", "rehearse", "--scripts", bad.string()});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("[0].events[0]: 2 is not there"), std::string::npos)
      << refused.err;
}

}  // namespace
}  // namespace skein::app
