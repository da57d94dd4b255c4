#include "layer/reasoning/monitoring/coordinator/confidence_monitor.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace skein::monitoring {
namespace {

using Verdict = ConfidenceMonitor::Verdict;

// A straight edge along the east axis that moves north with 2 m/s, known to 10 m at time
// 0.
BoundaryEstimate edge() {
  BoundaryEstimate boundary;
  boundary.rings.emplace_back();
  for (int k = -20; k <= 20; ++k) {
    BoundaryPoint point;
    point.position = {0, 25.0 * k};
    point.normal = {1, 0};
    point.sigma = 10;
    point.rate = 2;
    boundary.rings.back().push_back(point);
  }
  return boundary;
}

Crossing crossing_at(double north, double east, double t = 0) {
  Crossing crossing;
  crossing.time = Time::from_seconds(t);
  crossing.point = {north, east};
  crossing.track = {12, 16};
  return crossing;
}

TEST(ConfidenceMonitor, AnHonestBeliefIsNeverDoubted) {
  ConfidenceMonitor monitor;
  RandomStream random(7, 1, Purpose::kTest);
  for (int k = 0; k < 20000; ++k) {
    const double t = 0.5 * (k % 20);
    const double off = 10 * random.normal() + 12 * (random.uniform() - 0.5);
    EXPECT_FALSE(
        monitor.take(crossing_at(2 * t + off, 17.0 * (k % 29) - 240, t), edge()));
  }
}

TEST(ConfidenceMonitor, ABeliefThatClaimsTooMuchIsFoundOutAndTrustedAgainLater) {
  ConfidenceMonitor monitor;
  RandomStream random(7, 2, Purpose::kTest);
  std::vector<Verdict> verdicts;
  const auto feed = [&](int count, double sd) {
    for (int k = 0; k < count; ++k)
      if (const auto verdict = monitor.take(crossing_at(sd * random.normal(), 0), edge()))
        verdicts.push_back(*verdict);
  };
  feed(200, 40);
  EXPECT_EQ(verdicts, std::vector{Verdict::kOverConfident});
  feed(200, 10);
  EXPECT_EQ(verdicts, (std::vector{Verdict::kOverConfident, Verdict::kTrustedAgain}));
}

TEST(ConfidenceMonitor, KnowsThatTheBoundaryBendsBetweenItsPoints) {
  // 60 points of a circle of 11 km: 1.15 km apart, 15 m from chord to arc; known to 1 m.
  BoundaryEstimate boundary;
  boundary.rings.emplace_back();
  for (int k = 0; k < 60; ++k) {
    BoundaryPoint point;
    point.normal = geo::unit(2 * geo::kPi * k / 60);
    point.position = 11000 * point.normal;
    point.sigma = 1;
    boundary.rings.back().push_back(point);
  }
  ConfidenceMonitor monitor;
  for (int k = 0; k < 100; ++k) {
    const Vec2 point = 11000 * geo::unit(0.0613 * k);
    EXPECT_FALSE(monitor.take(crossing_at(point.x(), point.y()), boundary));
  }
  EXPECT_EQ(monitor.share_outside(), 0);
}

TEST(ConfidenceMonitor, AFewSurprisesAreNoProof) {
  ConfidenceMonitor monitor;
  for (int k = 0; k < 400; ++k)
    EXPECT_FALSE(monitor.take(crossing_at(k % 5 == 0 ? 2000 : 0, 0), edge()));
}

TEST(ConfidenceMonitor, WithoutABelievedBoundaryThereIsNothingToJudge) {
  ConfidenceMonitor monitor;
  for (int k = 0; k < 100; ++k)
    EXPECT_FALSE(monitor.take(crossing_at(900, 0), BoundaryEstimate{}));
}

}  // namespace
}  // namespace skein::monitoring
