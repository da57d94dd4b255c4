// SPDX-License-Identifier: Apache-2.0
// skein study avoidance: cases in, figures out, and that avoidance is what parts them.
#include <cmath>
#include <sstream>

#include "app/test/program.h"

namespace skein::app {
namespace {

constexpr const char* kPair =
    "case,aircraft,start_north_m,start_east_m,start_down_m,goal_north_m,goal_east_m,"
    "goal_down_m,airspeed_mps\n"
    "head-on-1,1,0,0,-150,3000,0,-150,20\n"
    "head-on-1,2,3000,10,-150,0,10,-150,20\n";
constexpr const char* kEncounter =
    "case,own_north_m,own_east_m,own_down_m,goal_north_m,goal_east_m,own_speed_mps,"
    "int_north_m,int_east_m,int_down_m,int_vn_mps,int_ve_mps,int_vd_mps,turn_from_s,"
    "turn_for_s,turn_rate_radps,climb_vd_mps\n"
    "e0,0,0,-150,4000,0,20,6000,100,-160,-40,0,0,,0,0,0\n";

// The cell of a column in the first row.
double cell(const std::string& csv, const std::string& column) {
  std::istringstream lines(csv);
  std::string header, row;
  std::getline(lines, header);
  std::getline(lines, row);
  std::istringstream names(header), cells(row);
  std::string name, value;
  while (std::getline(names, name, ',') && std::getline(cells, value, ','))
    if (name == column) return value.empty() ? std::nan("") : std::stod(value);
  return std::nan("");
}

class AvoidanceStudy : public Program {
 protected:
  std::string study(const std::string& cases, std::vector<std::string> more) {
    const std::string out = "r" + std::to_string(++runs_) + ".csv";
    std::vector<std::string> arguments = {"study", "avoidance", "--cases",
                                          cases,   "--out",     out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished done = run(arguments);
    EXPECT_EQ(done.status, 0) << done.err;
    return read_file(folder_ / out);
  }

 private:
  int runs_ = 0;
};

TEST_F(AvoidanceStudy, EveryMethodPartsAPair) {
  write("pair.csv", kPair);
  EXPECT_EQ(cell(study("pair.csv", {"--method", "none"}), "violations"), 1);
  for (const char* method : {"rule", "priority", "negotiated", "group", "auto"}) {
    const std::string csv = study("pair.csv", {"--method", method});
    EXPECT_EQ(cell(csv, "violations"), 0) << method;
    EXPECT_EQ(cell(csv, "arrived"), 2) << method;
    EXPECT_LT(cell(csv, "extra_time_s"), 10) << method;
  }
}

TEST_F(AvoidanceStudy, IntrudersAreKeptWellClearOf) {
  write("e.csv", kEncounter);
  const std::string none = study("e.csv", {"--method", "none"});
  EXPECT_EQ(cell(none, "nmac"), 1);
  EXPECT_EQ(cell(none, "lowc"), 1);
  for (const char* tracks : {"perfect", "adsb"}) {
    const std::string csv = study("e.csv", {"--tracks", tracks});
    EXPECT_EQ(cell(csv, "lowc"), 0) << tracks;
    EXPECT_EQ(cell(csv, "arrived"), 1) << tracks;
  }
}

TEST_F(AvoidanceStudy, EveryDealPartsAPair) {
  write("pair.csv", kPair);
  for (const char* deal : {"sum", "product", "zeuthen"}) {
    const std::string csv = study("pair.csv", {"--method", "negotiated", "--deal", deal});
    EXPECT_EQ(cell(csv, "violations"), 0) << deal;
    EXPECT_EQ(cell(csv, "arrived"), 2) << deal;
    EXPECT_GE(cell(csv, "deals"), 1) << deal;
  }
}

// Both rooms keep well clear; the standing one is flown around by another way.
TEST_F(AvoidanceStudy, IntrudersAreKeptWellClearOfByEitherRoom) {
  write("e.csv", kEncounter);
  const std::string moving = study("e.csv", {"--intruder-room", "moving"});
  const std::string standing = study("e.csv", {"--intruder-room", "static"});
  for (const std::string& csv : {moving, standing}) {
    EXPECT_EQ(cell(csv, "lowc"), 0);
    EXPECT_EQ(cell(csv, "arrived"), 1);
  }
  EXPECT_NE(cell(moving, "extra_time_s"), cell(standing, "extra_time_s"));
}

// A case that stands out can be looked into, also one that was flown without records.
TEST_F(AvoidanceStudy, KeepsTheRecordsOfEachCase) {
  write("pair.csv", kPair);
  study("pair.csv", {});
  const std::vector<std::string> again = {"study", "avoidance", "--cases",  "pair.csv",
                                          "--out", "r1.csv",    "--records"};
  ASSERT_EQ(run(again).status, 0);
  const fs::path kept = folder_ / "r1.runs" / "head-on-1";
  EXPECT_TRUE(fs::exists(kept / "summary.json"));
  EXPECT_TRUE(fs::exists(kept / "scenario.yaml"));
  const Finished done = run({"report", kept.string()});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_TRUE(fs::exists(kept / "report.html"));
}

TEST_F(AvoidanceStudy, SaysWhatIsWrong) {
  write("pair.csv", kPair);
  write("bad.csv", std::string(kEncounter) + "e1,0,0\n");
  const auto expect = [&](std::vector<std::string> more, const std::string& part) {
    std::vector<std::string> arguments = {"study", "avoidance", "--out", "r.csv"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Finished done = run(arguments);
    EXPECT_EQ(done.status, 2) << part;
    EXPECT_NE(done.err.find(part), std::string::npos) << done.err;
  };
  expect({}, "needs --cases");
  expect({"--cases", "none.csv"}, "none.csv");
  expect({"--cases", "bad.csv"}, "bad.csv:3");
  expect({"--cases", "pair.csv", "--tracks", "eyes"}, "--tracks");
  expect({"--cases", "pair.csv", "--method", "luck"}, "--method");
  expect({"--cases", "pair.csv", "--deal", "luck"}, "--deal");
  expect({"--cases", "pair.csv", "--intruder-room", "bed"}, "--intruder-room");
}

}  // namespace
}  // namespace skein::app
