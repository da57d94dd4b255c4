// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/traffic/encounters.h"

#include <gtest/gtest.h>

namespace skein::exchange::encounters_test {
namespace {

constexpr const char* kColumns =
    "case,kind,aircraft,alerter,north_m,east_m,down_m,vn_mps,ve_mps,vd_mps\n";

Result<std::vector<Encounter>> read(const std::string& rows) {
  return read_encounters(kColumns + rows, "e.csv",
                         *model::well_clear_configuration("DO_365B_no_SUM"));
}

std::string refusal_of(const std::string& rows) {
  const auto result = read(rows);
  return result ? std::string("accepted") : result.error().text();
}

TEST(Encounters, RowsOfACaseAreOneEncounter) {
  const auto result = read(
      "a,x,0,1,1,2,-3,4,5,-6\n"
      "a,x,1,3,7,8,-9,10,11,12\r\n"
      "\n"
      "b,x,2,1,7,8,-9,10,11,12\n"
      "b,x,0,,1,2,-3,4,5,-6");
  ASSERT_TRUE(result.ok()) << result.error().text();
  ASSERT_EQ(result.value().size(), 2u);
  const Encounter& a = result.value()[0];
  EXPECT_EQ(a.name, "a");
  EXPECT_EQ(a.own.p_N, Vec3(1, 2, -3));
  EXPECT_EQ(a.own.v_N, Vec3(4, 5, -6));
  ASSERT_EQ(a.intruders.size(), 1u);
  EXPECT_EQ(a.numbers[0], 1);
  EXPECT_EQ(a.intruders[0].alerter, 2u);
  EXPECT_EQ(a.intruders[0].motion.v_N, Vec3(10, 11, 12));
  EXPECT_EQ(result.value()[1].numbers[0], 2);
}

TEST(Encounters, ColumnsMayStandInAnyOrder) {
  const auto result = read_encounters(
      "vd_mps,ve_mps,vn_mps,down_m,east_m,north_m,alerter,aircraft,case\n"
      "-6,5,4,-3,2,1,1,0,a\n",
      "e.csv", *model::well_clear_configuration("skein_suas"));
  ASSERT_TRUE(result.ok()) << result.error().text();
  EXPECT_EQ(result.value()[0].own.p_N, Vec3(1, 2, -3));
}

TEST(Encounters, SaysWhatIsWrongAndWhere) {
  const std::string own = "a,x,0,1,1,2,-3,4,5,-6\n";
  for (const auto& [rows, part] : std::vector<std::pair<std::string, std::string>>{
           {own + "a,x,1,9,1,2,3,4,5,6\n",
            "e.csv:3: alerter: 9 is none of configuration DO_365B_no_SUM. It has 1, 2, "
            "3"},
           {own + "a,x,1,1,1,2,3,4,5\n", "e.csv:3: 9 cells; the header has 10."},
           {own + "a,x,1,1,1,2,,4,5,6\n", "e.csv:3: down_m: nothing is no number"},
           {own + "a,x,1,1,1,2,nan,4,5,6\n", "down_m: nan is no number"},
           {own + "a,x,1,1,1,2,3,4,5,1e5\n", "vd_mps: 1e5 is no number from -10000"},
           {own + "a,x,1.5,1,1,2,3,4,5,6\n", "aircraft: 1.5 is no whole number"},
           {own + own, "e.csv:3: case a has two aircraft 0."},
           {own + "b,x,1,1,1,2,3,4,5,6\n", "case b has no aircraft 0"},
           {own + "b,x,0,1,1,2,3,4,5,6\n" + own, "case a is there already."},
           {own + "a,x,1,1,1,2,3,4,5,6\na,x,1,1,1,2,3,4,5,6\n", "two aircraft 1."},
           {",x,0,1,1,2,-3,4,5,-6\n", "case is empty."},
           {"\"a,b\",x,0,1,1,2,-3,4,5,-6\n", "commas and quotation marks"}})
    EXPECT_NE(refusal_of(rows).find(part), std::string::npos) << refusal_of(rows);
  const auto configuration = *model::well_clear_configuration("skein_suas");
  for (const char* table : {"", "\n\n", "case,aircraft\n", "case,case\n"})
    EXPECT_FALSE(read_encounters(table, "e.csv", configuration).ok()) << table;
}

}  // namespace
}  // namespace skein::exchange::encounters_test
