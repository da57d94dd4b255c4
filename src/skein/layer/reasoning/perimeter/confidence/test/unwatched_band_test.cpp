// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/confidence/unwatched_band.h"

#include <gtest/gtest.h>

#include <functional>

#include "skein/base/random.h"

namespace skein::perimeter::unwatched_band_test {
namespace {

constexpr double kLength = 60000;  // of the edge [m]

// A straight edge along the east axis, known to 10 m.
BoundaryEstimate edge(double time) {
  BoundaryEstimate boundary;
  boundary.time = Time::from_seconds(time);
  boundary.rings.emplace_back();
  for (double east = 0; east <= kLength; east += 100) {
    BoundaryPoint point;
    point.position = {0, east};
    point.normal = {1, 0};
    point.sigma = 10;
    point.sigma_growth = 0.01;
    boundary.rings.back().push_back(point);
  }
  return boundary;
}

// One aircraft that follows the edge at 15 m/s, up and down, and crosses it every 10 s,
// so far from where it is believed as `off` says.
UnwatchedBand followed(double seconds, double length,
                       const std::function<double()>& off) {
  UnwatchedBand band;
  for (double time = 10; time < seconds; time += 10) {
    if (band.due(Time::from_seconds(time))) band.keep(edge(time));
    Crossing crossing;
    crossing.time = Time::from_seconds(time);
    crossing.point = {off(), std::abs(std::remainder(15 * time, 2 * length))};
    band.see(crossing);
  }
  return band;
}

TEST(UnwatchedBand, AnHonestBeliefIsLeftAlone) {
  RandomStream random(3, 1, Purpose::kTest);
  const UnwatchedBand band =
      followed(20000, kLength, [&] { return 10 * random.normal(); });
  // Twice the standard deviation of the expectile of squared normal numbers.
  EXPECT_LT(band.factor(), 1.3);
}

TEST(UnwatchedBand, WhatNobodySeesWidensByHowWrongItTurnedOutToBe) {
  RandomStream random(3, 2, Purpose::kTest);
  const UnwatchedBand band =
      followed(3600, kLength, [&] { return 40 * random.normal(); });
  EXPECT_GT(band.factor(), 2.5);
  EXPECT_LT(band.factor(), 5);
  BoundaryEstimate boundary = edge(3600);
  band.widen(boundary);
  const auto& ring = boundary.rings[0];
  // The aircraft is 53.9 km up the edge, the last 300 s of its flight behind it.
  EXPECT_EQ(ring[530].sigma, 10);
  EXPECT_EQ(ring[500].sigma, 10);
  EXPECT_DOUBLE_EQ(ring[400].sigma, 10 * band.factor());
  EXPECT_DOUBLE_EQ(ring[400].sigma_growth, 0.01 * band.factor());
  EXPECT_DOUBLE_EQ(ring[599].sigma, 10 * band.factor());
}

TEST(UnwatchedBand, WhatIsSeenAllTheTimeSaysNothingOfTheRest) {
  RandomStream random(3, 3, Purpose::kTest);
  // 1.5 km of edge, every part of it seen every 200 s at least.
  EXPECT_EQ(followed(3600, 1500, [&] { return 40 * random.normal(); }).factor(), 1);
}

TEST(UnwatchedBand, WithoutABelievedBoundaryThereIsNothingToJudge) {
  UnwatchedBand band;
  for (double time = 10; time < 2000; time += 10) {
    if (band.due(Time::from_seconds(time))) band.keep({Time::from_seconds(time), {}});
    band.see({Time::from_seconds(time), {1}, {0, 15 * time}, {20, 0}, 1, true});
  }
  EXPECT_EQ(band.factor(), 1);
}

}  // namespace
}  // namespace skein::perimeter::unwatched_band_test
