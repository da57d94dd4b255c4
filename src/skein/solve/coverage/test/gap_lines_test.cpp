// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/gap_lines.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/geo/clip.h"

namespace skein::solve::gap_lines_test {
namespace {

geo::Ring square(double half) {
  return {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
}

TEST(ZoneRoom, LinesEndWhereATurnStillAvoidsAWall) {
  // A wall along x = 0. A turn from a line that meets it at an angle touches it when it
  // begins radius tan(angle / 2) before.
  const ZoneRings wall({{{0, -9000}, {500, -9000}, {500, 9000}, {0, 9000}}});
  for (const double angle : {0.3, 0.9, geo::kPi / 2}) {
    const Vec2 along(std::sin(angle), std::cos(angle));
    const auto lines = clear_of({{-800 * along, 200 * along}}, wall, {0, 50});
    ASSERT_EQ(lines.size(), 1) << angle;
    // Arcs are taken for up to 2 % larger.
    const double min = 50 * std::tan(angle / 2);
    EXPECT_GE(lines[0].b.norm(), min - 1e-9) << angle;
    EXPECT_LE(lines[0].b.norm(), min + 1 / std::sin(angle) + 0.1) << angle;
    EXPECT_NEAR((lines[0].a + 800 * along).norm(), 0, 1e-9) << angle;
  }
}

TEST(ZoneRoom, LinesBesideAWallKeepTheirEnds) {
  const ZoneRings wall({{{0, -900}, {500, -900}, {500, 900}, {0, 900}}});
  const auto lines = clear_of({{{-1, -700}, {-1, 700}}}, wall, {0.5, 50});
  ASSERT_EQ(lines.size(), 1);
  EXPECT_NEAR((lines[0].b - lines[0].a).norm(), 1400, 1e-9);
  EXPECT_TRUE(clear_of({{{-1, -700}, {-1, 700}}}, wall, {2, 50}).empty());
}

TEST(ZoneRoom, NothingIsLeftWhereThereIsNoRoom) {
  // Two walls closer than a turn: a line into the lane between them has no exit.
  const ZoneRings lane(std::vector<geo::Ring>{
      {{0, -500}, {500, -500}, {500, -10}, {0, -10}},
      {{0, 10}, {500, 10}, {500, 500}, {0, 500}},
      {{480, -10}, {520, -10}, {520, 10}, {480, 10}},
  });
  EXPECT_TRUE(clear_of({{{100, 0}, {470, 0}}}, lane, {1, 50}).empty());
}

TEST(GapLines, SeeWhatLinesLeaveBeforeAZone) {
  const ZoneRings zones({square(150)});
  const geo::Region area = geo::subtract({square(600)}, zones.rings());
  const ZoneRoom room{0.01, 60};
  const auto lines = clear_of(sweep_lines(area, 0, 80, CellRule::kSplit, 0), zones, room);
  const double seen = geo::shared_area(area, beside(lines, 40), geo::FillRule::kNonZero);
  EXPECT_LT(seen, geo::area(area) - 2 * 50 * 280);
  const auto [more, unseen] = gap_lines({area, zones, 80, 0, 190, 0, room, {}}, lines);
  EXPECT_LT(unseen, 0.1);
  // Two borders face the lines; what is left there is as deep as a turn.
  EXPECT_EQ(more.size(), 2);
  auto all = lines;
  all.insert(all.end(), more.begin(), more.end());
  EXPECT_NEAR(geo::shared_area(area, beside(all, 40), geo::FillRule::kNonZero),
              geo::area(area), 1);
  EXPECT_EQ(clear_of(more, zones, room).size(), more.size());
  for (const SweepLine& line : more) EXPECT_GT(line.cell, lines.back().cell);
}

TEST(GapLines, SeeIntoACornerFromAcross) {
  // The angle of an L: lines along its sides end a turn before the other side, one across
  // ends nearer.
  const ZoneRings zones(
      {{{-300, -300}, {300, -300}, {300, -200}, {-200, -200}, {-200, 300}, {-300, 300}}});
  const geo::Region area = geo::subtract({square(600)}, zones.rings());
  const ZoneRoom room{0.01, 30};
  const auto lines = clear_of(sweep_lines(area, 0, 80, CellRule::kSplit, 0), zones, room);
  const auto [more, unseen] = gap_lines({area, zones, 80, 0, 95, 0, room, {}}, lines);
  EXPECT_LT(unseen, 0.1);
  auto all = lines;
  all.insert(all.end(), more.begin(), more.end());
  EXPECT_NEAR(geo::shared_area(area, beside(all, 40), geo::FillRule::kNonZero),
              geo::area(area), 1);
}

TEST(GapLines, OvershootAndStopAsAskedFor) {
  const ZoneRings zones({square(150)});
  const geo::Region area = geo::subtract({square(600)}, zones.rings());
  const ZoneRoom room{0.01, 60};
  const auto lines = clear_of(sweep_lines(area, 0, 80, CellRule::kSplit, 0), zones, room);
  const auto longest = [&](double overshoot) {
    double max = 0;
    for (const SweepLine& line :
         gap_lines({area, zones, 80, 0, 190, overshoot, room, {}}, lines).lines)
      max = std::max(max, (line.b - line.a).norm());
    return max;
  };
  EXPECT_NEAR(longest(50), longest(0) + 100, 1e-6);
  const GapLines stopped =
      gap_lines({area, zones, 80, 0, 190, 0, room, [] { return true; }}, lines);
  EXPECT_TRUE(stopped.lines.empty());
  EXPECT_GT(stopped.unseen, 2 * 50 * 280);
}

TEST(GapLines, NoneWhereNothingIsLeft) {
  const ZoneRings zones({square(150)});
  const geo::Region area = {{{200, -600}, {600, -600}, {600, 600}, {200, 600}}};
  const ZoneRoom room{0.01, 60};
  const auto lines =
      clear_of(sweep_lines(area, geo::kPi / 2, 80, CellRule::kSplit, 0), zones, room);
  EXPECT_TRUE(
      gap_lines({area, zones, 80, geo::kPi / 2, 190, 0, room, {}}, lines).lines.empty());
  const ZoneRings none;
  EXPECT_TRUE(
      gap_lines({area, none, 80, geo::kPi / 2, 190, 0, room, {}}, {}).lines.empty());
}

}  // namespace
}  // namespace skein::solve::gap_lines_test
