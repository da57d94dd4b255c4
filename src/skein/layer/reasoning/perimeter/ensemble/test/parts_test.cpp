// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/ensemble/parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace skein::perimeter::parts_test {
namespace {

const model::Grid kGrid{Vec2(-400, -400), 10, 81, 81};

template <class Function>
std::vector<double> field(const Function& f) {
  std::vector<double> out;
  for (int r = 0; r < kGrid.rows; ++r)
    for (int c = 0; c < kGrid.columns; ++c) out.push_back(f(kGrid.node(r, c)));
  return out;
}

double disc(const Vec2& p, const Vec2& middle, double radius) {
  return (p - middle).norm() - radius;
}

// Signs after dropping what nobody has seen.
struct Checked {
  std::vector<double> mean;
  bool fire(const Vec2& p) const {
    const Vec2 at = (p - kGrid.low) / kGrid.cell;
    return mean[kGrid.index(static_cast<int>(std::lround(at.x())),
                            static_cast<int>(std::lround(at.y())))] < 0;
  }
};

Checked drop(std::vector<double> mean, const Evidence& evidence) {
  for (const std::size_t i : unseen_nodes(kGrid, evidence, mean)) mean[i] = -mean[i];
  return {std::move(mean)};
}

const Vec2 kWest(0, -200), kEast(0, 200);

std::vector<double> two_parts() {
  return field(
      [](const Vec2& p) { return std::min(disc(p, kWest, 120), disc(p, kEast, 120)); });
}

// As many places as a day of flights sees: those of a set, in its order, and copies that
// share them.
TEST(Evidence, HoldsEachPlaceOnceInOrderHoweverManyThereAre) {
  Evidence evidence;
  std::set<std::pair<int, int>> places;
  for (int k = 0; k < 30'000; ++k) {
    const int x = k * 7919 % 311, y = k * 131 % 173;
    evidence.add(Vec2(20 * x + 3, 20 * y + 17), true);
    places.insert({x, y});
  }
  EXPECT_EQ(evidence.size(true), places.size());
  EXPECT_TRUE(evidence.empty(false));
  const std::vector<Vec2> points = evidence.points(true);
  ASSERT_EQ(points.size(), places.size());
  std::size_t k = 0;
  for (const auto& [x, y] : places)
    EXPECT_EQ(points[k++], Vec2(20 * x + 10, 20 * y + 10));
  Evidence copy = evidence;
  copy.add(Vec2(-500, -500), true);
  EXPECT_EQ(copy.size(true), places.size() + 1);
  EXPECT_EQ(copy.points(true).front(), Vec2(-490, -490));
  EXPECT_EQ(evidence.size(true), places.size());
}

TEST(Parts, NothingIsDroppedBeforeFireHasBeenSeen) {
  EXPECT_TRUE(unseen_nodes(kGrid, {}, two_parts()).empty());
  Evidence outside;
  outside.add(Vec2(350, 0), false);
  EXPECT_TRUE(unseen_nodes(kGrid, outside, two_parts()).empty());
}

TEST(Parts, APartThatNobodyHasSeenGoes) {
  Evidence evidence;
  evidence.add(kWest + Vec2(100, 0), true);
  const Checked one = drop(two_parts(), evidence);
  EXPECT_TRUE(one.fire(kWest));
  EXPECT_FALSE(one.fire(kEast));
  evidence.add(kEast, true);
  const Checked both = drop(two_parts(), evidence);
  EXPECT_TRUE(both.fire(kWest));
  EXPECT_TRUE(both.fire(kEast));
}

TEST(Parts, ANeckJoinsNothingButAWideBridgeDoes) {
  const auto bridged = [](double half_width) {
    return field([half_width](const Vec2& p) {
      const double bridge = std::max(std::abs(p.x()) - half_width, std::abs(p.y()) - 200);
      return std::min({disc(p, kWest, 120), disc(p, kEast, 120), bridge});
    });
  };
  Evidence evidence;
  evidence.add(kWest + Vec2(100, 0), true);
  EXPECT_FALSE(drop(bridged(15), evidence).fire(kEast));
  EXPECT_TRUE(drop(bridged(60), evidence).fire(kEast));
}

TEST(Parts, AGlimpseDoesNotCostTheBody) {
  const auto body_and_glimpse = field([](const Vec2& p) {
    return std::min(disc(p, Vec2(-50, 0), 180), disc(p, Vec2(270, 0), 60));
  });
  Evidence evidence;
  evidence.add(Vec2(270, 0), true);
  EXPECT_TRUE(drop(body_and_glimpse, evidence).fire(Vec2(-50, 0)));
  EXPECT_TRUE(drop(body_and_glimpse, evidence).fire(Vec2(270, 0)));
}

TEST(Parts, ABodySeenOnlyAtItsRimStays) {
  // Members that disagree make the mean shallow: it is not half a neck deep anywhere near
  // the place where fire was seen first.
  const auto shallow =
      field([](const Vec2& p) { return 0.3 * disc(p, Vec2::Zero(), 250); });
  Evidence evidence;
  evidence.add(Vec2(240, 0), true);
  EXPECT_TRUE(drop(shallow, evidence).fire(Vec2::Zero()));
}

TEST(Parts, AHoleThatNobodyHasSeenIsFilled) {
  const auto ring = field([](const Vec2& p) {
    return std::max(disc(p, Vec2::Zero(), 250), -disc(p, Vec2::Zero(), 80));
  });
  Evidence evidence;
  evidence.add(Vec2(0, 160), true);
  EXPECT_TRUE(drop(ring, evidence).fire(Vec2::Zero()));
  evidence.add(Vec2(10, 10), false);
  EXPECT_FALSE(drop(ring, evidence).fire(Vec2::Zero()));
}

TEST(Parts, RemnantsOfAMemberGoAndItsOwnShapeStays) {
  const auto mean = field([](const Vec2& p) { return disc(p, Vec2::Zero(), 100); });
  // Bulges out of the mean, has a detached island and a hole that the mean has not.
  const auto shape = field([](const Vec2& p) {
    const double body = std::min(disc(p, Vec2::Zero(), 90), disc(p, Vec2(90, 0), 60));
    const double holed = std::max(body, -disc(p, Vec2(-20, 0), 25));
    return std::min(holed, disc(p, Vec2(0, 280), 50));
  });
  model::Field phi{kGrid, {shape.begin(), shape.end()}};
  drop_remnants(mean, phi);
  EXPECT_LT(model::sample(phi, Vec2(140, 0)), 0);
  EXPECT_GT(model::sample(phi, Vec2(0, 280)), 0);
  EXPECT_LT(model::sample(phi, Vec2(-20, 0)), 0);
}

}  // namespace
}  // namespace skein::perimeter::parts_test
