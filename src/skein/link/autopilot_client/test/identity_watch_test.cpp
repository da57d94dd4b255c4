// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/identity_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "skein/base/math.h"
#include "skein/base/random.h"

namespace skein::autopilot_client {
namespace {

Time at(double seconds) {
  return Time::from_seconds(seconds);
}

ReportedPlace place(std::int32_t latitude, std::int32_t longitude, Time boot,
                    double speed = 0) {
  return {latitude, longitude, speed, boot};
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
  EXPECT_FALSE(watch.take_place(place(0, 0, at(0)), at(0))) << "unknown";
  EXPECT_FALSE(watch.take_place(place(here, 0, at(1)), at(1)));
  EXPECT_FALSE(watch.take_place(place(there, 0, at(1.1)), at(1.1)));
  EXPECT_FALSE(watch.is_ambiguous(at(1.1))) << "once may be a receiver's fault";
  EXPECT_FALSE(watch.take_place(place(here, 0, at(1.2)), at(1.2)));
  EXPECT_TRUE(watch.take_place(place(there, 0, at(1.3)), at(1.3))) << "there and back";
  EXPECT_TRUE(watch.is_ambiguous(at(1.3)));
  EXPECT_FALSE(watch.take_place(place(here, 0, at(1.4)), at(1.4))) << "said";
  EXPECT_FALSE(watch.is_ambiguous(at(12)));
  watch.forget();
  EXPECT_FALSE(watch.take_place(place(there, 0, at(13)), at(13))) << "another session";
}

TEST(IdentityWatch, FlightAndDelaysAreNoJumps) {
  IdentityWatch watch;
  for (int k = 0; k < 100; ++k)  // 60 m/s, and now and then all of 20 s comes at once
    EXPECT_FALSE(watch.take_place(place(370'000'000 + 5400 * k, 0, at(k), 60),
                                  at(k / 20 * 20 + 0.001 * (k % 20))));
  for (int k = 0; k < 20; ++k)  // a receiver that finds its place again and again
    EXPECT_FALSE(watch.take_place(place(371'000'000 + 20'000 * (k % 2), 0, at(200 + k)),
                                  at(200 + k)));
  EXPECT_FALSE(watch.is_ambiguous(at(220)));
}

// Across the date line is not round the world.
TEST(IdentityWatch, TheDateLineIsNoJump) {
  IdentityWatch watch;
  EXPECT_FALSE(watch.take_place(place(100, 1'799'999'990, at(1)), at(1)));
  EXPECT_FALSE(watch.take_place(place(100, -1'799'999'990, at(1.1)), at(1.1)));
}

// What a line to one vehicle, or to two that speak with one number, brings here.
class Senders {
 public:
  explicit Senders(std::uint64_t seed) : random_(seed, 1, Purpose::kStudy) {}

  double between(double least, double greatest) {
    return least + (greatest - least) * random_.uniform();
  }

  // One on a curve, its clock ahead of the other's by `ahead`.
  struct Flight {
    double north, east, speed, turn, ahead, rate;
    double last = 0;
  };
  Flight flight(double spread) {
    return {between(-spread, spread), between(-spread, spread), between(0, 30),
            between(-0.2, 0.2),       between(-0.45, 0.45),     between(3, 10)};
  }

  // Where it is at a time, within a metre or two.
  ReportedPlace place_of(const Flight& flight, double t) {
    const double radius = flight.speed / std::max(std::abs(flight.turn), 0.02);
    const double angle = flight.speed / radius * t;
    const double north = flight.north + radius * math::sin(angle) + between(-1, 1);
    const double east = flight.east - radius * math::cos(angle) + between(-1, 1);
    constexpr double kPerMetre = 89.83;  // [1e-7 deg]
    return {static_cast<std::int32_t>(kPerMetre * north) + 1,
            static_cast<std::int32_t>(kPerMetre * east) + 1, flight.speed,
            at(std::round(1000 * (100 + t + flight.ahead)) / 1000)};
  }

 private:
  RandomStream random_;
};

// In 60 s of each: a delay that changes, losses, copies by a second route.
TEST(IdentityWatch, OneFlightOverABadLineIsOneTrack) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Senders s(seed);
    Senders::Flight flight = s.flight(200);
    const double delay = s.between(0, 1), jitter = s.between(0, 0.5);
    const double loss = s.between(0, 0.7), copies = s.between(0, 1);
    std::multimap<double, ReportedPlace> line;
    for (double t = 0; t < 60; t += 1 / flight.rate) {
      const ReportedPlace place = s.place_of(flight, t);
      if (s.between(0, 1) > loss) line.emplace(t + s.between(0, jitter), place);
      if (s.between(0, 1) < copies) line.emplace(t + delay + s.between(0, jitter), place);
    }
    IdentityWatch watch;
    for (const auto& [t, place] : line)
      ASSERT_FALSE(watch.take_place(place, at(t))) << "seed " << seed << " at " << t;
  }
}

// Two that are at the same count, with clocks less than a second apart.
TEST(IdentityWatch, TwoFlightsOver40MApartAreTwoTracks) {
  int found = 0, apart = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Senders s(seed);
    Senders::Flight a = s.flight(200), b = s.flight(200);
    b.speed = a.speed = s.between(0, 10);  // together, as two behind one radio
    b.turn = a.turn;
    const double distance = std::hypot(a.north - b.north, a.east - b.east);
    if (distance < 40) continue;
    ++apart;
    std::multimap<double, ReportedPlace> line;
    for (Senders::Flight* flight : {&a, &b})
      for (double t = s.between(0, 0.5); t < 30; t += 1 / flight->rate)
        line.emplace(t + s.between(0, 0.1), s.place_of(*flight, t));
    IdentityWatch watch;
    int said = 0;
    for (const auto& [t, place] : line)
      said += watch.take_place(place, at(t)).has_value();
    found += said > 0;
    EXPECT_LE(said, 3) << "seed " << seed;
  }
  EXPECT_GT(apart, 250);
  // Two with slow telemetry that is lost in turn may be missed for half a minute.
  EXPECT_GE(found, apart * 98 / 100);
}

TEST(IdentityWatch, BoardsAndTypesThatAlternateAreTwo) {
  IdentityWatch watch;
  for (int k = 0; k < 60; ++k) {  // one vehicle, then its successor
    EXPECT_FALSE(watch.take_hardware(k < 30 ? 11 : 12, at(10 * k)));
    EXPECT_FALSE(watch.take_hardware(0, at(10 * k))) << "says nothing";
    EXPECT_FALSE(
        watch.take_kind({k < 30 ? std::uint8_t{2} : std::uint8_t{13}, 3}, at(10 * k)));
  }
  int boards = 0, kinds = 0;
  for (int k = 0; k < 12; ++k) {
    boards += watch.take_hardware(k % 2 == 0 ? 21 : 22, at(1000 + 5 * k)).has_value();
    if (k >= 4) {
      EXPECT_TRUE(watch.is_ambiguous(at(1000 + 5 * k)));
    }
  }
  EXPECT_EQ(boards, 1);
  watch.forget();
  for (int k = 0; k < 12; ++k)
    kinds += watch
                 .take_kind({k % 2 == 0 ? std::uint8_t{2} : std::uint8_t{1}, 3},
                            at(2000 + 0.5 * k))
                 .has_value();
  EXPECT_EQ(kinds, 1);
}

TEST(IdentityWatch, ASecondLinkOfOneVehicleIsNoOther) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Senders s(seed);
    const Senders::Flight flight = s.flight(200);
    Senders::Flight other = s.flight(200);
    other.north += 9000;
    const double delay = s.between(0, 5);
    IdentityWatch watch;
    watch.take_kind({2, 3}, at(0));
    std::string same, another, later;
    for (double t = 10; t < 40; t += 0.5) {
      watch.take_place(s.place_of(flight, t), at(t));
      same += watch.difference(s.place_of(flight, t - delay), at(t + 0.1));
      same += watch.difference({.boot = at(100 + t - delay)}, at(t + 0.1));
    }
    for (double t = 40; t < 52; t += 0.5) {
      watch.take_place(s.place_of(flight, t), at(t));
      another += watch.difference(s.place_of(other, t), at(t + 0.1));
    }
    EXPECT_EQ(watch.difference(s.place_of(flight, 52), at(52)), "");
    for (double t = 52; t < 64; t += 0.5) {
      watch.take_place(s.place_of(flight, t), at(t));
      later += watch.difference({.boot = at(t + 20)}, at(t + 0.1));
      if (t < 61) {
        EXPECT_EQ(later, "") << "it may have rebooted";
      }
    }
    EXPECT_EQ(same, "") << "seed " << seed;
    EXPECT_NE(another, "") << "seed " << seed;
    EXPECT_NE(later, "") << "seed " << seed;
    EXPECT_EQ(watch.difference(ReportedKind{2, 3}), "");
    EXPECT_NE(watch.difference(ReportedKind{1, 3}), "");
  }
}

}  // namespace
}  // namespace skein::autopilot_client
