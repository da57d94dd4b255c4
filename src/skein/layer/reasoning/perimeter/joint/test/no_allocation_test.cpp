// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "skein/base/test/allocations.h"
#include "skein/geo/vec.h"
#include "skein/layer/reasoning/perimeter/joint/joint_estimator.h"

namespace skein::perimeter::no_allocation_test {
namespace {

TEST(JointEstimator, LearnsWithoutAllocating) {
  JointEstimator estimator(PerimeterPrior{}, JointOptions{});
  const auto hour = [&estimator](int from, int to) {
    for (int second = from; second < to; ++second) {
      const Time now = Time::from_seconds(second);
      estimator.predict(now);
      for (std::uint32_t id = 0; id < 2; ++id) {
        const double bearing = 0.03 * second + 3 * id;
        const double radius = 500 + 3 * second;
        if (second % 5 == 0) {
          estimator.observe(Crossing{now,
                                     {id},
                                     radius * geo::unit(bearing),
                                     -20 * geo::unit(bearing + 0.6),
                                     1,
                                     second % 10 == 0});
        } else {
          estimator.observe(
              FireReading{now, {id}, (radius + 5) * geo::unit(bearing), 1, false});
        }
      }
    }
  };
  hour(1, 10);
  const auto before = allocations();
  if (!before) GTEST_SKIP() << "the sanitizer's own malloc prevents it";
  hour(10, 100);
  EXPECT_EQ(allocations(), before);
  const auto copy = estimator.clone();
  EXPECT_GT(allocations(), before);  // the counter works
}

}  // namespace
}  // namespace skein::perimeter::no_allocation_test
