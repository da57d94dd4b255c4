// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/confidence/confidence_monitor.h"

#include <gtest/gtest.h>

#include <functional>

#include "skein/base/random.h"

namespace skein::perimeter::confidence_monitor_test {
namespace {

using Verdict = ConfidenceMonitor::Verdict;

BoundaryPoint point_at(const Vec2& position, const Vec2& normal, double sigma) {
  BoundaryPoint point;
  point.position = position;
  point.normal = normal;
  point.sigma = sigma;
  return point;
}

// A straight edge along the east axis, known to 10 m, that moves north with 2 m/s.
BoundaryEstimate edge() {
  BoundaryEstimate boundary;
  boundary.rings.emplace_back();
  for (int k = -20; k <= 20; ++k) {
    boundary.rings.back().push_back(point_at({0, 25.0 * k}, {1, 0}, 10));
    boundary.rings.back().back().rate = 2;
  }
  return boundary;
}

// A circle of 11 km, known to 1 m, in `count` points.
BoundaryEstimate circle(int count) {
  BoundaryEstimate boundary;
  boundary.rings.emplace_back();
  for (int k = 0; k < count; ++k) {
    const Vec2 normal = geo::unit(2 * geo::kPi * k / count);
    boundary.rings.back().push_back(point_at(11000 * normal, normal, 1));
  }
  return boundary;
}

// One aircraft that crosses in and out in turn, every `period` seconds, where
// `place(number)` says.
class Flight {
 public:
  explicit Flight(BoundaryEstimate boundary, double period = 10)
      : boundary_(std::move(boundary)), period_(period) {}

  // The verdicts that came with `count` crossings.
  std::vector<Verdict> fly(int count, const std::function<Vec2(int)>& place) {
    std::vector<Verdict> verdicts;
    for (int k = 0; k < count; ++k) {
      Crossing crossing;
      crossing.time = Time::from_seconds(time_ += period_);
      crossing.entered = entered_ = !entered_;
      crossing.point = place(k);
      crossing.track = {12, 16};
      boundary_.time = crossing.time - Time::from_seconds(lag_);
      if (const auto verdict = monitor_.take(crossing, boundary_))
        verdicts.push_back(*verdict);
    }
    return verdicts;
  }

  void set_lag(double lag) { lag_ = lag; }

 private:
  BoundaryEstimate boundary_;
  double period_;
  double time_ = 0;
  double lag_ = 0;
  bool entered_ = false;
  ConfidenceMonitor monitor_;
};

const std::vector<Verdict> kTrusted = {Verdict::kTrusted};
const std::vector<Verdict> kOverConfident = {Verdict::kOverConfident};

TEST(ConfidenceMonitor, AnHonestBeliefIsNeverOverConfident) {
  Flight flight(edge());
  flight.set_lag(4);  // the boundary was believed 4 s ago and has moved 8 m since
  RandomStream random(7, 1, Purpose::kTest);
  EXPECT_EQ(flight.fly(20000,
                       [&](int k) {
                         const double off =
                             10 * random.normal() + 12 * (random.uniform() - 0.5);
                         return Vec2(8 + off, 17.0 * (k % 29) - 240);
                       }),
            kTrusted);
}

TEST(ConfidenceMonitor, ABeliefThatClaimsTooMuchIsFoundOutAndTrustedAgainLater) {
  Flight flight(edge());
  RandomStream random(7, 2, Purpose::kTest);
  EXPECT_TRUE(flight.fly(20, [](int) { return Vec2(500, 0); }).empty()) << "too few";
  EXPECT_EQ(flight.fly(200, [&](int) { return Vec2(40 * random.normal(), 0); }),
            kOverConfident);
  EXPECT_EQ(flight.fly(200, [&](int) { return Vec2(10 * random.normal(), 0); }),
            kTrusted);
}

TEST(ConfidenceMonitor, KnowsThatTheBoundaryBendsBetweenItsPoints) {
  // 60 points are 1.15 km apart, 15 m from chord to arc; 8 points 8.4 km and 840 m.
  for (const int count : {60, 8}) {
    Flight flight(circle(count));
    EXPECT_EQ(flight.fly(100, [](int k) { return Vec2(11000 * geo::unit(0.0613 * k)); }),
              kTrusted)
        << count;
    EXPECT_EQ(flight.fly(100, [](int k) { return Vec2(11200 * geo::unit(0.0613 * k)); }),
              kOverConfident)
        << count;
  }
}

TEST(ConfidenceMonitor, BeyondACornerTheDistanceIsToTheCorner) {
  BoundaryEstimate square;
  const double r = std::sqrt(0.5);
  square.rings.push_back(
      {point_at({100, 100}, {r, r}, 5), point_at({-100, 100}, {-r, r}, 5),
       point_at({-100, -100}, {-r, -r}, 5), point_at({100, -100}, {r, -r}, 5)});
  Flight flight(square);
  EXPECT_EQ(flight.fly(30, [](int) { return Vec2(100, 400); }), kOverConfident);
}

TEST(ConfidenceMonitor, AFewSurprisesAreNoProof) {
  EXPECT_EQ(Flight(edge()).fly(400, [](int k) { return Vec2(k % 5 == 0 ? 2000 : 0, 0); }),
            kTrusted);
}

TEST(ConfidenceMonitor, WhatIsTakenBackAtOnceDoesNotCount) {
  EXPECT_TRUE(Flight(edge(), 1).fly(400, [](int) { return Vec2(2000, 0); }).empty());
}

TEST(ConfidenceMonitor, WithoutABelievedBoundaryThereIsNothingToJudge) {
  EXPECT_TRUE(
      Flight(BoundaryEstimate{}).fly(100, [](int) { return Vec2(900, 0); }).empty());
}

}  // namespace
}  // namespace skein::perimeter::confidence_monitor_test
