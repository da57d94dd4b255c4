// skein plan: what it takes, what it writes, what it refuses.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>

#include <cmath>
#include <sstream>

#include "app/test/program.h"

namespace skein::app {
namespace {

constexpr const char* kHeader = "x0,y0,psi0,x1,y1,psi1,airspeed,turn_radius,wx,wy\n";

class PlanConnect : public Program {
 protected:
  Finished connect(std::vector<std::string> more) {
    std::vector<std::string> all = {"plan", "connect",       "--airspeed",
                                    "15",   "--turn-radius", "60"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  nlohmann::json json_of(std::vector<std::string> more) {
    more.push_back("--json");
    const Finished finished = connect(std::move(more));
    EXPECT_EQ(finished.status, 0) << finished.err;
    return nlohmann::json::parse(finished.out, nullptr, false);
  }
};

TEST_F(PlanConnect, SaysTimeAndElements) {
  const auto plan = json_of({"--from", "0,0,90", "--to", "600,0,90", "--wind", "-5,0"});
  EXPECT_NEAR(plan["time_s"], 60, 1e-9) << "600 m against the wind, at 15 - 5 m/s";
  EXPECT_NEAR(plan["length_m"], 600, 1e-9);
  ASSERT_EQ(plan["plans"][0]["elements"].size(), 1u);
  EXPECT_NEAR(plan["plans"][0]["elements"][0]["end"]["east_m"], 600, 1e-9);
  const Finished shown = connect({"--from", "0,0,90", "--to", "600,0,90"});
  EXPECT_NE(shown.out.find("straight"), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("40.00 s"), std::string::npos) << shown.out;
}

TEST_F(PlanConnect, WordsAreAsOnTheMap) {
  // Heading north, to a place to the west with heading south: a left turn.
  const auto left = json_of({"--from", "0,0,0", "--to", "-120,0,180"});
  EXPECT_EQ(left["plans"][0]["elements"][0]["kind"], "left turn");
  EXPECT_EQ(std::string(left["word"])[0], 'L');
}

TEST_F(PlanConnect, WindMayBeGivenByWhereItComesFrom) {
  const auto a = json_of({"--from", "0,0,10", "--to", "500,300,200", "--wind", "5,0"});
  const auto b =
      json_of({"--from", "0,0,10", "--to", "500,300,200", "--wind-from", "5,270"});
  EXPECT_NEAR(a["time_s"], double(b["time_s"]), 1e-9);
}

TEST_F(PlanConnect, CoursesBecomeHeadings) {
  // Course east in a wind from the north: the nose points into it.
  const auto plan = json_of({"--from", "0,0,90", "--to", "900,0,90", "--wind", "0,-5",
                             "--from-course", "--to-course"});
  EXPECT_NEAR(plan["plans"][0]["elements"][0]["heading_deg"],
              90 - std::asin(5.0 / 15) * 57.29577951308232, 1e-6);
  EXPECT_NEAR(plan["length_m"], 900, 1e-6) << "straight over ground";
}

TEST_F(PlanConnect, ClimbsAndArrivesInTime) {
  const auto climb = json_of(
      {"--from", "0,0,0,100", "--to", "0,300,0,400", "--climb", "2", "--sink", "3"});
  // 300 m at 2 m/s; the length is met to 1e-10 turn radii.
  EXPECT_NEAR(double(climb["time_s"]), 150, 1e-8);
  EXPECT_EQ(climb["altitude_case"], "high");
  const auto later = json_of({"--from", "0,0,0", "--to", "0,600,0", "--arrive-s", "100"});
  EXPECT_NEAR(later["time_s"], 100, 1e-9);
  const Finished early =
      connect({"--from", "0,0,0", "--to", "0,600,0", "--arrive-s", "30"});
  EXPECT_EQ(early.status, 2);
  EXPECT_NE(early.err.find("the soonest is 40 s"), std::string::npos) << early.err;
}

TEST_F(PlanConnect, RefusesWhatCannotBe) {
  const std::vector<std::pair<std::vector<std::string>, const char*>> faults = {
      {{"--from", "0,0,0"}, "--to: is needed"},
      {{"--from", "0,0", "--to", "1,1,1"}, "2 numbers given"},
      {{"--from", "0,0,nan", "--to", "1,1,1"}, "\"nan\" is not a finite number"},
      {{"--from", "0,0,0", "--to", "5,5,5", "--wind", "15,0"}, "below the airspeed"},
      {{"--from", "0,0,0", "--to", "2e6,5,5"}, "from the origin"},
      {{"--from-geo", "95,0,0", "--to", "2,5,5"}, "--from-geo: latitude 95"},
      {{"--from", "0,0,0", "--to-geo", "50,14,5"}, "Give --origin"},
      {{"--from", "0,0,0", "--to", "5,5,5", "--out", "x.pdf"}, "Allowed: .geojson"},
      {{"--from", "0,0,0", "--to", "5,5,5", "--out", "x.kml"}, "Give --origin"},
      {{"--from", "0,0,0,50", "--to", "5,5,5"}, "has no altitude"},
      {{"--from", "0,0,0,50", "--to", "5,5,5,90"}, "--climb: is needed"},
      {{"--from", "0,0,0", "--to", "5,5,5", "--origin", "50,14", "--out", "x.plan"},
       "Give --altitude-m"},
      {{"--from", "0,0,0", "--to", "5,5,5", "--batch", "x.csv"}, "--batch"}};
  for (const auto& [options, text] : faults) {
    const Finished refused = connect(options);
    EXPECT_EQ(refused.status, 2) << text;
    EXPECT_NE(refused.err.find(text), std::string::npos) << text << "\n" << refused.err;
  }
}

TEST_F(PlanConnect, WritesAllFormatsAtOnce) {
  const Finished finished = connect(
      {"--from-geo", "50.05,14.4,90", "--to-geo",    "50.06,14.42,0", "--altitude-m",
       "400",        "--wind-from",   "5,270",       "--out",         "a.geojson",
       "--out",      "a.csv",         "--out",       "a.kml",         "--out",
       "a.plan",     "--out",         "a.waypoints", "--out",         "a.svg",
       "--out",      "a.html"});
  ASSERT_EQ(finished.status, 0) << finished.err;
  for (const char* ending : {"geojson", "csv", "kml", "plan", "waypoints", "svg", "html"})
    EXPECT_GT(fs::file_size(folder_ / (std::string("a.") + ending)), 400u) << ending;
  const auto unwritable =
      connect({"--from", "0,0,0", "--to", "5,5,5", "--out", "no/such/folder.svg"});
  EXPECT_EQ(unwritable.status, 1);
  EXPECT_NE(unwritable.err.find("cannot be written"), std::string::npos);
}

class PlanBatch : public PlanConnect {
 protected:
  Finished batch(const std::string& rows) {
    return run({"plan", "connect", "--batch", write("cases.csv", rows).string()});
  }
};

TEST_F(PlanBatch, AnswersRowByRow) {
  const Finished finished = batch(std::string(kHeader) +
                                  "0,0,0,600,0,0,15,60,-5,0\n"
                                  "0,0,0,600,0,0,15,0,-5,0\n"
                                  "0,0,0,600,0,0,15,60,-15,0\n");
  EXPECT_EQ(finished.status, 0) << "rows that cannot be solved are answers, too";
  std::istringstream lines(finished.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "time_s,word,length_m,status");
  std::getline(lines, line);
  EXPECT_TRUE(line.starts_with("60,") && line.ends_with(",600,found")) << line;
  std::getline(lines, line);
  EXPECT_EQ(line, ",,,bad-input");
  std::getline(lines, line);
  EXPECT_EQ(line, ",,,wind-too-strong");
  EXPECT_NE(finished.err.find("2 of 3 rows"), std::string::npos) << finished.err;
}

TEST_F(PlanBatch, WritesAFileToo) {
  const auto in = write("cases.csv", std::string(kHeader) + "0,0,0,600,0,0,15,60,0,0\n");
  EXPECT_EQ(
      run({"plan", "connect", "--batch", in.string(), "--output", "out.csv"}).status, 0);
  EXPECT_NE(read_file(folder_ / "out.csv").find("\n40,"), std::string::npos);
  EXPECT_EQ(
      run({"plan", "connect", "--batch", in.string(), "--output", in.string()}).status,
      2);
  EXPECT_EQ(run({"plan", "connect", "--batch", "nothing.csv"}).status, 2);
  EXPECT_EQ(run({"plan", "connect", "--batch", "."}).status, 2);
  EXPECT_EQ(batch("x0,y0\n1,2\n").status, 2);
}

TEST_F(PlanBatch, AnswersInAPipeAtOnceAndStopsWhenAsked) {
  int to[2], from[2];
  ASSERT_EQ(pipe(to), 0);
  ASSERT_EQ(pipe(from), 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(to[0], STDIN_FILENO);
    dup2(from[1], STDOUT_FILENO);
    for (const int end : {to[0], to[1], from[0], from[1]}) close(end);
    execl(SKEIN_PROGRAM, SKEIN_PROGRAM, "plan", "connect", "--batch", "-", nullptr);
    _exit(99);
  }
  close(to[0]);
  close(from[1]);
  const std::string row = std::string(kHeader) + "0,0,0,600,0,0,15,60,0,0\n";
  ASSERT_EQ(::write(to[1], row.data(), row.size()), static_cast<ssize_t>(row.size()));
  // The answer is there while the table is still open.
  std::string answer;
  char c = 0;
  while (std::count(answer.begin(), answer.end(), '\n') < 2 && read(from[0], &c, 1) == 1)
    answer += c;
  EXPECT_NE(answer.find("40,"), std::string::npos) << answer;
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  close(to[1]);
  close(from[0]);
}

TEST_F(PlanBatch, EndsWhenNobodyReads) {
  std::string rows = kHeader;
  for (int i = 0; i < 200'000; ++i) rows += "0,0,0,600,0,0,15,60,0,0\n";
  const auto file = write("cases.csv", rows);
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  close(ends[0]);
  const Finished cut = run_into(ends[1], {"plan", "connect", "--batch", file.string()});
  close(ends[1]);
  EXPECT_EQ(cut.status, 0);
  EXPECT_EQ(cut.err, "");
  const int device = open("/dev/full", O_WRONLY);
  const Finished full = run_into(device, {"plan", "connect", "--batch", file.string()});
  close(device);
  EXPECT_EQ(full.status, 1);
}

constexpr const char* kDiscs = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"name":"tower","radius_m":200},
 "geometry":{"type":"Point","coordinates":[1000,0]}},
{"type":"Feature","properties":{"radius_m":100,"floor_m":0,"ceiling_m":50},
 "geometry":{"type":"Point","coordinates":[400,0]}}]})";
constexpr const char* kField = R"({"type":"Feature","properties":{"name":"field"},
"geometry":{"type":"Polygon","coordinates":[[[0,0],[900,0],[900,600],[0,600],[0,0]]]}})";
constexpr const char* kPipe = R"({"type":"Feature","properties":{"name":"pipe"},
"geometry":{"type":"LineString","coordinates":[[0,0],[900,0],[1500,600]]}})";

class PlanTask : public PlanConnect {
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
                                         "2000,0,90", "--zones", zones};
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
    EXPECT_GE(std::hypot(std::stod(c[3]) - 1000, std::stod(c[4])), 200 - 0.11) << line;
    over_low_zone += std::hypot(std::stod(c[3]) - 400, std::stod(c[4])) < 100 ? 1 : 0;
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
      plan("path", {"--from", "1000,50,0", "--to", "2000,0,0", "--zones", zones,
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
      plan("path", {"--from", "0,0,0", "--to", "900,0,0", "--zones", crossing.string()});
  EXPECT_EQ(crossed.status, 2);
  EXPECT_NE(crossed.err.find("feature 0: its ring crosses itself"), std::string::npos)
      << crossed.err;
  EXPECT_EQ(plan("path", {"--from", "0,0,0", "--to", "900,0,0", "--terrain", "x.tif",
                          "--altitude-m", "50"})
                .status,
            2);
}

TEST_F(PlanTask, PathsStayInTheirBandOfAltitudes) {
  const auto path = json_of_task("path", {"--from", "0,0,90,100", "--to", "3000,0,90,100",
                                          "--floor-m", "90", "--ceiling-m", "120"});
  for (const auto& element : path["plans"][0]["elements"])
    EXPECT_NEAR(element["start"]["altitude_m"], 105, 15);
  const Finished out =
      plan("path", {"--from", "0,0,90,80", "--to", "3000,0,90,100", "--floor-m", "90"});
  EXPECT_EQ(out.status, 2);
  EXPECT_NE(out.err.find("below --floor-m"), std::string::npos) << out.err;
}

TEST_F(PlanTask, CoverageSweepsTheArea) {
  const auto area = write("field.geojson", kField).string();
  const auto found = json_of_task(
      "coverage", {"--area", area, "--swath-m", "100", "--from", "0,-100,0", "--from",
                   "900,-100,0", "--out", "c.html", "--wind-from", "4,200"});
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
      json_of_task("patrol", {"--line", line, "--from=-200,0,90", "--offset-m", "20",
                              "--rounds", "2", "--out", "p.svg"});
  EXPECT_EQ(found["outcome"], "planned");
  EXPECT_LE(double(found["largest_deviation_m"]), 20 + 1e-6);
  EXPECT_EQ(plan("patrol", {"--line", line}).status, 2) << "no start";
  EXPECT_EQ(plan("patrol", {"--line", "none.geojson", "--from", "0,0,0"}).status, 2);
}

TEST_F(PlanTask, OrbitKeepsItsDistance) {
  const auto found = json_of_task(
      "orbit", {"--target", "800,600", "--target-velocity", "2,1", "--from", "0,0,90",
                "--radius-m", "150", "--wind-from", "3,250", "--out", "o.html"});
  EXPECT_EQ(found["outcome"], "planned");
  EXPECT_LE(double(found["largest_error_m"]), 1 + 1e-9);
  const Finished small =
      plan("orbit", {"--target", "800,600", "--from", "0,0,90", "--radius-m", "20"});
  EXPECT_EQ(small.status, 2);
  EXPECT_NE(small.err.find("radius-too-small"), std::string::npos) << small.err;
}

TEST_F(PlanTask, RendezvousIsAtOneTime) {
  const auto found = json_of_task(
      "rendezvous", {"--from", "0,0,0", "--to", "900,900,90", "--from", "2000,0,0",
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
                                         "2000,0,0", "--altitude-m", "80"};
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
      {"rendezvous", {"--to", "900,300,90"}}};
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
  const Finished sea = plan("path", {"--from", "1000,0,0", "--to", "2000,0,0", "--zones",
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
  // The least time that it says is enough.
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
  if (!fs::exists(raster)) GTEST_SKIP() << "no shared data";
  const Finished off =
      plan("path", {"--origin", "57.18,-7.37", "--from", "0,0,0,500", "--to",
                    "3500,0,0,500", "--terrain", raster.string()});
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
