// SPDX-License-Identifier: Apache-2.0
// Whatever a command writes into a file goes through a device, a pipe or a link where
// there is one, and leaves it there.
#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <atomic>
#include <map>
#include <set>
#include <sstream>

#include "app/test/program.h"

namespace skein::app {
namespace {

using Words = std::vector<std::string>;

// An option that names a file which is written, as it is used in the tests: OUT stands
// for the file, without its ending.
struct FileOption {
  std::string line, ending;
  bool may_be_empty = false;
};

// Options of commands that name files to be written: "net --trace". A new one belongs
// here.
std::map<std::string, FileOption> file_options() {
  const std::string ends =
      " --from 0,0,0 --to 500,100,90 --airspeed 15 --turn-radius 60 ";
  const std::string flown = " --airspeed 15 --turn-radius 60 ";
  const std::string nodes = "net --nodes " SKEIN_SOURCE_DIR
                            "/scenarios/network/nodes.csv --profile nn4 "
                            "--duration 1 "
                            "--saturate 0,1,500,2 ";
  const std::string detect = "avoid detect --batch e.csv --config skein_suas ";
  return {
      {"fly --output", {"fly --aircraft aerosonde --input in.csv --output OUT", ".csv"}},
      {"plan connect --out", {"plan connect" + ends + "--out OUT", ".svg"}},
      {"plan connect --output", {"plan connect --batch rows.csv --output OUT", ".csv"}},
      {"plan path --out", {"plan path" + ends + "--out OUT", ".html"}},
      {"plan fleet --out",
       {"plan fleet fleet.csv" + flown + "--altitude-m 100 --out OUT", ".csv"}},
      {"plan coverage --out",
       {"plan coverage --area area.geojson --from 0,0,0 --swath-m 200" + flown +
            "--out OUT",
        ".csv"}},
      {"plan patrol --out",
       {"plan patrol --line line.geojson --from 0,0,0" + flown + "--out OUT", ".csv"}},
      {"plan orbit --out",
       {"plan orbit --target 600,800 --from 0,0,90" + flown + "--out OUT", ".html"}},
      {"plan rendezvous --out",
       {"plan rendezvous --from 0,0,0 --to 900,900,90 --from 0,2000,0 --to 950,950,90 "
        "--slowest 13 --fastest 18" +
            flown + "--out OUT",
        ".svg"}},
      {"avoid detect --out", {detect + "--out OUT", ".csv"}},
      {"avoid detect --bands", {detect + "--out a.csv --bands OUT", ".csv"}},
      {"avoid detect --guidance", {detect + "--out a.csv --guidance OUT", ".csv"}},
      {"avoid negotiate --out", {"avoid negotiate --batch b.json --out OUT", ".csv"}},
      {"report --out", {"report r --out OUT", ".html"}},
      {"export --out", {"export r --what tracks --out OUT", ".gpkg"}},
      {"fire --out", {"fire fire.geojson --out OUT", ".geojson"}},
      {"fire --scenario", {"fire fire.geojson --scenario OUT", ".yaml"}},
      {"link --tlog",
       {"link udpin:0 udpin:0 --for 0.2 --overwrite --tlog OUT", ".tlog", true}},
      {"relay --stats",
       {"relay --listen udpin:0 --to 127.0.0.1:9 --for 0.2 --stats OUT", ".csv"}},
      {"team allocate --out", {"team allocate --batch c.json --out OUT", ".csv"}},
      {"team route --out", {"team route --batch t.json --out OUT", ".csv"}},
      {"team tours --out",
       {"team tours --batch p.csv --vehicles 2 --iterations 100 --out OUT", ".csv"}},
      {"team rehearse --out", {"team rehearse --scripts s.json --out OUT", ".csv"}},
      {"team messages --out", {"team messages r --out OUT", ".csv"}},
      {"net --out", {nodes + "--out OUT", ".csv"}},
      {"net --trace", {nodes + "--out a.csv --trace OUT", ".txt"}},
      {"net --report", {nodes + "--out a.csv --report OUT", ".html"}}};
}

// Options of these names are of files that are written, or of folders.
bool is_output(const std::string& option) {
  static const std::set<std::string> all = {
      "--out", "--output", "--bands", "--guidance", "--stats", "--tlog", "--trace"};
  return all.contains(option);
}
// Options with texts that name something else, read it, or are none of a file.
bool is_known(const std::string& option) {
  static const std::set<std::string> all = {"--aircraft",
                                            "--area",
                                            "--at",
                                            "--autopilot",
                                            "--batch",
                                            "--cases",
                                            "--certificate",
                                            "--config",
                                            "--corners",
                                            "--data",
                                            "--date-order",
                                            "--deal",
                                            "--entity",
                                            "--estimators",
                                            "--from",
                                            "--from-geo",
                                            "--gains",
                                            "--host",
                                            "--imagery",
                                            "--incident",
                                            "--input",
                                            "--key",
                                            "--kind",
                                            "--line",
                                            "--link",
                                            "--listen",
                                            "--method",
                                            "--modem",
                                            "--name",
                                            "--nodes",
                                            "--obstacles",
                                            "--only",
                                            "--only-cases",
                                            "--origin",
                                            "--planner",
                                            "--plant",
                                            "--plugin",
                                            "--profile",
                                            "--profiles",
                                            "--replay",
                                            "--saturate",
                                            "--scripts",
                                            "--seed",
                                            "--separation",
                                            "--serve",
                                            "--set",
                                            "--side",
                                            "--speed",
                                            "--intruder-room",
                                            "--strategies",
                                            "--target",
                                            "--target-geo",
                                            "--target-velocity",
                                            "--team",
                                            "--terrain",
                                            "--time-field",
                                            "--to",
                                            "--to-geo",
                                            "--tokens",
                                            "--tracks",
                                            "--traffic",
                                            "--trust",
                                            "--turbulence",
                                            "--unsigned",
                                            "--updates",
                                            "--viewer-origin",
                                            "--what",
                                            "--wind",
                                            "--wind-from",
                                            "--world",
                                            "--zones"};
  return all.contains(option);
}

// Reads a pipe while it lives: nobody who opens the other end waits.
class PipeReader {
 public:
  explicit PipeReader(const fs::path& pipe) {
    ::mkfifo(pipe.c_str(), 0600);
    end_ = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    thread_ = std::thread([this] {
      while (!over_ || read_some()) {
        pollfd here{end_, POLLIN, 0};
        ::poll(&here, 1, 20);
        read_some();
      }
    });
  }
  ~PipeReader() {
    finish();
    ::close(end_);
  }
  // All that was written, once the writer has ended.
  const std::string& finish() {
    over_ = true;
    if (thread_.joinable()) thread_.join();
    return text_;
  }

 private:
  bool read_some() {
    char part[1 << 16];
    const ssize_t count = ::read(end_, part, sizeof part);
    if (count > 0) text_.append(part, static_cast<std::size_t>(count));
    return count > 0;
  }

  int end_ = -1;
  std::atomic<bool> over_{false};
  std::string text_;
  std::thread thread_;
};

class SpecialFiles : public Program {
 protected:
  void SetUp() override {
    write("s.yaml", "duration_s: 40\naircraft: [{count: 2}]\n");
    write("rows.csv",
          "x0,y0,psi0,x1,y1,psi1,airspeed,turn_radius,wx,wy\n"
          "0,0,0,600,0,0,15,60,0,0\n");
    write(
        "area.geojson",
        R"({"type":"Polygon","coordinates":[[[0,0],[600,0],[600,600],[0,600],[0,0]]]})");
    write("fleet.csv",
          "name,start_north_m,start_east_m,start_heading_deg,goal_north_m,goal_east_m,"
          "goal_heading_deg\na,0,0,0,900,0,0\n");
    write("line.geojson", R"({"type":"LineString","coordinates":[[0,0],[500,100]]})");
    write("e.csv",
          "case,aircraft,alerter,north_m,east_m,down_m,vn_mps,ve_mps,vd_mps\n"
          "h,0,1,0,0,-200,20,0,0\nh,1,1,2000,0,-200,-20,0,0\n");
    write("b.json",
          R"([{"id": "a", "utility_1": [1], "utility_2": [1], "free": [[1]]}])");
    write("c.json", R"([{"id":"c","aircraft":[
        {"id":1,"north_m":0,"east_m":0,"v_min_mps":0,"v_max_mps":25,"cruise_mps":20,
         "turn_radius_m":0,"endurance_s":1000,"sensors":{}}],"tasks":[]}])");
    write("t.json",
          R"([{"id":"r","aircraft":[{"id":1,"north_m":0,"east_m":0,"speed_mps":10}],
              "tasks":[{"id":1,"north_m":100,"east_m":0}]}])");
    write("p.csv", "set,point,x,y\na,1,0,0\na,2,5,5\na,3,9,0\n");
    write("s.json", R"([{"id": "a", "aircraft": [4, 1], "tasks": 2,
        "events": [{"t_s": 60, "what": "crash", "aircraft": 1}], "end_s": 100}])");
    write("fire.geojson",
          R"({"type":"Feature","properties":{"time_utc":"2021-09-05T14:04:00Z"},
              "geometry":{"type":"Polygon","coordinates":[[[-121,38.9],[-120.99,38.9],
              [-120.99,38.91],[-121,38.91],[-121,38.9]]]}})");
    ASSERT_EQ(run({"run", "s.yaml", "--out", "r"}).status, 0);
    const Finished held = run(
        {"fly", "--trim", "--aircraft", "aerosonde", "--airspeed", "25", "--hold", "2"});
    ASSERT_EQ(held.status, 0) << held.err;
    write("in.csv", held.out);
  }

  // Every option with a text of every command: "net --trace", and whether it is a folder.
  void read_help(const Words& path, std::map<std::string, bool>& options) {
    Words asked = path;
    asked.push_back("--help");
    std::istringstream help(run(asked).out);
    Words commands;
    std::string words, last;
    for (const std::string& word : path) words += word + " ";
    bool lists_commands = false;
    for (std::string line; std::getline(help, line);) {
      if (line.starts_with("Subcommands:")) lists_commands = true;
      if (line.empty()) lists_commands = false;
      if (lists_commands && line.size() > 2 && line.starts_with("  ") && line[2] != ' ')
        commands.push_back(line.substr(2, line.find(' ', 2) - 2));
      const std::size_t at = line.find("--");
      if (!line.starts_with("  ") || at == std::string::npos || at > 6) {
        // What stands further in goes on with the option before.
        if (!line.starts_with(std::string(20, ' '))) last.clear();
        if (!last.empty() && line.find("Folder") != std::string::npos)
          options[last] = true;
        continue;
      }
      last.clear();
      std::istringstream parts(line.substr(at));
      std::string name, type;
      parts >> name >> type;
      if (!type.starts_with("TEXT") && !type.starts_with("FILE")) continue;
      last = words + name;
      options[last] = line.find("Folder") != std::string::npos;
    }
    for (const std::string& command : commands) {
      Words longer = path;
      longer.push_back(command);
      read_help(longer, options);
    }
  }

  Finished use(const FileOption& option, const std::string& stem) {
    std::string line = option.line;
    line.replace(line.find("OUT"), 3, stem + option.ending);
    std::istringstream in(line);
    return run({std::istream_iterator<std::string>(in), {}});
  }

  void expect_nothing_beside() {
    for (const fs::directory_entry& each : fs::directory_iterator(folder_))
      EXPECT_EQ(each.path().filename().string().find(".skein"), std::string::npos)
          << each.path();
  }
};

TEST_F(SpecialFiles, EveryOptionThatNamesAFileIsKnown) {
  std::map<std::string, bool> options;
  read_help({}, options);
  const auto tested = file_options();
  std::size_t files = 0;
  for (const auto& [option, is_folder] : options) {
    const std::string name = option.substr(option.rfind("--"));
    if (is_folder) continue;
    const bool written = tested.contains(option);
    EXPECT_TRUE(written || is_known(name))
        << option << ": does it name a file that is written? Then it belongs into "
        << "file_options().";
    EXPECT_TRUE(written || !is_output(name)) << option << " is not tested";
    files += written;
  }
  EXPECT_EQ(files, tested.size()) << "an option of the tests is not there any more";
}

TEST_F(SpecialFiles, DevicesStayDevices) {
  const fs::path probe = folder_ / "probe";
  const bool made = ::mknod(probe.c_str(), S_IFCHR | 0666, ::makedev(1, 3)) == 0;
  const int opened = made ? ::open(probe.c_str(), O_WRONLY) : -1;
  if (opened < 0) GTEST_SKIP() << "no device can be made here";
  ::close(opened);
  for (const auto& [name, option] : file_options()) {
    const fs::path device = folder_ / ("device" + option.ending);
    ::mknod(device.c_str(), S_IFCHR | 0666, ::makedev(1, 3));
    const Finished done = use(option, "device");
    EXPECT_EQ(done.status, 0) << name << "\n" << done.err;
    EXPECT_TRUE(fs::is_character_file(device)) << name;
  }
  expect_nothing_beside();
}

TEST_F(SpecialFiles, PipesAreWrittenInto) {
  for (const auto& [name, option] : file_options()) {
    const fs::path pipe = folder_ / ("pipe" + option.ending);
    PipeReader reader(pipe);
    const Finished done = use(option, "pipe");
    EXPECT_EQ(done.status, 0) << name << "\n" << done.err;
    EXPECT_TRUE(fs::is_fifo(pipe)) << name;
    EXPECT_TRUE(option.may_be_empty || !reader.finish().empty()) << name;
  }
  expect_nothing_beside();
}

TEST_F(SpecialFiles, WhatALinkNamesIsWrittenAndTheLinkStays) {
  fs::create_directory(folder_ / "there");
  for (const auto& [name, option] : file_options()) {
    const fs::path link = folder_ / ("link" + option.ending);
    const fs::path file = folder_ / "there" / ("file" + option.ending);
    std::error_code none;
    fs::remove(file, none);
    if (!fs::is_symlink(link)) fs::create_symlink("there/file" + option.ending, link);
    const Finished done = use(option, "link");
    EXPECT_EQ(done.status, 0) << name << "\n" << done.err;
    EXPECT_TRUE(fs::is_symlink(link)) << name;
    EXPECT_TRUE(fs::is_regular_file(file)) << name;
    EXPECT_TRUE(option.may_be_empty || fs::file_size(file) > 0) << name;
  }
  expect_nothing_beside();
}

TEST_F(SpecialFiles, ACampaignsFilesMayBeLinksAndPipes) {
  write("c.yaml",
        "name: c\nscenario: s.yaml\nseeds: 2\nfigures: [{figure: simulated_s}]\n");
  fs::create_directory(folder_ / "out");
  for (const char* name : {"runs.jsonl", "runs.csv", "summary.json"})
    fs::create_symlink(std::string("../kept-") + name, folder_ / "out" / name);
  const fs::path pipe = folder_ / "out" / "report.html";
  PipeReader reader(pipe);
  const Finished done = run({"campaign", "c.yaml", "--out", "out"});
  EXPECT_EQ(done.status, 0) << done.err;
  EXPECT_NE(reader.finish().find("</html>"), std::string::npos);
  for (const char* name : {"runs.jsonl", "runs.csv", "summary.json"}) {
    EXPECT_TRUE(fs::is_symlink(folder_ / "out" / name)) << name;
    EXPECT_TRUE(fs::exists(folder_ / (std::string("kept-") + name))) << name;
  }
  EXPECT_TRUE(fs::is_fifo(pipe));
  expect_nothing_beside();
}

}  // namespace
}  // namespace skein::app
