// SPDX-License-Identifier: Apache-2.0
// skein team
#include "app/test/program.h"

namespace skein::app {
namespace {

using Team = Program;

const char* const kCoalitions = R"([{"id":"c","aircraft":[
  {"id":1,"north_m":0,"east_m":0,"v_min_mps":0,"v_max_mps":25,"cruise_mps":20,
   "turn_radius_m":0,"endurance_s":1000,"sensors":{"camera":{"swath_m":100,"quality":0.8}}},
  {"id":2,"north_m":9,"east_m":0,"v_min_mps":0,"v_max_mps":25,"cruise_mps":20,
   "turn_radius_m":0,"endurance_s":1000,"sensors":{}}],
 "tasks":[{"id":4,"kind":"tracking","sensor":"camera","north_m":9,"east_m":9,
           "target_speed_mps":10}]}])";

TEST_F(Team, AllocatesIdleOrNot) {
  write("c.json", kCoalitions);
  const Finished idle = run({"team", "allocate", "--batch", "c.json", "--out", "-"});
  EXPECT_EQ(idle.status, 0) << idle.err;
  EXPECT_NE(idle.out.find("id,value,answer,bound,proven,ms\nc,"), std::string::npos);
  EXPECT_NE(idle.out.find(",4 0,"), std::string::npos) << idle.out;
  const Finished all =
      run({"team", "allocate", "--batch", "c.json", "--no-idle", "--out", "a.csv"});
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_NE(all.out.find("1 problems, 1 of them proven"), std::string::npos);
  EXPECT_NE(read_file(folder_ / "a.csv").find(",4 4,"), std::string::npos);
}

TEST_F(Team, RoutesAndSaysWhatIsWrong) {
  write("r.json",
        R"([{"id":"r","aircraft":[{"id":1,"north_m":0,"east_m":0,"speed_mps":10}],
      "tasks":[{"id":1,"north_m":100,"east_m":0},{"id":2,"north_m":50,"east_m":0}]}])");
  const Finished good = run({"team", "route", "--batch", "r.json", "--out", "-"});
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_NE(good.out.find("\nr,10.000000000,2 1,10.000000000,1,"), std::string::npos)
      << good.out;
  write("bad.json", R"([{"id":"r","aircraft":[],"tasks":[],"colour":"red"}])");
  const Finished bad = run({"team", "route", "--batch", "bad.json", "--out", "-"});
  EXPECT_EQ(bad.status, 2);
  EXPECT_NE(bad.err.find("bad.json: [0].colour: unknown key"), std::string::npos)
      << bad.err;
  const Finished late = run({"team", "route", "--batch", "none.json", "--out", "-"});
  EXPECT_NE(late.status, 0);
}

TEST_F(Team, ToursAreTheSameForAnyThreads) {
  std::string points = "set,point,x,y\n";
  for (int k = 1; k <= 20; ++k)
    points += "a," + std::to_string(k) + "," + std::to_string(k * 37 % 41) + "," +
              std::to_string(k * 53 % 47) + "\n";
  write("p.csv", points);
  const auto answers = [&](const char* threads) {
    const Finished done =
        run({"team", "tours", "--batch", "p.csv", "--vehicles", "1,2,3", "--iterations",
             "5000", "--threads", threads, "--out", "-"});
    EXPECT_EQ(done.status, 0) << done.err;
    std::string rows;  // without the times
    std::istringstream lines(done.out);
    for (std::string line; std::getline(lines, line);)
      rows += line.substr(0, line.rfind(',')) + "\n";
    return rows;
  };
  const std::string one = answers("1");
  EXPECT_NE(one.find("a-3,"), std::string::npos);
  EXPECT_EQ(one, answers("3"));
  const Finished unknown = run({"team", "tours", "--batch", "p.csv", "--out", "-"});
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.err.find("--vehicles"), std::string::npos);
  write("cases.csv", "set,vehicles\na,2\n");
  const Finished cases = run({"team", "tours", "--batch", "p.csv", "--cases", "cases.csv",
                              "--seconds", "0.1", "--out", "-"});
  EXPECT_EQ(cases.status, 0) << cases.err;
  EXPECT_NE(cases.out.find("\na-2,"), std::string::npos);
}

}  // namespace
}  // namespace skein::app
