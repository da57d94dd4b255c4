// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/clock_alignment.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace skein::autopilot_client::clock_alignment_test {
namespace {

Time s(double seconds) {
  return Time::from_seconds(seconds);
}

// A vehicle whose clock began at 100 s of ours and runs fast by `drift`; messages take
// `delay` and up to `jitter` more.
struct Far {
  double delay = 0.05, jitter = 0.1, drift = 0;
  std::mt19937 random{3};
  double way() {
    return delay + jitter * std::uniform_real_distribution<double>()(random);
  }
  double boot(double ours) const { return (ours - 100) * (1 + drift); }
};

TEST(ClockAlignment, IsOffByTheFastestMessageWithoutRoundTrips) {
  Far far;
  ClockAlignment clock;
  for (double t = 110; t < 140; t += 0.1) {
    const Time now = s(t + far.way());
    clock.hear(s(far.boot(t)), now);
    const double here = clock.to_here(s(far.boot(t)), now).seconds();
    EXPECT_GE(here, t);              // never before it happened
    EXPECT_LE(here, now.seconds());  // nor in the future
  }
  // The fastest of 300 took its delay and hardly more.
  const double here = clock.to_here(s(far.boot(140)), s(140.2)).seconds();
  EXPECT_NEAR(here, 140.05, 0.005);
}

TEST(ClockAlignment, TakesHalfOfTheShortestRoundTrip) {
  Far far;
  ClockAlignment clock;
  for (double t = 110; t < 140; t += 1) {
    const double there = t + far.way(), back = there + far.way();
    clock.hear(s(far.boot(there)), s(back));
    clock.round_trip(s(t), s(far.boot(there)), s(back));
  }
  EXPECT_NEAR(clock.to_here(s(far.boot(140)), s(141)).seconds(), 140, 0.02);
  EXPECT_LT(clock.shortest_round_trip(), 0.15);
}

TEST(ClockAlignment, FollowsAClockThatRunsSlow) {
  Far far{0.02, 0.05, -50e-6};
  ClockAlignment clock;
  double t = 110;
  for (; t < 4000; t += 0.5) {
    const Time now = s(t + far.way());
    clock.hear(s(far.boot(t)), now);
  }
  // It has lost 0.2 s by now.
  EXPECT_NEAR(clock.to_here(s(far.boot(t)), s(t + 1)).seconds(), t + 0.02, 0.03);
}

TEST(ClockAlignment, IgnoresAnswersThatCannotBe) {
  ClockAlignment clock;
  clock.hear(s(5), s(10));
  clock.round_trip(s(12), s(5), s(10));       // sent in the future
  clock.round_trip(s(-40), s(5), s(10));      // another's question
  clock.round_trip(s(9.5), s(1.8e9), s(10));  // the time of day
  const Time first = Time::from_ns(std::numeric_limits<std::int64_t>::min());
  const Time last = Time::from_ns(std::numeric_limits<std::int64_t>::max());
  for (const Time any : {first, last}) {
    clock.round_trip(any, s(5), s(10));
    clock.round_trip(s(9.5), any, s(10));
    ClockAlignment without_messages;
    without_messages.round_trip(s(9.5), any, s(10));
    EXPECT_EQ(without_messages.shortest_round_trip(), 0);
  }
  EXPECT_EQ(clock.shortest_round_trip(), 0);
  EXPECT_EQ(clock.to_here(s(6), s(20)), s(11));
}

// The answer may come before anything that telemetry says, by whatever clock.
TEST(ClockAlignment, TakesNoTimeOfDayWhateverComesFirst) {
  using Answer = ClockAlignment::Answer;
  for (const double other : {1.8e9, 5000.0, -3.0}) {
    ClockAlignment clock;
    EXPECT_EQ(clock.round_trip(s(9.9), s(other + 9.95), s(10)), Answer::kTooEarly);
    clock.hear(s(5), s(10.1));
    for (double t = 11; t < 100; t += 1) {
      clock.hear(s(t - 5.1), s(t));
      EXPECT_EQ(clock.round_trip(s(t - 0.1), s(other + t - 0.05), s(t)),
                Answer::kOtherClock);
      EXPECT_NEAR(clock.to_here(s(t - 5.1), s(t)).seconds(), t, 0.01);
    }
  }
}

// A radio that holds messages back for a second and a half: answers are of the same
// clock.
TEST(ClockAlignment, TakesAnswersOfSlowRadios) {
  ClockAlignment clock;
  for (double t = 10; t < 60; t += 1) {
    clock.hear(s(t), s(t + 1.5));
    EXPECT_EQ(clock.round_trip(s(t - 1.5), s(t), s(t + 1.5)),
              ClockAlignment::Answer::kTaken);
  }
  EXPECT_NEAR(clock.to_here(s(61), s(62.5)).seconds(), 61, 0.01);
}

// A simulator that gets too little of its processor.
TEST(ClockAlignment, FollowsAClockThatLosesTime) {
  ClockAlignment clock;
  for (double t = 10; t < 200; t += 0.1) {
    const double there = 0.7 * t;
    EXPECT_EQ(clock.hear(s(there), s(t)), Time());
    EXPECT_EQ(clock.round_trip(s(t - 0.02), s(there - 0.007), s(t)),
              ClockAlignment::Answer::kTaken);
    EXPECT_GT(clock.to_here(s(there), s(t)).seconds(), t - 1.2);
  }
}

TEST(ClockAlignment, FollowsAClockThatIsSet) {
  ClockAlignment clock;
  for (double t = 10; t < 40; t += 0.1) {
    EXPECT_EQ(clock.hear(s(t), s(t)), Time());
    clock.round_trip(s(t - 0.02), s(t - 0.01), s(t));
  }
  // Ahead: at once, and it is said by how much.
  EXPECT_NEAR(clock.hear(s(1040), s(40)).seconds(), 1000, 0.1);
  EXPECT_NEAR(clock.to_here(s(1040), s(40)).seconds(), 40, 0.1);
  // Back by less than a reboot would be: within a minute.
  for (double t = 40; t < 110; t += 0.1) {
    clock.hear(s(t + 999.2), s(t));
    clock.round_trip(s(t - 0.02), s(t + 999.19), s(t));
  }
  EXPECT_NEAR(clock.to_here(s(110 + 999.2), s(110)).seconds(), 110, 0.05);
}

}  // namespace
}  // namespace skein::autopilot_client::clock_alignment_test
