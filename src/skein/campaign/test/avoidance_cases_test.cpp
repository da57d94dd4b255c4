// SPDX-License-Identifier: Apache-2.0
#include "skein/campaign/avoidance/avoidance_cases.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "skein/campaign/avoidance/avoidance_watch.h"

namespace skein::campaign::avoidance_cases_test {
namespace {

constexpr const char* kTeamHeader =
    "case,aircraft,start_north_m,start_east_m,start_down_m,goal_north_m,goal_east_m,"
    "goal_down_m,airspeed_mps,wind_north_mps,wind_east_mps\n";
constexpr const char* kEncounterHeader =
    "case,own_north_m,own_east_m,own_down_m,goal_north_m,goal_east_m,own_speed_mps,"
    "int_north_m,int_east_m,int_down_m,int_vn_mps,int_ve_mps,int_vd_mps,turn_from_s,"
    "turn_for_s,turn_rate_radps,climb_vd_mps\n";

auto cases_of(const std::string& text) {
  return parse_avoidance_cases(text, "cases");
}

std::string problem_of(const std::string& text) {
  const auto cases = cases_of(text);
  return cases ? "" : cases.error().text();
}

TEST(AvoidanceCases, OfATeamHaveARowForEachAircraft) {
  const auto cases = cases_of(std::string(kTeamHeader) +
                              "a,1,0,0,-150,4000,0,-150,20,3,-4\n"
                              "a,2,4000,0,-150,0,0,-150,18,3,-4\n"
                              "b,1,0,0,-100,0,900,-120,20,,\n");
  ASSERT_TRUE(cases.ok()) << cases.error().text();
  ASSERT_EQ(cases.value().size(), 2U);
  EXPECT_EQ(cases.value()[0].aircraft.size(), 2U);
  EXPECT_EQ(cases.value()[0].wind, Vec2(3, -4));
  EXPECT_EQ(cases.value()[1].wind, Vec2(0, 0));
  EXPECT_EQ(cases.value()[1].aircraft[0].goal, Vec3(0, 900, -120));
  EXPECT_TRUE(cases.value()[0].intruders.empty());
}

TEST(AvoidanceCases, OfEncountersHaveAnIntruder) {
  const auto cases =
      cases_of(std::string(kEncounterHeader) +
               "e,0,0,-150,4000,0,20,5000,100,-160,-40,1,0.5,33,5,-0.02,-1\n"
               "f,0,0,-150,4000,0,20,5000,100,-160,-40,1,0,,0,0,0\n");
  ASSERT_TRUE(cases.ok()) << cases.error().text();
  const AvoidanceCase& turning = cases.value()[0];
  EXPECT_EQ(turning.aircraft[0].goal, Vec3(4000, 0, -150)) << "level";
  EXPECT_EQ(turning.intruders[0].v_N, Vec3(-40, 1, 0.5));
  ASSERT_TRUE(turning.intruders[0].turn.has_value());
  EXPECT_EQ(turning.intruders[0].turn->rate, -0.02);
  EXPECT_EQ(turning.intruders[0].turn->climb, 1) << "upwards";
  EXPECT_FALSE(cases.value()[1].intruders[0].turn.has_value());
}

TEST(AvoidanceCases, SayWhatIsWrongAndWhere) {
  const std::string team = kTeamHeader, encounters = kEncounterHeader;
  EXPECT_NE(problem_of(team).find("has no cases"), std::string::npos);
  EXPECT_NE(problem_of("case,aircraft\n").find("start_north_m"), std::string::npos);
  EXPECT_NE(problem_of(team + "a,1,0,0,0,9,9,0,-3,,\n").find("airspeed_mps"),
            std::string::npos);
  EXPECT_NE(problem_of(team + "a,1,0,0,0,0,0,0,20,,\n").find("at one place"),
            std::string::npos);
  EXPECT_NE(problem_of(team + ",1,0,0,0,9,9,0,20,,\n").find("is empty"),
            std::string::npos);
  EXPECT_NE(
      problem_of(encounters + "e,0,0,0,9,9,20,5,5,0,0,0,0,,0,0,0\n").find("int_vn_mps"),
      std::string::npos);
  EXPECT_NE(problem_of(encounters + "e,0,0,0,9,9,20,5,5,0,9,0,0,3,0,0.1,0\n")
                .find("turn_for_s"),
            std::string::npos);
  EXPECT_NE(problem_of(encounters + "e,0,0,0,9,9,20,5,5,0,9,0,0,3,5,7,0\n")
                .find("turn_rate_radps"),
            std::string::npos);
}

// The cases that are given with what becomes of them without avoidance.
TEST(AvoidanceCases, ReadTheEncountersThatThereAre) {
  const std::filesystem::path file =
      std::filesystem::path(SKEIN_SHARED_DATA) / "team/encounters/encounters.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const auto cases = read_avoidance_cases(file);
  ASSERT_TRUE(cases.ok()) << cases.error().text();
  EXPECT_EQ(cases.value().size(), 334U);
}

// Two that pass, and an intruder that crosses: what the watch makes of it.
TEST(AvoidanceWatch, CountsIntrudersToo) {
  AvoidanceCase flown;
  flown.aircraft = {{Vec3(0, 0, -150), Vec3(4000, 0, -150), 20}};
  flown.intruders = {{Vec3(4000, 300, -150), Vec3(-20, 0, 0), {}}};
  AvoidanceWatch watch(flown, {609.6, 76.2});
  watch.record(EntityRecord{EntityId{1}, "a1", "aircraft"});
  TrafficMotion motion;
  motion.traffic = 1;
  motion.position = flown.intruders[0].p_N;
  motion.velocity = flown.intruders[0].v_N;
  watch.record(motion);
  for (int k = 0; k <= 500; ++k) {
    TruthRecord truth;
    truth.time = Time::from_seconds(0.5 * k);
    truth.id = EntityId{1};
    truth.state.p_N = Vec3(10.0 * k, 0, -150);
    watch.record(truth);
  }
  std::map<std::string, double> figures;
  watch.add_figures(figures);
  EXPECT_EQ(figures.at("lowc"), 1);
  EXPECT_EQ(figures.at("nmac"), 0);
  EXPECT_NEAR(figures.at("min_horizontal_m"), 300, 0.1);
  EXPECT_NEAR(figures.at("extra_time_s"), 0, 0.01);
}

}  // namespace
}  // namespace skein::campaign::avoidance_cases_test
