// Counts calls of malloc. The sanitizers bring their own, so the test stands aside there.

#include <gtest/gtest.h>

#include <cstdlib>

#include "geo/vec.h"
#include "layer/reasoning/monitoring/joint/joint_estimator.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SKEIN_COUNTS_MALLOC 0
#else
#define SKEIN_COUNTS_MALLOC 1
#endif

#if SKEIN_COUNTS_MALLOC
namespace {
long allocations = 0;
}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier, readability-identifier-naming)
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
// NOLINTEND(bugprone-reserved-identifier, readability-identifier-naming)
#endif

namespace skein::monitoring {
namespace {

TEST(JointEstimator, LearnsWithoutAllocating) {
#if SKEIN_COUNTS_MALLOC
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
  const long before = allocations;
  hour(10, 100);
  EXPECT_EQ(allocations, before);
  const auto copy = estimator.clone();
  EXPECT_GT(allocations, before);  // the counter works
#else
  GTEST_SKIP() << "the sanitizer's own malloc is in the way";
#endif
}

}  // namespace
}  // namespace skein::monitoring
