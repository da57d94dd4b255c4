// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/identity_watch.h"

#include <gtest/gtest.h>

#include "skein/base/random.h"

namespace skein::autopilot_client {
namespace {

Time at(double seconds) {
  return Time::from_seconds(seconds);
}

// One sender over a line that loses, repeats and reorders its frames, for an hour.
TEST(IdentityWatch, ABadLineIsOneSender) {
  for (const double loss : {0.0, 0.3, 0.7}) {
    IdentityWatch watch;
    RandomStream random(1, 2, Purpose::kStudy);
    std::uint8_t sequence = 0, late = 0;
    for (int k = 0; k < 3600 * 40; ++k) {
      const Time now = at(k / 40.0);
      ++sequence;
      if (random.uniform() < 0.01) late = sequence;  // comes a second time, or too late
      if (random.uniform() < loss) continue;
      ASSERT_FALSE(watch.take_sequence(sequence, now)) << loss << " at " << k;
      const bool is_late = random.uniform() < 0.02;
      ASSERT_FALSE(is_late && watch.take_sequence(late, now)) << loss << " at " << k;
    }
    EXPECT_FALSE(watch.is_ambiguous(at(3600)));
  }
}

TEST(IdentityWatch, ASenderThatStartsItsCountAgainIsOneSender) {
  IdentityWatch watch;
  for (int k = 0; k < 2000; ++k)  // it reboots each second
    EXPECT_FALSE(watch.take_sequence(static_cast<std::uint8_t>(k % 40), at(k / 40.0)));
}

// Whatever the two counts and rates are, it is known within some seconds, and said once.
TEST(IdentityWatch, TwoCountsSideBySideAreTwoSenders) {
  for (const int first : {0, 30, 100, 128, 200, 250})
    for (const double rate : {1.0, 7.0, 40.0}) {
      const bool is_behind = first < 64 || first > 256 - 64;
      if (is_behind && rate == 40) continue;  // looks like frames that are overtaken
      IdentityWatch watch;
      int said = 0, one = 0, other = first;
      double due = 0;
      for (int k = 0; k < 40 * 120; ++k) {
        const double now = k / 40.0;
        said +=
            watch.take_sequence(static_cast<std::uint8_t>(one++), at(now)).has_value();
        if (now < due) continue;
        due = now + 1 / rate;
        said +=
            watch.take_sequence(static_cast<std::uint8_t>(other++), at(now)).has_value();
      }
      EXPECT_GE(said, 1) << first << " at " << rate << " Hz";
      EXPECT_LE(said, 12) << first << " at " << rate << " Hz";
    }
}

TEST(IdentityWatch, APositionThatJumpsThereAndBackIsTwo) {
  IdentityWatch watch;
  const std::int32_t here = 370'000'000, there = 370'100'000;  // 1113 m
  EXPECT_FALSE(watch.take_position(0, 0, at(0), at(0))) << "unknown";
  EXPECT_FALSE(watch.take_position(here, 0, at(1), at(1)));
  EXPECT_FALSE(watch.take_position(there, 0, at(1.1), at(1.1)));
  EXPECT_FALSE(watch.is_ambiguous(at(1.1))) << "once may be a receiver's fault";
  EXPECT_FALSE(watch.take_position(here, 0, at(1.2), at(1.2)));
  EXPECT_TRUE(watch.take_position(there, 0, at(1.3), at(1.3))) << "there and back";
  EXPECT_TRUE(watch.is_ambiguous(at(1.3)));
  EXPECT_FALSE(watch.take_position(here, 0, at(1.4), at(1.4))) << "said";
  EXPECT_FALSE(watch.is_ambiguous(at(12)));
  watch.forget();
  EXPECT_FALSE(watch.take_position(there, 0, at(13), at(13))) << "another session";
}

TEST(IdentityWatch, FlightAndDelaysAreNoJumps) {
  IdentityWatch watch;
  for (int k = 0; k < 100; ++k)  // 60 m/s, and now and then all of 20 s comes at once
    EXPECT_FALSE(watch.take_position(370'000'000 + 5400 * k, 0, at(k),
                                     at(k / 20 * 20 + 0.001 * (k % 20))));
  for (int k = 0; k < 20; ++k)  // a receiver that finds its place again and again
    EXPECT_FALSE(
        watch.take_position(371'000'000 + 20'000 * (k % 2), 0, at(200 + k), at(200 + k)));
  EXPECT_FALSE(watch.is_ambiguous(at(220)));
}

// Across the date line is not round the world.
TEST(IdentityWatch, TheDateLineIsNoJump) {
  IdentityWatch watch;
  EXPECT_FALSE(watch.take_position(100, 1'799'999'990, at(1), at(1)));
  EXPECT_FALSE(watch.take_position(100, -1'799'999'990, at(1.1), at(1.1)));
}

}  // namespace
}  // namespace skein::autopilot_client
