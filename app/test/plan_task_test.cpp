// SPDX-License-Identifier: Apache-2.0
// skein plan path and its tasks: what they take, what they write, what they refuse.
#include <fmt/format.h>
#include <signal.h>

#include <chrono>
#include <cmath>
#include <sstream>
#include <thread>

#include "app/test/program.h"

namespace skein::app {
namespace {

constexpr const char* kDiscs = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"name":"tower","radius_m":200},
 "geometry":{"type":"Point","coordinates":[1000,0]}},
{"type":"Feature","properties":{"radius_m":100,"floor_m":0,"ceiling_m":50},
 "geometry":{"type":"Point","coordinates":[400,0]}}]})";
constexpr const char* kField = R"({"type":"Feature","properties":{"name":"field"},
"geometry":{"type":"Polygon","coordinates":[[[0,0],[900,0],[900,600],[0,600],[0,0]]]}})";
constexpr const char* kPipe = R"({"type":"Feature","properties":{"name":"pipe"},
"geometry":{"type":"LineString","coordinates":[[0,0],[900,0],[1500,600]]}})";

class PlanTask : public Program {
 protected:
  Finished plan(const std::string& task, std::vector<std::string> more) {
    std::vector<std::string> all = {"plan",          task, "--airspeed", "15",
                                    "--turn-radius", "60"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  nlohmann::json json_of_task(const std::string& task, std::vector<std::string> more) {
    more.push_back("--json");
    const Finished finished = plan(task, std::move(more));
    EXPECT_EQ(finished.status, 0) << finished.err;
    return nlohmann::json::parse(finished.out, nullptr, false);
  }
};

TEST_F(PlanTask, PathsKeepOutOfZones) {
  const auto zones = write("zones.geojson", kDiscs).string();
  const std::vector<std::string> ends = {"--from",    "0,0,90",  "--to",
                                         "0,2000,90", "--zones", zones};
  auto high = ends;
  high.insert(high.end(), {"--altitude-m", "80", "--out", "path.csv", "--out", "p.svg"});
  const auto path = json_of_task("path", high);
  EXPECT_EQ(path["outcome"], "found");
  EXPECT_GT(double(path["time_s"]), 2000 / 15.0);
  EXPECT_LE(double(path["bound_s"]), double(path["time_s"]) + 1e-9);
  std::istringstream rows(read_file(folder_ / "path.csv"));
  std::string line, cell;
  std::getline(rows, line);
  int over_low_zone = 0;
  while (std::getline(rows, line)) {
    std::istringstream cells(line);
    std::vector<std::string> c;
    while (std::getline(cells, cell, ',')) c.push_back(cell);
    EXPECT_GE(std::hypot(std::stod(c[4]) - 1000, std::stod(c[3])), 200 - 0.11) << line;
    over_low_zone += std::hypot(std::stod(c[4]) - 400, std::stod(c[3])) < 100 ? 1 : 0;
  }
  EXPECT_GT(over_low_zone, 0) << "flown over, above its ceiling";
  const auto tangent = json_of_task("path", [&] {
    auto all = high;
    all.insert(all.end(), {"--planner", "tangent"});
    return all;
  }());
  EXPECT_NEAR(tangent["time_s"], double(path["time_s"]), 0.5);
  EXPECT_NE(plan("path", ends).err.find("Give --altitude-m"), std::string::npos);
}

TEST_F(PlanTask, PathsThatCannotBeSayWhy) {
  const auto zones = write("zones.geojson", kDiscs).string();
  const Finished inside =
      plan("path", {"--from", "50,1000,0", "--to", "0,2000,0", "--zones", zones,
                    "--altitude-m", "80", "--json"});
  EXPECT_EQ(inside.status, 2);
  EXPECT_NE(inside.err.find("start-blocked"), std::string::npos) << inside.err;
  const auto about = nlohmann::json::parse(inside.out, nullptr, false);
  EXPECT_EQ(about["outcome"], "start-blocked");
  EXPECT_TRUE(about.contains("alternative")) << inside.out;
  const auto crossing =
      write("crossing.geojson",
            R"({"type":"Polygon","coordinates":[[[0,0],[100,100],[100,0],
                                 [0,90],[0,0]]]})");
  const Finished crossed =
      plan("path", {"--from", "0,0,0", "--to", "0,900,0", "--zones", crossing.string()});
  EXPECT_EQ(crossed.status, 2);
  EXPECT_NE(crossed.err.find("feature 0: its ring crosses itself"), std::string::npos)
      << crossed.err;
  EXPECT_EQ(plan("path", {"--from", "0,0,0", "--to", "0,900,0", "--terrain", "x.tif",
                          "--altitude-m", "50"})
                .status,
            2);
}

TEST_F(PlanTask, PathsStayInTheirBandOfAltitudes) {
  const auto path = json_of_task("path", {"--from", "0,0,90,100", "--to", "0,3000,90,100",
                                          "--floor-m", "90", "--ceiling-m", "120"});
  for (const auto& element : path["plans"][0]["elements"])
    EXPECT_NEAR(element["start"]["altitude_m"], 105, 15);
  const Finished out =
      plan("path", {"--from", "0,0,90,80", "--to", "0,3000,90,100", "--floor-m", "90"});
  EXPECT_EQ(out.status, 2);
  EXPECT_NE(out.err.find("below --floor-m"), std::string::npos) << out.err;
}

TEST_F(PlanTask, CoverageSweepsTheArea) {
  const auto area = write("field.geojson", kField).string();
  const auto found = json_of_task(
      "coverage", {"--area", area, "--swath-m", "100", "--from", "-100,0,0", "--from",
                   "-100,900,0", "--out", "c.html", "--wind-from", "4,200"});
  EXPECT_EQ(found["outcome"], "planned");
  EXPECT_EQ(found["plans"].size(), 2u);
  EXPECT_NEAR(found["area_m2"], 540000, 1);
  EXPECT_NEAR(found["covered_share"], 1, 1e-6);
  const Finished mismatch = plan("coverage", {"--area", area, "--swath-m", "100",
                                              "--from", "0,0,0", "--aircraft", "3"});
  EXPECT_EQ(mismatch.status, 2);
  const auto pipe = write("pipe.geojson", kPipe).string();
  EXPECT_NE(plan("coverage", {"--area", pipe, "--swath-m", "100"}).err.find("is no area"),
            std::string::npos);
}

TEST_F(PlanTask, PatrolFollowsTheLine) {
  const auto line = write("pipe.geojson", kPipe).string();
  const auto found =
      json_of_task("patrol", {"--line", line, "--from=0,-200,90", "--offset-m", "20",
                              "--rounds", "2", "--out", "p.svg"});
  EXPECT_EQ(found["outcome"], "planned");
  EXPECT_LE(double(found["largest_deviation_m"]), 20 + 1e-6);
  EXPECT_EQ(plan("patrol", {"--line", line}).status, 2) << "no start";
  EXPECT_EQ(plan("patrol", {"--line", "none.geojson", "--from", "0,0,0"}).status, 2);
}

TEST_F(PlanTask, OrbitKeepsItsDistance) {
  const auto found = json_of_task(
      "orbit", {"--target", "600,800", "--target-velocity", "1,2", "--from", "0,0,90",
                "--radius-m", "150", "--wind-from", "3,250", "--out", "o.html"});
  EXPECT_EQ(found["outcome"], "planned");
  EXPECT_LE(double(found["largest_error_m"]), 1 + 1e-9);
  const Finished small =
      plan("orbit", {"--target", "600,800", "--from", "0,0,90", "--radius-m", "20"});
  EXPECT_EQ(small.status, 2);
  EXPECT_NE(small.err.find("radius-too-small"), std::string::npos) << small.err;
}

TEST_F(PlanTask, RendezvousIsAtOneTime) {
  const auto found = json_of_task(
      "rendezvous", {"--from", "0,0,0", "--to", "900,900,90", "--from", "0,2000,0",
                     "--to", "950,950,90", "--slowest", "13", "--fastest", "18"});
  EXPECT_EQ(found["outcome"], "planned");
  EXPECT_NEAR(found["arrivals_s"][0], double(found["arrivals_s"][1]), 1e-6);
  EXPECT_EQ(plan("rendezvous", {"--from", "0,0,0"}).status, 2);
}

TEST_F(PlanTask, OutputsAreNoInputsAndAreNotGivenTwice) {
  write("zones.geojson", kDiscs);
  write("field.geojson", kField);
  write("pipe.geojson", kPipe);
  fs::create_symlink("zones.geojson", folder_ / "link.geojson");
  const std::vector<std::string> ends = {"--from",   "0,0,0",        "--to",
                                         "0,2000,0", "--altitude-m", "80"};
  const auto path = [&](std::vector<std::string> more) {
    more.insert(more.end(), ends.begin(), ends.end());
    return plan("path", more);
  };
  const Finished all[] = {
      path({"--zones", "zones.geojson", "--out", "./zones.geojson"}),
      path({"--zones", "zones.geojson", "--out", "link.geojson"}),
      path({"--obstacles", "zones.geojson", "--out", "zones.geojson"}),
      plan("coverage",
           {"--area", "field.geojson", "--swath-m", "100", "--out", "field.geojson"}),
      plan("coverage", {"--area", "field.geojson", "--zones", "zones.geojson",
                        "--swath-m", "100", "--out", "zones.geojson"}),
      plan("patrol",
           {"--line", "pipe.geojson", "--from", "0,0,0", "--out", "pipe.geojson"})};
  for (const Finished& each : all) {
    EXPECT_EQ(each.status, 2);
    EXPECT_NE(each.err.find("is an input as well"), std::string::npos) << each.err;
  }
  EXPECT_EQ(read_file(folder_ / "zones.geojson"), kDiscs);
  EXPECT_EQ(read_file(folder_ / "field.geojson"), kField);
  EXPECT_EQ(read_file(folder_ / "pipe.geojson"), kPipe);
  const Finished twice = path({"--out", "new.csv", "--out", "./new.csv"});
  EXPECT_EQ(twice.status, 2);
  EXPECT_NE(twice.err.find("given twice"), std::string::npos) << twice.err;
}

TEST_F(PlanTask, FormatsAreCheckedBeforeAnythingIsPlanned) {
  const auto area = write("field.geojson", kField).string();
  // So many lines are refused as well, but only when the area has been read.
  const Finished place =
      plan("coverage", {"--area", area, "--swath-m", "0.1", "--out", "plan.geojson"});
  EXPECT_EQ(place.status, 2);
  EXPECT_NE(place.err.find("plan.geojson"), std::string::npos) << place.err;
  EXPECT_NE(place.err.find("--origin"), std::string::npos) << place.err;
  const Finished altitude =
      plan("coverage", {"--area", area, "--swath-m", "0.1", "--origin", "50,14",
                        "--map-metres", "--out", "plan.waypoints"});
  EXPECT_EQ(altitude.status, 2);
  EXPECT_NE(altitude.err.find("--altitude-m"), std::string::npos) << altitude.err;
  const Finished several = plan(
      "coverage", {"--area", area, "--swath-m", "0.1", "--origin", "50,14", "--aircraft",
                   "3", "--map-metres", "--altitude-m", "100", "--out", "plan.plan"});
  EXPECT_EQ(several.status, 2);
  EXPECT_NE(several.err.find("there are 3"), std::string::npos) << several.err;
  // Nothing is written when one of the formats cannot be.
  const Finished connect =
      run({"plan", "connect", "--from", "0,0,0", "--to", "0,500,0", "--airspeed", "15",
           "--turn-radius", "60", "--out", "a.csv", "--out", "a.geojson"});
  EXPECT_EQ(connect.status, 2);
  EXPECT_FALSE(fs::exists(folder_ / "a.csv"));
}

TEST_F(PlanTask, OthersSayWhatTheyComeInto) {
  const auto line = write("pipe.geojson", kPipe).string();
  const auto zone = write("zone.geojson",
                          R"({"type":"Polygon","coordinates":[[[-1000,-1000],[5000,-1000],
                              [5000,5000],[-1000,5000],[-1000,-1000]]]})")
                        .string();
  const auto far = write("far.geojson",
                         R"({"type":"Polygon","coordinates":[[[-90000,-90000],
                             [-80000,-90000],[-80000,-80000],[-90000,-90000]]]})")
                       .string();
  const std::vector<std::pair<const char*, std::vector<std::string>>> all = {
      {"patrol", {"--line", line}},
      {"orbit", {"--target", "300,300"}},
      {"rendezvous", {"--to", "300,900,90"}}};
  for (const auto& [task, more] : all) {
    std::vector<std::string> options = {"--from", "0,0,0", "--json", "--zones", far};
    options.insert(options.end(), more.begin(), more.end());
    const Finished free = plan(task, options);
    EXPECT_EQ(free.status, 0) << free.err;
    EXPECT_EQ(free.err, "") << task;
    options[4] = zone;
    const Finished blocked = plan(task, options);
    EXPECT_EQ(blocked.status, 1) << task;
    EXPECT_NE(blocked.err.find("the flight is in zone 0"), std::string::npos)
        << blocked.err;
    const auto said = nlohmann::json::parse(blocked.out, nullptr, false);
    ASSERT_TRUE(said.contains("conflicts")) << blocked.out;
    EXPECT_EQ(said["conflicts"][0]["aircraft"], 1);
    EXPECT_FALSE(said["plans"].empty());
  }
}

TEST_F(PlanTask, StoppedCoverageKeepsItsBestPlan) {
  const auto area = write("field.geojson", kField).string();
  const pid_t child =
      start({"plan", "coverage", "--area", area, "--swath-m", "3", "--airspeed", "15",
             "--turn-radius", "60", "--out", "survey.csv", "--json"});
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  kill(child, SIGINT);
  const Finished stopped = finish(child);
  EXPECT_EQ(stopped.status, 130) << stopped.err;
  EXPECT_NE(stopped.err.find("best plan so far"), std::string::npos) << stopped.err;
  const auto said = nlohmann::json::parse(stopped.out, nullptr, false);
  ASSERT_TRUE(said.is_object()) << stopped.out;
  EXPECT_EQ(said["covered_share"], 1.0);
  EXPECT_GT(fs::file_size(folder_ / "survey.csv"), 0u);
}

TEST_F(PlanTask, CoverageSaysWhatZonesTake) {
  const auto area = write("field.geojson", kField).string();
  const auto block = write("block.geojson",
                           R"({"type":"Polygon","coordinates":[[[400,250],[500,250],
                               [500,350],[400,350],[400,250]]]})")
                         .string();
  const Finished all =
      plan("coverage", {"--area", area, "--zones", block, "--swath-m", "80"});
  EXPECT_EQ(all.status, 0) << all.err;
  EXPECT_EQ(all.err, "");
  const Finished some =
      plan("coverage", {"--area", area, "--zones", block, "--swath-m", "80",
                        "--altitude-m", "50", "--zone-distance-m", "60"});
  EXPECT_EQ(some.status, 0) << some.err;
  EXPECT_NE(some.err.find("is not covered"), std::string::npos) << some.err;
  EXPECT_NE(some.err.find("--zone-distance-m"), std::string::npos) << some.err;
  const Finished whole = plan("coverage", {"--area", area, "--swath-m", "80"});
  EXPECT_EQ(whole.err, "");
}

TEST_F(PlanTask, APathToTheStartIsEmpty) {
  const Finished finished =
      plan("path", {"--from", "0,0,0", "--to", "0,0,0", "--out", "p.csv", "--json"});
  EXPECT_EQ(finished.status, 0) << finished.err;
  const auto path = nlohmann::json::parse(finished.out, nullptr, false);
  EXPECT_EQ(path["outcome"], "found");
  EXPECT_EQ(path["time_s"], 0);
  EXPECT_TRUE(path["plans"][0]["elements"].empty());
  EXPECT_NE(read_file(folder_ / "p.csv").find("time_s"), std::string::npos);
}

TEST_F(PlanTask, LimitsOfAltitudeAreSaidAsSuch) {
  const Finished high = plan("path", {"--from", "0,0,0,100", "--to", "900,900,0,5000",
                                      "--ceiling-m", "1000", "--out", "p.csv"});
  EXPECT_EQ(high.status, 2);
  EXPECT_NE(high.err.find("the goal at 5000.0 m is above --ceiling-m, 1000 m, by 4000.0"),
            std::string::npos)
      << high.err;
  EXPECT_EQ(high.err.find("nearest"), high.err.rfind("nearest")) << "said once";
  const auto at_both =
      json_of_task("path", {"--from", "0,0,0,100", "--to", "900,900,0,100", "--floor-m",
                            "100", "--ceiling-m", "100"});
  EXPECT_EQ(at_both["outcome"], "found");
  const auto zones = write("zones.geojson", kDiscs).string();
  const Finished sea = plan("path", {"--from", "0,1000,0", "--to", "0,2000,0", "--zones",
                                     zones, "--altitude-m", "0"});
  EXPECT_EQ(sea.status, 2);
  EXPECT_EQ(sea.err.find("-0.0"), std::string::npos) << sea.err;
}

TEST_F(PlanTask, PatrolsWithoutTimeForAPassAreNone) {
  const auto line = write("pipe.geojson", kPipe).string();
  const Finished none = plan("patrol", {"--line", line, "--from", "0,0,0", "--until-s",
                                        "1", "--out", "p.csv", "--json"});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("no plan (no-time)"), std::string::npos) << none.err;
  EXPECT_FALSE(fs::exists(folder_ / "p.csv"));
  const auto about = nlohmann::json::parse(none.out, nullptr, false);
  ASSERT_GT(double(about["first_end_s"]), 1);
  // The minimum time that it says is enough.
  const auto enough =
      json_of_task("patrol", {"--line", line, "--from", "0,0,0", "--until-s",
                              fmt::format("{}", double(about["first_end_s"]) + 0.01)});
  EXPECT_EQ(enough["passes"][0], 1);
}

TEST_F(PlanTask, ZonesMayBeNoneAndMoversAmongThemAreNoted) {
  const auto none =
      write("none.geojson", R"({"type":"FeatureCollection","features":[]})");
  const auto mover = write("mover.geojson",
                           R"({"type":"Feature","properties":{"radius_m":20,
    "height_m":50,"velocity_east_mps":3},
    "geometry":{"type":"Point","coordinates":[500,300,100]}})");
  const auto path = [&](const std::string& zones) {
    return plan("path", {"--from", "0,0,0", "--to", "900,900,0", "--zones", zones});
  };
  const Finished empty = path(none.string()), still = path(mover.string());
  EXPECT_EQ(empty.status, 0);
  EXPECT_NE(empty.err.find("has no zones"), std::string::npos) << empty.err;
  EXPECT_EQ(still.status, 0);
  EXPECT_NE(still.err.find("--obstacles"), std::string::npos) << still.err;
  EXPECT_EQ(plan("coverage", {"--area", none.string(), "--swath-m", "80"}).status, 2);
}

TEST_F(PlanTask, TerrainThatEndsTooEarlyIsSaidWithOptionsOfPlans) {
  const fs::path raster = fs::path(SKEIN_SHARED_DATA) / "terrain/askervein/askervein.tif";
  if (!fs::exists(raster)) GTEST_SKIP() << "no " << raster;
  const Finished off =
      plan("path", {"--origin", "57.18,-7.37", "--from", "0,0,0,500", "--to",
                    "0,3500,0,500", "--terrain", raster.string()});
  EXPECT_EQ(off.status, 2);
  EXPECT_NE(off.err.find("5500 m to each side"), std::string::npos) << off.err;
  EXPECT_EQ(off.err.find("outside: edge"), std::string::npos) << off.err;
}

TEST_F(PlanTask, ListNamesThePlanners) {
  const Finished list = run({"list", "planner"});
  EXPECT_EQ(list.status, 0);
  for (const char* kind : {"aastar", "tangent"})
    EXPECT_NE(list.out.find(kind), std::string::npos) << kind;
}

}  // namespace
}  // namespace skein::app
