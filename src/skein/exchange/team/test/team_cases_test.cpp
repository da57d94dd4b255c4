// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/team/team_cases.h"

#include <gtest/gtest.h>

#include "skein/exchange/team/team_answers.h"

namespace skein::exchange::team_cases_test {
namespace {

const char* const kAircraft =
    R"({"id":1,"north_m":0,"east_m":0,"v_min_mps":12,"v_max_mps":25,"cruise_mps":20,
        "turn_radius_m":50,"endurance_s":1000,
        "sensors":{"camera":{"swath_m":100,"quality":0.8}}})";

std::string coalition(const std::string& tasks, const std::string& more = "") {
  std::string text = R"([{"id":"c","aircraft":[)";
  text.append(kAircraft).append(R"(],"tasks":[)").append(tasks).append("]");
  return text.append(more).append("}]");
}

std::string text_of(const Error& error) {
  return error.text();
}

TEST(CoalitionCases, HoldAllKindsOfTasks) {
  const std::string at = R"("north_m":3,"east_m":4)";
  std::string tasks;
  int id = 0;
  for (const char* what :
       {R"("kind":"surveillance","sensor":"camera","area_m2":4e5)",
        R"("kind":"tracking","sensor":"camera","target_speed_mps":15)",
        R"("kind":"patrol-line","length_m":500,"revisit_s":100)",
        R"("kind":"perimeter-watch","length_m":500,"revisit_s":100)",
        R"("kind":"waypoints","length_m":500)", R"("kind":"route","length_m":500)",
        R"("kind":"protect","aircraft_wanted":1)",
        R"("kind":"cordon","sensor":"camera","aircraft_wanted":2)",
        R"("kind":"escort","aircraft_wanted":1)",
        R"("kind":"relay","from_north_m":0,"from_east_m":0,
                              "to_north_m":9,"to_east_m":9,"range_m":100)",
        R"("kind":"measure-field","shares":[0.5])",
        R"("kind":"fire-perimeter","shares":[0.25])"}) {
    ++id;
    tasks += (id > 1 ? "," : "") + std::string("{\"id\":") + std::to_string(id) + "," +
             at + "," + what + "}";
  }
  const auto cases = read_coalition_cases(coalition(tasks), "f", true);
  ASSERT_TRUE(cases.ok()) << text_of(cases.error());
  const auto& problem = cases.value()[0].problem;
  ASSERT_EQ(problem.tasks.size(), 12U);
  EXPECT_NEAR(problem.tasks[0].brings[0], 4, 1e-12);  // 0.8 100 20 1000 / 4e5
  EXPECT_NEAR(problem.tasks[11].brings[0], 0.25, 1e-12);
  EXPECT_NEAR(problem.tasks[0].cost[0], 1 / 1.001, 1e-12);  // the longest distance
  EXPECT_EQ(cases.value()[0].tasks[11], 12);
}

TEST(CoalitionCases, SayWhereAndWhatIsWrong) {
  const auto message = [](const std::string& text) {
    const auto cases = read_coalition_cases(text, "f.json", true);
    return cases ? std::string("accepted") : text_of(cases.error());
  };
  EXPECT_NE(message("{").find("f.json: it is no JSON"), std::string::npos);
  EXPECT_NE(message("{}").find("must be a list"), std::string::npos);
  EXPECT_NE(message("[{\"id\":\"a\",\"id\":\"b\"}]").find("\"id\" stands twice"),
            std::string::npos);
  EXPECT_NE(message(coalition("")).find("accepted"), std::string::npos);
  EXPECT_NE(message(coalition("", ",\"more\":1"))
                .find("f.json: [0].more: unknown key. Allowed: id, aircraft, tasks, "
                      "delta_d_per_m."),
            std::string::npos);
  const std::string wrong = message(coalition(
      R"({"id":1,"kind":"surveillance","sensor":"camera","north_m":0,"east_m":0,
          "area_m2":-4,"colour":1})"));
  EXPECT_NE(wrong.find("f.json: [0].tasks[0].area_m2: must be a number from 1e-09"),
            std::string::npos)
      << wrong;
  EXPECT_NE(wrong.find("f.json: [0].tasks[0].colour: unknown key."), std::string::npos)
      << wrong;
  EXPECT_NE(message(coalition(R"({"id":1,"kind":"dance","north_m":0,"east_m":0})"))
                .find("must be one of: surveillance, tracking"),
            std::string::npos);
}

const char* const kRoutes = R"([{"id":"r","aircraft":[
    {"id":7,"north_m":0,"east_m":0,"speed_mps":10},
    {"id":9,"north_m":1000,"east_m":0,"speed_mps":10}],
  "tasks":[{"id":1,"north_m":100,"east_m":0,"service_s":5,"eligible":[9]},
           {"id":2,"north_m":900,"east_m":0,"opens_s":3,"closes_s":200},
           {"id":5,"north_m":500,"east_m":0,"service_s":20}]MORE}])";

std::string routes(const std::string& more) {
  std::string text = kRoutes;
  return text.replace(text.find("MORE"), 4, more);
}

TEST(SequenceCases, AreAnsweredWithTheIdsOfTheFile) {
  const auto cases = read_sequence_cases(routes(""), "f");
  ASSERT_TRUE(cases.ok()) << text_of(cases.error());
  const auto row = answer(cases.value()[0], {});
  ASSERT_TRUE(row.ok());
  // 9 flies 900 m to task 1, over task 2 on the way; 7 does task 5.
  EXPECT_NEAR(row.value().quality.value, 95, 1e-9);
  EXPECT_EQ(row.value().answer, "5|2 1");
  EXPECT_EQ(answer_row(row.value(), 1.5), "r,95.000000000,5|2 1,95.000000000,1,1.500\n");
}

TEST(SequenceCases, HaveRelationsAndOrders) {
  const auto cases = read_sequence_cases(routes(R"(,"objective":"total","returns":true,
        "relations":[{"kind":"before","first":1,"second":2,"time_s":10},
                     {"kind":"at","first":1,"time_s":100},
                     {"kind":"together","first":2,"second":5}],
        "orders":[{"sequence":[1,{"parallel":[2]}]}])"),
                                         "f");
  ASSERT_TRUE(cases.ok()) << text_of(cases.error());
  const auto row = answer(cases.value()[0], {});
  ASSERT_TRUE(row.ok()) << text_of(row.error());
  EXPECT_TRUE(row.value().feasible);
  EXPECT_TRUE(row.value().quality.proven);
}

TEST(SequenceCases, SayWhereAndWhatIsWrong) {
  const auto message = [](const std::string& more) {
    const auto cases = read_sequence_cases(routes(more), "f");
    return cases ? std::string("accepted") : text_of(cases.error());
  };
  EXPECT_NE(message(R"(,"relations":[{"kind":"before","first":1,"second":4}])")
                .find("f: [0].relations[0].second: no task has the id 4."),
            std::string::npos);
  EXPECT_NE(message(R"(,"orders":[{"series":[1]}])").find("f: [0].orders[0]: must be"),
            std::string::npos);
  EXPECT_NE(message(R"(,"objective":"discounted")").find("need each other"),
            std::string::npos);
  EXPECT_NE(message(R"(,"orders":[17])").find("must be the id of a task"),
            std::string::npos);
}

TEST(TourCases, AreNamedBySetAndTours) {
  const std::string points = "set,point,x,y\na,1,0,0\na,4,3,4\nb,1,0,0\na,9,0,5\n";
  const auto cases =
      read_tour_cases(points, "p", "vehicles,set,more\n2,a,x\n1,b,\n", "c");
  ASSERT_TRUE(cases.ok()) << text_of(cases.error());
  ASSERT_EQ(cases.value().size(), 2U);
  const TeamAnswer row = answer(cases.value()[0], {});
  EXPECT_EQ(row.id, "a-2");
  EXPECT_NEAR(row.quality.value, 10, 1e-12);
  EXPECT_TRUE(row.quality.proven);
  EXPECT_EQ(read_tour_cases(points, "p", {1, 2}).value().size(), 4U);
}

TEST(TourCases, SayWhereAndWhatIsWrong) {
  const auto message = [](const std::string& points, const std::string& cases) {
    const auto read = read_tour_cases(points, "p", cases, "c");
    return read ? std::string("accepted") : text_of(read.error());
  };
  const std::string good = "set,point,x,y\na,1,0,0\n";
  EXPECT_EQ(message(good, "set,vehicles\na,2\n"), "accepted");
  EXPECT_NE(message(good, "set,vehicles\nb,2\n").find("c:2: set: b has no points."),
            std::string::npos);
  EXPECT_NE(message(good, "set,vehicles\na,0\n").find("c:2: vehicles: must be a number"),
            std::string::npos);
  EXPECT_NE(message("set,point,x,y\na,1,0\n", "").find("p:2: has 3 cells"),
            std::string::npos);
  EXPECT_NE(message("set,point,x,y\na,1,0,zero\n", "").find("p:2: y: must be a number"),
            std::string::npos);
  EXPECT_NE(message("set,point,x,y,z\n", "").find("only these columns"),
            std::string::npos);
  EXPECT_NE(message("", "").find("p: is empty."), std::string::npos);
}

}  // namespace
}  // namespace skein::exchange::team_cases_test
