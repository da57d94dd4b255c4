// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/aircraft/flight_table.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "skein/base/random.h"

namespace skein::assemble::flight_table_test {
namespace {

constexpr const char* kHeader =
    "t,de_rad,da_rad,dr_rad,thrust_N,wind_n_mps,wind_e_mps,wind_d_mps,north_m,east_m,"
    "down_m,u_mps,v_mps,w_mps,phi_rad,theta_rad,psi_rad,p_rps,q_rps,r_rps\n";
constexpr const char* kFirst =
    "0,-0.1,0.01,0.02,10,1,2,3,4,5,-100,25,6,7,.1,.2,.3,1,2,3\n";

// What reading all of a table ends with: the message, or the number of rows.
std::string outcome(const std::string& text) {
  std::istringstream in(text);
  FlightTableReader table(in, "in.csv");
  const auto first = table.first();
  if (!first) return first.error().text();
  for (int rows = 1;; ++rows) {
    const auto row = table.next();
    if (!row) return row.error().text();
    if (!row.value()) return std::to_string(rows);
  }
}

std::string with(const std::string& rows) {
  return kHeader + std::string(kFirst) + rows;
}

TEST(FlightTable, ReadsInputsAndTheInitialState) {
  std::istringstream in(with("0.5,1e-3,+0,-0,-1,0,0,-2.5\n"));
  FlightTableReader table(in, "in.csv");
  const auto first = table.first();
  ASSERT_TRUE(first.ok()) << first.error().text();
  EXPECT_EQ(first.value().elevator, -0.1);
  EXPECT_EQ(first.value().aileron, 0.01);
  EXPECT_EQ(first.value().rudder, 0.02);
  EXPECT_EQ(first.value().thrust, 10);
  EXPECT_EQ(first.value().wind_N, Vec3(1, 2, 3));
  EXPECT_EQ(table.start().p_N, Vec3(4, 5, -100));
  EXPECT_EQ(table.start().v_B, Vec3(25, 6, 7));
  EXPECT_EQ(table.start().attitude.roll, 0.1);
  EXPECT_EQ(table.start().attitude.pitch, 0.2);
  EXPECT_EQ(table.start().attitude.yaw, 0.3);
  EXPECT_EQ(table.start().w_NB_B, Vec3(1, 2, 3));
  const auto second = table.next();
  ASSERT_TRUE(second.ok() && second.value()) << second.error().text();
  EXPECT_EQ(second.value()->t, 0.5);
  EXPECT_EQ(second.value()->wind_N.z(), -2.5);
  EXPECT_EQ(table.line(), 3u);
  EXPECT_FALSE(table.next().value());
}

TEST(FlightTable, TakesColumnsInAnyOrderAmongOthers) {
  const std::string table =
      "r_rps,note,t,q_rps,p_rps,psi_rad,theta_rad,phi_rad,w_mps,v_mps,u_mps,down_m,"
      "east_m,north_m,wind_d_mps,wind_e_mps,wind_n_mps,thrust_N,dr_rad,da_rad,de_rad\n"
      "3,\"a, b\",7,2,1,0,0,0,0,0,20,0,0,0,0,0,0,1,0,0,-.25\n"
      ",,8,,,,,,,,,,,,0,0,0,1,0,0,nonsense\n";
  std::istringstream in(table);
  FlightTableReader reader(in, "in.csv");
  const auto first = reader.first();
  ASSERT_TRUE(first.ok()) << first.error().text();
  EXPECT_EQ(first.value().t, 7);
  EXPECT_EQ(first.value().elevator, -0.25);
  EXPECT_EQ(reader.start().w_NB_B, Vec3(1, 2, 3));
  EXPECT_EQ(reader.next().error().text(),
            "in.csv:3:de_rad: found \"nonsense\"; needs a number.");
}

TEST(FlightTable, TakesAnyFiniteAngle) {
  RandomStream random(4, 0, Purpose::kTest);
  for (int k = 0; k < 200; ++k) {
    const double yaw = random.uniform(-geo::kPi, geo::kPi);
    const int turns = static_cast<int>(random.uniform(-1000, 1000));
    std::istringstream in(kHeader + fmt::format("0,0,0,0,0,0,0,0,0,0,-100,25,0,0,{0},{0},"
                                                "{0:.17g},0,0,0\n",
                                                yaw + 2 * geo::kPi * turns));
    FlightTableReader table(in, "in.csv");
    const auto first = table.first();
    ASSERT_TRUE(first.ok()) << first.error().text();
    // A double of some thousand has an error of 1e-12.
    const geo::Euler& at = table.start().attitude;
    for (const double angle : {at.roll, at.pitch, at.yaw}) {
      EXPECT_NEAR(geo::wrap_pi(angle - yaw), 0, 1e-11) << turns;
      EXPECT_LE(std::abs(angle), geo::kPi);
    }
  }
  // A whole turn, rounded up by a spreadsheet.
  std::string turn = kHeader + std::string(kFirst);
  turn.replace(turn.find(",.3,"), 4, ",6.2831853072,");
  EXPECT_EQ(outcome(turn), "1");
}

TEST(FlightTable, TakesWhatSpreadsheetsWrite) {
  std::string text =
      "\xEF\xBB\xBF" + with("1,0,0,0,0,0,0,0,,,,,,,,,,,,\n\n  \n2,0,0,0,0,0,0,0");
  for (std::size_t at = 0; (at = text.find('\n', at)) != text.npos; at += 2)
    text.replace(at, 1, "\r\n");
  EXPECT_EQ(outcome(text), "3");
}

struct Case {
  std::string table;
  const char* message;
};

class FlightTableRefuses : public testing::TestWithParam<Case> {};

TEST_P(FlightTableRefuses, WithLineColumnAndRule) {
  EXPECT_EQ(outcome(GetParam().table), GetParam().message);
}

std::string replaced(std::string text, const std::string& piece,
                     const std::string& instead) {
  return text.replace(text.find(piece), piece.size(), instead);
}

INSTANTIATE_TEST_SUITE_P(
    All, FlightTableRefuses,
    testing::Values(
        Case{"",
             "in.csv: the table is empty. Its first line names the columns: t, "
             "de_rad, ..."},
        Case{
            kHeader,
            "in.csv: the table has no rows. Its first row also holds the initial state."},
        Case{replaced(kHeader, "de_rad", "de"), "in.csv:1: the header lacks: de_rad."},
        Case{replaced(replaced(kHeader, "thrust_N", "thrust_n"), "psi_rad", "x"),
             "in.csv:1: the header lacks: thrust_N, psi_rad. Is \"thrust_n\" the column "
             "thrust_N?"},
        Case{replaced(kHeader, "t,", "t,t,"), "in.csv:1: given twice: t."},
        Case{with("1,\xFF,0,0,0,0,0,0\n"),
             "in.csv:3:de_rad: found bytes that are no text; needs a number."},
        Case{with("0,0,0,0,0,0,0,0\n"),
             "in.csv:3:t: found 0; must be above 0, that of the row before."},
        Case{with("1,0,0,0,0,0,0,0\n0.5,0,0,0,0,0,0,0\n"),
             "in.csv:4:t: found 0.5; must be above 1, that of the row before."},
        Case{with("1,0,0,0,0,0,0\n"),
             "in.csv:3:wind_d_mps: is missing: the row has 7 values."},
        Case{with("1,0,,0,0,0,0,0\n"), "in.csv:3:da_rad: is empty; needs a number."},
        Case{with("1,0,0,0,0,nan,0,0\n"),
             "in.csv:3:wind_n_mps: found \"nan\"; needs a number."},
        Case{with("1,0,0,0,0,0,.inf,0\n"),
             "in.csv:3:wind_e_mps: found \".inf\"; needs a number."},
        Case{with("1,0,0,0,0,1e999,0,0\n"),
             "in.csv:3:wind_n_mps: found \"1e999\"; needs a number."},
        Case{with("1,-5,0,0,0,0,0,0\n"),
             "in.csv:3:de_rad: found -5; must be from -1.6 to 1.6. Angles are in "
             "radians."},
        Case{kHeader + replaced(kFirst, "-100,", "x,"),
             "in.csv:2:down_m: found \"x\"; needs a number."},
        Case{kHeader + replaced(kFirst, "-100,", "100000,"),
             "in.csv:2:down_m: found 100000; must be from -11000 to 1000. Down is minus "
             "the altitude above mean sea level."},
        Case{with(std::string(2'000'000, '1')),
             "in.csv:3: a line of more than 1048575 bytes."}));

}  // namespace
}  // namespace skein::assemble::flight_table_test
