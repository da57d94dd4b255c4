// SPDX-License-Identifier: Apache-2.0
// skein plan connect: what it takes, what it writes, what it refuses.
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>

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
  const auto plan = json_of({"--from", "0,0,90", "--to", "0,600,90", "--wind", "0,-5"});
  EXPECT_NEAR(plan["time_s"], 60, 1e-9) << "600 m against the wind, at 15 - 5 m/s";
  EXPECT_NEAR(plan["length_m"], 600, 1e-9);
  ASSERT_EQ(plan["plans"][0]["elements"].size(), 1u);
  EXPECT_NEAR(plan["plans"][0]["elements"][0]["end"]["east_m"], 600, 1e-9);
  const Finished shown = connect({"--from", "0,0,90", "--to", "0,600,90"});
  EXPECT_NE(shown.out.find("straight"), std::string::npos) << shown.out;
  EXPECT_NE(shown.out.find("40.00 s"), std::string::npos) << shown.out;
}

TEST_F(PlanConnect, WordsAreAsOnTheMap) {
  // Heading north, to a place to the west with heading south: a left turn.
  const auto left = json_of({"--from", "0,0,0", "--to", "0,-120,180"});
  EXPECT_EQ(left["plans"][0]["elements"][0]["kind"], "left turn");
  EXPECT_EQ(std::string(left["word"])[0], 'L');
}

TEST_F(PlanConnect, WindMayBeGivenByWhereItComesFrom) {
  const auto a = json_of({"--from", "0,0,10", "--to", "300,500,200", "--wind", "0,5"});
  const auto b =
      json_of({"--from", "0,0,10", "--to", "300,500,200", "--wind-from", "5,270"});
  EXPECT_NEAR(a["time_s"], double(b["time_s"]), 1e-9);
}

TEST_F(PlanConnect, CoursesBecomeHeadings) {
  // Course east in a wind from the north: the nose points into it.
  const auto plan = json_of({"--from", "0,0,90", "--to", "0,900,90", "--wind", "-5,0",
                             "--from-course", "--to-course"});
  EXPECT_NEAR(plan["plans"][0]["elements"][0]["heading_deg"],
              90 - std::asin(5.0 / 15) * 57.29577951308232, 1e-6);
  EXPECT_NEAR(plan["length_m"], 900, 1e-6) << "straight over ground";
}

TEST_F(PlanConnect, ClimbsAndArrivesInTime) {
  const auto climb = json_of(
      {"--from", "0,0,0,100", "--to", "300,0,0,400", "--climb", "2", "--sink", "3"});
  // 300 m at 2 m/s; the length is met to 1e-10 turn radii.
  EXPECT_NEAR(double(climb["time_s"]), 150, 1e-8);
  EXPECT_EQ(climb["altitude_case"], "high");
  const auto later = json_of({"--from", "0,0,0", "--to", "600,0,0", "--arrive-s", "100"});
  EXPECT_NEAR(later["time_s"], 100, 1e-9);
  const Finished early =
      connect({"--from", "0,0,0", "--to", "600,0,0", "--arrive-s", "30"});
  EXPECT_EQ(early.status, 2);
  EXPECT_NE(early.err.find("the quickest connection takes 40 s"), std::string::npos)
      << early.err;
}

TEST_F(PlanConnect, ClimbsBeginAndEndByVerticalTurns) {
  const auto climb = json_of({"--from", "0,0,0,100", "--to", "300,0,0,130", "--climb",
                              "2", "--sink", "3", "--climb-acceleration", "1"});
  EXPECT_NEAR(climb["time_s"], 20, 1e-8) << "15 s at 2 m/s, and 2 s for both turns";
  const auto& elements = climb["plans"][0]["elements"];
  ASSERT_EQ(elements.size(), 3U);
  EXPECT_EQ(elements[0]["kind"], "vertical turn up");
  EXPECT_EQ(elements[1]["kind"], "straight");
  EXPECT_EQ(elements[2]["kind"], "vertical turn down");
  EXPECT_EQ(elements[0]["climb_mps"], 0);
  EXPECT_NEAR(elements[2]["climb_mps2"], -1, 1e-9);
  EXPECT_NEAR(elements[2]["end"]["altitude_m"], 130, 1e-9);
  const Finished refused =
      connect({"--from", "0,0,0", "--to", "600,0,0", "--climb-acceleration", "-1"});
  EXPECT_EQ(refused.status, 2);
}

TEST_F(PlanConnect, RefusesWhatCannotBe) {
  const std::vector<std::pair<std::vector<std::string>, const char*>> errors = {
      {{"--from", "0,0,0"}, "--to: is needed"},
      {{"--from", "0,0", "--to", "1,1,1"}, "2 numbers given"},
      {{"--from", "0,0,nan", "--to", "1,1,1"}, "\"nan\" is not a finite number"},
      {{"--from", "0,0,0", "--to", "5,5,5", "--wind", "0,15"}, "below the airspeed"},
      {{"--from", "0,0,0", "--to", "5,2e6,5"}, "from the origin"},
      {{"--from-geo", "95,0,0", "--to", "5,2,5"}, "--from-geo: latitude 95"},
      {{"--from", "0,0,0", "--to-geo", "50,14,5"}, "Give --origin"},
      {{"--from", "0,0,0", "--to", "5,5,5", "--out", "x.pdf"}, "Allowed: .geojson"},
      {{"--from", "0,0,0", "--to", "5,5,5", "--out", "x.kml"}, "Give --origin"},
      {{"--from", "0,0,0,50", "--to", "5,5,5"}, "has no altitude"},
      {{"--from", "0,0,0,50", "--to", "5,5,5,90"}, "--climb: is needed"},
      {{"--from", "0,0,0", "--to", "5,5,5", "--origin", "50,14", "--out", "x.plan"},
       "Give --altitude-m"},
      {{"--from", "0,0,0", "--to", "5,5,5", "--batch", "x.csv"}, "--batch"}};
  for (const auto& [options, text] : errors) {
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

TEST_F(PlanBatch, StopsWhileItWaitsForThePipeOfItsRows) {
  ASSERT_EQ(mkfifo((folder_ / "rows").c_str(), 0600), 0);
  const pid_t child = start({"plan", "connect", "--batch", "rows"});
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // it waits by then
  kill(child, SIGINT);
  EXPECT_EQ(finish(child).status, 130);
}

TEST_F(PlanBatch, StopsWhileItWaitsForWhoReadsItsAnswers) {
  ASSERT_EQ(mkfifo((folder_ / "answers").c_str(), 0600), 0);
  const auto rows =
      write("cases.csv", std::string(kHeader) + "0,0,0,600,0,0,15,60,0,0\n");
  const pid_t child =
      start({"plan", "connect", "--batch", rows.string(), "--output", "answers"});
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  kill(child, SIGINT);
  EXPECT_EQ(finish(child).status, 130);
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

}  // namespace
}  // namespace skein::app
