// SPDX-License-Identifier: Apache-2.0
// skein plan fleet: what it takes, what it writes, what it refuses.
#include <signal.h>
#include <sys/stat.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "app/test/program.h"

namespace skein::app {
namespace {

constexpr const char* kHead =
    "name,start_north_m,start_east_m,start_heading_deg,goal_north_m,goal_east_m,"
    "goal_heading_deg,earliest_start_s,latest_start_s\n";

class PlanFleet : public Program {
 protected:
  Finished fleet(const std::string& table, std::vector<std::string> more) {
    std::vector<std::string> all = {"plan",         "fleet",         table,
                                    "--altitude-m", "300",           "--airspeed",
                                    "15",           "--turn-radius", "60"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  // From all sides through one middle.
  std::string star(int count, int latest) {
    std::string text = kHead;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * 3.141592653589793 * i / count;
      const double north = 900 * std::cos(angle), east = 900 * std::sin(angle);
      const double heading = std::fmod(angle * 180 / 3.141592653589793 + 180, 360);
      text += "uav-" + std::to_string(i + 1);
      for (const double value : {north, east, heading, -north, -east, heading, 0.0})
        text += "," + std::to_string(value);
      text += "," + std::to_string(latest) + "\n";
    }
    return write("star.csv", text).string();
  }
  // Places of a written CSV: [name][time] -> north, east.
  std::map<std::string, std::map<double, std::pair<double, double>>> places(
      const std::string& name) {
    std::map<std::string, std::map<double, std::pair<double, double>>> all;
    std::istringstream rows(read_file(folder_ / name));
    std::string line, cell;
    std::getline(rows, line);
    while (std::getline(rows, line)) {
      std::istringstream cells(line);
      std::vector<std::string> c;
      while (std::getline(cells, cell, ',')) c.push_back(cell);
      all[c[0]][std::stod(c[2])] = {std::stod(c[3]), std::stod(c[4])};
    }
    return all;
  }
};

TEST_F(PlanFleet, FlightsThatCrossAreKeptApart) {
  const auto table = star(8, 200);
  const Finished done =
      fleet(table, {"--room-height-m", "500", "--origin", "50,14", "--wind-from", "5,250",
                    "--json", "--out", "f.csv", "--out", "f.geojson", "--out", "f.kml",
                    "--out", "f.svg"});
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_EQ(done.err, "");
  const auto said = nlohmann::json::parse(done.out, nullptr, false);
  EXPECT_EQ(said["aircraft"], 8);
  EXPECT_EQ(said["planned"], 8);
  EXPECT_GT(said["delayed"], 0);
  EXPECT_GT(double(said["length_m"]), double(said["direct_length_m"]));
  EXPECT_EQ(said["separation"]["pairs"], 28);
  EXPECT_EQ(said["separation"]["pairs_in_rooms"], 0);
  EXPECT_GE(double(said["separation"]["nearest_room"]["distance_m"]), 29.9);
  EXPECT_EQ(said["plans"].size(), 8u);
  EXPECT_EQ(said["flights"][2]["name"], "uav-3");
  // The file has what is said to be far enough: all pairs at their own rows' times.
  const auto all = places("f.csv");
  ASSERT_EQ(all.size(), 8u);
  double least = 1e9;
  for (const auto& [a, rows] : all)
    for (const auto& [b, others] : all) {
      if (a >= b) continue;
      for (const auto& [time, p] : rows) {
        const auto later = others.lower_bound(time);
        if (later == others.end() || later == others.begin()) continue;
        const auto before = std::prev(later);
        const double share = (time - before->first) / (later->first - before->first);
        const double north = std::lerp(before->second.first, later->second.first, share);
        const double east = std::lerp(before->second.second, later->second.second, share);
        least = std::min(least, std::hypot(north - p.first, east - p.second));
      }
    }
  // Chords of the file are up to 1 m off, rows up to 1 s apart.
  EXPECT_GE(least, double(said["separation"]["nearest"]["distance_m"]) - 2);
  const auto map =
      nlohmann::json::parse(read_file(folder_ / "f.geojson"), nullptr, false);
  std::set<std::string> lines;
  for (const auto& feature : map["features"])
    if (feature["geometry"]["type"] == "LineString")
      lines.insert(feature["properties"].value("plan", ""));
  for (int i = 1; i <= 8; ++i)
    EXPECT_TRUE(lines.contains("uav-" + std::to_string(i))) << i;
  EXPECT_NE(read_file(folder_ / "f.kml").find("uav-8"), std::string::npos);
  EXPECT_NE(read_file(folder_ / "f.svg").find("uav-8"), std::string::npos);
}

TEST_F(PlanFleet, GivesTheSameBytesEachTime) {
  const auto table = star(9, 60);
  const std::vector<std::string> more = {"--wind", "4,-3",  "--out",
                                         "f.csv",  "--out", "f.html"};
  const Finished first = fleet(table, more);
  const std::string csv = read_file(folder_ / "f.csv");
  const std::string html = read_file(folder_ / "f.html");
  EXPECT_FALSE(csv.empty());
  const Finished second = fleet(table, more);
  EXPECT_EQ(first.out, second.out);
  EXPECT_EQ(first.err, second.err);
  EXPECT_EQ(read_file(folder_ / "f.csv"), csv);
  EXPECT_EQ(read_file(folder_ / "f.html"), html);
  EXPECT_NE(first.out.find("Least separation: "), std::string::npos) << first.out;
  EXPECT_NE(first.out.find("Planned: 9 of 9 aircraft"), std::string::npos) << first.out;
}

TEST_F(PlanFleet, WhoFindsNoFlightIsNamedAndTheOthersFly) {
  const auto zones = write("z.geojson", R"({"type":"Feature","properties":{"name":"tower",
"radius_m":100},"geometry":{"type":"Point","coordinates":[0,-900]}})");
  const Finished done = fleet(star(4, 100), {"--zones", zones.string(), "--json"});
  EXPECT_EQ(done.status, 1);
  EXPECT_NE(done.err.find("note: uav-1 has no flight (goal-blocked): the goal is in zone "
                          "'tower'"),
            std::string::npos)
      << done.err;
  EXPECT_NE(done.err.find("note: uav-3 has no flight (start-blocked)"), std::string::npos)
      << done.err;
  const auto said = nlohmann::json::parse(done.out, nullptr, false);
  EXPECT_EQ(said["planned"], 2);
  EXPECT_EQ(said["plans"].size(), 2u);
  EXPECT_EQ(said["flights"][0]["outcome"], "goal-blocked");
}

TEST_F(PlanFleet, BadInputIsNamedAndLosesNothing) {
  const auto out = write("f.csv", "what was there");
  const auto expect = [&](const std::string& table, std::vector<std::string> more,
                          const std::string& part) {
    more.insert(more.end(), {"--out", "f.csv"});
    const Finished refused = fleet(table, more);
    EXPECT_EQ(refused.status, 2) << refused.err;
    EXPECT_NE(refused.err.find(part), std::string::npos) << refused.err;
    EXPECT_EQ(refused.out, "");
    EXPECT_EQ(read_file(out), "what was there");
  };
  expect("none.csv", {}, "none.csv");
  expect(".", {}, "is a folder");
  expect("f.csv", {}, "f.csv: is an input as well as an output");
  write("bad.csv", kHead + std::string("a,0,0,90,400,x,0,,\n"));
  expect("bad.csv", {}, "bad.csv:2: column \"goal_east_m\": \"x\" is no number from");
  const auto table = star(2, 0);
  expect(table, {"--wind", "20,0"}, "must be below the airspeed");
  expect(table, {"--out", "f.plan"}, "place on Earth is not known");
  expect(table, {"--out", "f.plan", "--origin", "50,14"},
         "a mission file holds one flight; there are 2");
  expect(table, {"--room-radius-m", "0"}, "--room-radius-m");
  expect(table, {"--latest-start-s", "nan"}, "--latest-start-s");
  expect(table, {"--zones", "none.geojson"}, "none.geojson");
  const Finished level = run({"plan", "fleet", table, "--airspeed", "15", "--turn-radius",
                              "60", "--out", "f.csv"});
  EXPECT_EQ(level.status, 2);
  EXPECT_NE(level.err.find("--altitude-m: is needed"), std::string::npos) << level.err;
  EXPECT_EQ(read_file(out), "what was there");
}

TEST_F(PlanFleet, WritesToDevicesAndReadsPipes) {
  star(3, 100);
  fs::create_symlink("/dev/stdin", folder_ / "in.csv");
  fs::create_symlink("/dev/null", folder_ / "out.csv");
  input_ = folder_ / "star.csv";
  const Finished done = fleet("in.csv", {"--out", "out.csv"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_TRUE(fs::is_symlink(folder_ / "out.csv")) << "a device is not replaced";
  const Finished full = fleet("star.csv", {"--out", "no/such/folder.csv"});
  EXPECT_EQ(full.status, 1) << full.err;
}

TEST_F(PlanFleet, ASignalEndsIt) {
  // Nobody gets out of the ring, whenever they start; all starts of a day are tried.
  std::string ring = R"({"type":"Feature","properties":{},"geometry":{"type":"Polygon",
"coordinates":[[[-400,-400],[400,-400],[400,400],[-400,400],[-400,-400]],
[[-300,-300],[-300,300],[300,300],[300,-300],[-300,-300]]]}})";
  write("ring.geojson", ring);
  std::string text = kHead;
  for (int i = 0; i < 200; ++i)
    text += "a" + std::to_string(i) + ",0,0,0,2000,0,0,0,86400\n";
  // The table comes by a pipe: once it is read the program listens to signals.
  ASSERT_EQ(mkfifo((folder_ / "many.csv").c_str(), 0600), 0);
  write("f.csv", "what was there");
  const pid_t child =
      start({"plan", "fleet", "many.csv", "--airspeed", "15", "--turn-radius", "60",
             "--altitude-m", "300", "--zones", "ring.geojson", "--out", "f.csv"});
  write("many.csv", text);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  kill(child, SIGINT);
  const Finished ended = finish(child);
  EXPECT_EQ(ended.status, 130) << ended.err;
  EXPECT_EQ(read_file(folder_ / "f.csv"), "what was there");
}

}  // namespace
}  // namespace skein::app
