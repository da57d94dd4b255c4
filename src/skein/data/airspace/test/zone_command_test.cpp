// SPDX-License-Identifier: Apache-2.0
#include "skein/data/airspace/zone_command.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "skein/base/random.h"

namespace skein::zone_command_test {
namespace {

ZoneChange good(std::string_view line) {
  auto change = parse_zone_command(line);
  if (!change) {
    ADD_FAILURE() << line << ": " << change.error().text();
    return {};
  }
  return std::move(change).value();
}

std::string error(std::string_view line) {
  const auto change = parse_zone_command(line);
  return change ? "none" : change.error().text();
}

TEST(ZoneCommand, DrawsACircle) {
  const ZoneChange change =
      good("zone on school circle 120.5,-30 80 ceiling 150 floor -2 from 1e2 until 200");
  EXPECT_TRUE(change.on);
  EXPECT_EQ(change.number, 0u);
  EXPECT_EQ(change.zone.name, "school");
  EXPECT_EQ(std::get<Disc>(change.zone.area).centre, Vec2(120.5, -30));
  EXPECT_EQ(std::get<Disc>(change.zone.area).radius, 80);
  EXPECT_EQ(change.zone.floor_msl, -2);
  EXPECT_EQ(change.zone.ceiling_msl, 150);
  EXPECT_EQ(change.zone.from, 100);
  EXPECT_EQ(change.zone.until, 200);
}

TEST(ZoneCommand, DrawsARingInEitherSense) {
  for (const char* line : {"zone on a ring 0,0 100,0 100,100\r",
                           "  zone\ton a ring 100,100 100,0 0,0 floor 50"}) {
    const geo::Ring ring = std::get<geo::Ring>(good(line).zone.area);
    ASSERT_EQ(ring.size(), 3u);
    EXPECT_DOUBLE_EQ(geo::signed_area(ring), 5000);
  }
  EXPECT_TRUE(std::isinf(good("zone on a ring 0,0 9,0 9,9").zone.floor_msl));
}

TEST(ZoneCommand, NamesAZone) {
  EXPECT_FALSE(good("zone off a").on);
  const ZoneChange again = good("zone on a");
  EXPECT_TRUE(again.on);
  EXPECT_TRUE(std::get<geo::Ring>(again.zone.area).empty());
}

TEST(ZoneCommand, SaysWhatIsWrong) {
  EXPECT_NE(error("").find("no command"), std::string::npos);
  EXPECT_NE(error("zone on").find("no command"), std::string::npos);
  EXPECT_NE(error("zone up a").find("no command"), std::string::npos);
  EXPECT_NE(error("zone off a circle 0,0 5").find("name only"), std::string::npos);
  EXPECT_NE(error("zone on a square 0,0 5").find("no shape"), std::string::npos);
  EXPECT_NE(error("zone on a circle 0,0").find("radius"), std::string::npos);
  EXPECT_NE(error("zone on a circle 0;0 5").find("NORTH,EAST"), std::string::npos);
  EXPECT_NE(error("zone on a circle 0,0 nan").find("radius"), std::string::npos);
  EXPECT_NE(error("zone on a circle nan,0 9").find("no place"), std::string::npos);
  EXPECT_NE(error("zone on a circle 0,0 -1").find("radius"), std::string::npos);
  EXPECT_NE(error("zone on a circle 0,0 9 floor").find("no limit"), std::string::npos);
  EXPECT_NE(error("zone on a circle 0,0 9 floor 5 ceiling 4").find("floor"),
            std::string::npos);
  EXPECT_NE(error("zone on a circle 0,0 9 wall 5").find("no limit"), std::string::npos);
  EXPECT_NE(error("zone on a ring 0,0 1,1").find("fewer than 3"), std::string::npos);
  EXPECT_NE(error("zone on a ring 0,0 1,1 2").find("\"2\" is no place"),
            std::string::npos);
  EXPECT_NE(error("zone on a ring 0,0 10,10 10,0 0,10").find("crosses itself at 5.0"),
            std::string::npos);
  EXPECT_NE(error("zone on a ring 0,0 1e400,0 1,1").find("no place"), std::string::npos);
}

// Words of commands in any order and number are refused, or can be used.
TEST(ZoneCommand, TakesUpNothingThatCannotBeUsed) {
  constexpr std::array kWords = {"zone",  "on",  "off",   "a",    "circle",
                                 "ring",  "0,0", "9,0",   "9,9",  "0,9",
                                 "5",     "-5",  "nan",   "inf",  "floor",
                                 "until", ",",   "1e999", "from", "1e308,-1e308"};
  int taken = 0;
  for (std::uint32_t run = 0; run < 20000; ++run) {
    RandomStream random(1, run, Purpose::kTest);
    std::string line = run % 2 == 0 ? "zone on a " : "zone on a ring 0,0 9,0 9,9 ";
    const int count = static_cast<int>(random.uniform(0, 7));
    for (int k = 0; k < count; ++k)
      line += std::string(kWords[static_cast<std::size_t>(
                  random.uniform(0, static_cast<double>(kWords.size())))]) +
              " ";
    const auto change = parse_zone_command(line);
    if (!change) continue;
    const auto* ring = std::get_if<geo::Ring>(&change.value().zone.area);
    if (ring && ring->empty()) continue;
    ++taken;
    ASSERT_FALSE(error_in(change.value().zone)) << line;
  }
  EXPECT_GT(taken, 500);
}

}  // namespace
}  // namespace skein::zone_command_test
