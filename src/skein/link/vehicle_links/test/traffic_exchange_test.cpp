// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_links/traffic_exchange.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "skein/base/random.h"
#include "skein/link/mavlink/payload.h"

namespace skein::vehicle_links::traffic_exchange_test {
namespace {

geo::LocalFrame frame() {
  return geo::LocalFrame::at({47.0, 8.0, 0}).value();
}

Time s(double seconds) {
  return Time::from_seconds(seconds);
}

TrafficState at(double north, double east) {
  TrafficState state;
  state.p_N = {north, east, -100};
  return state;
}

// Keeps who was told of whom.
struct Sky {
  explicit Sky(double max_range = 5000)
      : exchange(frame(), max_range, [this](auto receiver, const auto& message) {
          told.emplace_back(receiver, message.ICAO_address);
          last = message;
        }) {}
  void say(TrafficExchange::Id who, const TrafficState& state, double now) {
    exchange.moved(who, state, s(now));
  }
  std::size_t count(TrafficExchange::Id receiver, TrafficExchange::Id who) const {
    return static_cast<std::size_t>(
        std::count(told.begin(), told.end(),
                   std::pair{receiver, exchange.identity(who).icao_address}));
  }

  TrafficExchange exchange;
  std::vector<std::pair<TrafficExchange::Id, std::uint32_t>> told;
  mavlink::AdsbVehicle last;
};

TEST(ReceiverGrid, FindsAllThatAreNearAsALookAtAllDoes) {
  RandomStream random(2018, 0, Purpose::kTest);
  for (const double side : {1.0, 70.0, 5000.0}) {
    ReceiverGrid grid(side);
    std::map<std::uint32_t, Vec2> all;
    for (int round = 0; round < 2000; ++round) {
      const auto who = static_cast<std::uint32_t>(random.uniform(0, 100));
      const Vec2 place{random.uniform(-500, 500), random.uniform(-500, 500)};
      if (random.uniform() < 0.1) {
        grid.remove(who);
        all.erase(who);
      } else {
        grid.put(who, place);
        all[who] = place;
      }
      const Vec2 around{random.uniform(-500, 500), random.uniform(-500, 500)};
      std::multiset<std::uint32_t> found, expected;
      grid.visit_near(around, [&](std::uint32_t each) {
        ASSERT_TRUE(all.contains(each));
        if ((all[each] - around).norm() <= side) found.insert(each);
      });
      for (const auto& [each, p] : all)
        if ((p - around).norm() <= side) expected.insert(each);
      ASSERT_EQ(found, expected);
    }
  }
}

TEST(ReceiverGrid, PlacesFarBeyondTheEarthAreNoTrouble) {
  ReceiverGrid grid(1);
  grid.put(0, {1e300, -1e300});
  grid.put(1, {0, 0});
  int found = 0;
  grid.visit_near({1e300, -1e300}, [&](std::uint32_t who) { found += who == 0 ? 1 : 9; });
  EXPECT_EQ(found, 1);
}

TEST(TrafficExchange, TellsOthersInRangeAtOnceAndNobodyOfItself) {
  Sky sky;
  for (const char* name : {"a", "b", "c"})
    sky.exchange.add(name, false, TrafficOptions{});
  const auto simulated = sky.exchange.add("d", true, {});
  sky.say(0, at(0, 0), 1);
  sky.say(1, at(1000, 0), 1);
  sky.say(2, at(9000, 0), 1);
  EXPECT_EQ(sky.told.size(), 1u);
  EXPECT_EQ(sky.count(0, 1), 1u);
  sky.say(0, at(0, 0), 1.1);
  EXPECT_EQ(sky.count(1, 0), 1u);
  EXPECT_EQ(sky.count(2, 0), 0u);
  sky.say(simulated, at(5500, 0), 1.2);
  EXPECT_EQ(sky.count(1, 3), 1u);
  EXPECT_EQ(sky.count(2, 3), 1u);
  EXPECT_EQ(sky.count(0, 3), 0u);
  for (TrafficExchange::Id k = 0; k < 3; ++k) EXPECT_EQ(sky.count(k, k), 0u);
}

TEST(TrafficExchange, WhoSharesAConnectionIsNotShownThere) {
  Sky sky;
  for (const char* name : {"a", "b", "c"})
    sky.exchange.add(name, false, TrafficOptions{});
  const auto on = [](std::uint32_t line, double north) {
    TrafficState state = at(north, 0);
    state.line = line;
    return state;
  };
  for (const double now : {1.0, 2.0}) {
    sky.say(0, on(7, 0), now);
    sky.say(1, on(7, 100), now);
    sky.say(2, on(8, 200), now);
  }
  EXPECT_EQ(sky.count(0, 1) + sky.count(1, 0), 0u);
  EXPECT_GT(sky.count(0, 2), 0u);
  EXPECT_GT(sky.count(2, 0), 0u);
  EXPECT_GT(sky.count(2, 1), 0u);
}

TEST(TrafficExchange, KeepsTheRateOfEachPairWhateverTheJitter) {
  RandomStream random(2018, 0, Purpose::kTest);
  Sky sky;
  sky.exchange.add("a", false, TrafficOptions{.rate = 2});
  sky.exchange.add("b", true, {});
  sky.exchange.add("c", true, {});
  std::size_t said = 0;
  for (double t = 1; t < 101; t += 0.1) {
    sky.say(0, at(0, 0), t);
    sky.say(1, at(10, 0), t + random.uniform(0, 0.05));
    sky.say(2, at(20, 0), t + random.uniform(0, 0.05));
    said += 2;
  }
  for (const TrafficExchange::Id who : {1u, 2u}) {
    EXPECT_LE(sky.count(0, who), 201u);
    EXPECT_GE(sky.count(0, who), 195u);
  }
  const auto& counts = sky.exchange.counts(0);
  EXPECT_EQ(counts.sent, sky.told.size());
  EXPECT_EQ(counts.sent + counts.limited, said);
}

// All in a square of 8 km, with ranges from 1 to 5 km and up to 7 of them at once.
TEST(TrafficExchange, TellsOfTheNearestInRangeAsALookAtAllDoes) {
  RandomStream random(2018, 1, Purpose::kTest);
  for (int round = 0; round < 20; ++round) {
    Sky sky;
    constexpr TrafficExchange::Id kCount = 60;
    std::vector<Vec2> places;
    std::vector<TrafficOptions> options;
    for (TrafficExchange::Id k = 0; k < kCount; ++k) {
      places.emplace_back(random.uniform(0, 8000), random.uniform(0, 8000));
      options.push_back({random.uniform(1000, 5000), 10,
                         static_cast<std::size_t>(random.uniform(1, 8))});
      sky.exchange.add("v" + std::to_string(k), false, options.back());
    }
    // They come from elsewhere: what was nearest before has to go.
    for (int turn = 0; turn < 6; ++turn)
      for (TrafficExchange::Id k = 0; k < kCount; ++k) {
        const Vec2 place =
            turn < 2 ? Vec2(random.uniform(0, 8000), random.uniform(0, 8000)) : places[k];
        if (turn == 5 && k == 0) sky.told.clear();
        sky.say(k, at(place.x(), place.y()), 1 + turn + 0.001 * k);
      }
    for (TrafficExchange::Id k = 0; k < kCount; ++k) {
      std::vector<std::pair<double, std::uint32_t>> near;
      for (TrafficExchange::Id other = 0; other < kCount; ++other) {
        const double d = (places[other] - places[k]).norm();
        if (other != k && d <= options[k].range)
          near.emplace_back(d, sky.exchange.identity(other).icao_address);
      }
      std::sort(near.begin(), near.end());
      near.resize(std::min(near.size(), options[k].max));
      std::multiset<std::uint32_t> expected, told;
      for (const auto& each : near) expected.insert(each.second);
      for (const auto& [receiver, who] : sky.told)
        if (receiver == k) told.insert(who);
      EXPECT_EQ(told, expected) << "receiver " << k;
    }
  }
}

TEST(TrafficExchange, SilentAndLostOnesReceiveNothingAndMakeRoom) {
  Sky sky;
  sky.exchange.add("a", false, TrafficOptions{.max = 1});
  sky.exchange.add("near", true, {});
  sky.exchange.add("far", true, {});
  for (double t = 1; t < 5; t += 1) {
    sky.say(0, at(0, 0), t);
    sky.say(1, at(10, 0), t);
    sky.say(2, at(20, 0), t);
  }
  EXPECT_EQ(sky.count(0, 2), 0u);
  for (double t = 5; t < 20; t += 1) {
    sky.say(0, at(0, 0), t);
    sky.say(2, at(20, 0), t);  // the other is silent from now on
  }
  EXPECT_GT(sky.count(0, 2), 0u);
  sky.told.clear();
  sky.exchange.lost(0);
  sky.say(2, at(20, 0), 21);
  EXPECT_TRUE(sky.told.empty());
  sky.say(0, at(0, 0), 22);
  sky.say(2, at(20, 0), 22);
  EXPECT_EQ(sky.told.size(), 1u);
  sky.say(2, at(20, 0), 40);  // the receiver has said nothing for long
  EXPECT_EQ(sky.told.size(), 1u);
}

TEST(TrafficExchange, PassesOverPlacesThatAreNone) {
  Sky sky;
  sky.exchange.add("a", false, TrafficOptions{});
  sky.exchange.add("b", true, {});
  sky.say(0, at(0, 0), 1);
  sky.say(1, at(std::numeric_limits<double>::quiet_NaN(), 0), 1);
  EXPECT_TRUE(sky.told.empty());
}

TEST(TrafficMessage, SaysWhatIsKnown) {
  Sky sky;
  sky.exchange.add("a", false, TrafficOptions{});
  sky.exchange.add("observer-12", true, {});
  sky.say(0, at(0, 0), 1);
  TrafficState state = at(300, -400);
  state.time = s(1.5);
  state.v_N = {0, -20, 3};
  sky.say(1, state, 4);
  const mavlink::AdsbVehicle& m = sky.last;
  const Vec2 place = frame().to_plane(m.lat * 1e-7, m.lon * 1e-7);
  EXPECT_LT((place - Vec2(300, -400)).norm(), 0.02);  // a centimetre each way
  EXPECT_EQ(m.altitude, 100'000);
  EXPECT_EQ(m.altitude_type, 1);
  EXPECT_EQ(m.heading, 27'000);
  EXPECT_EQ(m.hor_velocity, 2000);
  EXPECT_EQ(m.ver_velocity, -300);  // it sinks
  EXPECT_EQ(m.tslc, 2);
  EXPECT_EQ(mavlink::text_of(m.callsign), "OBSERV12");
  EXPECT_EQ(m.flags, 1 | 2 | 4 | 8 | 16 | 64 | 128);
  state.v_N = {0, 0, 0};
  sky.say(1, state, 5);
  EXPECT_EQ(sky.last.flags & 4, 0);  // no course
}

TEST(TrafficMessage, NumbersThatDoNotFitAreTheNearestThatDo) {
  const TrafficState fast{s(0), {0, 0, -4e6}, {1e5, 1e5, -1e5}};
  const mavlink::AdsbVehicle m = coded({1, "A", false}, fast, s(1000), frame());
  EXPECT_EQ(m.altitude, 2'147'483'647);
  EXPECT_EQ(m.hor_velocity, 65'535);
  EXPECT_EQ(m.ver_velocity, 32'767);
  EXPECT_EQ(m.tslc, 255);
}

TEST(TrafficMessage, AddressesFollowFromNamesAndDiffer) {
  Sky one, other;
  std::set<std::uint32_t> addresses;
  for (int k = 0; k < 2000; ++k) {
    const std::string name = "vehicle-" + std::to_string(k);
    const auto id = one.exchange.add(name, false, {});
    const std::uint32_t address = one.exchange.identity(id).icao_address;
    EXPECT_GE(address, 0xf80000u);
    EXPECT_LE(address, 0xfffffeu);
    addresses.insert(address);
    EXPECT_EQ(other.exchange.identity(other.exchange.add(name, false, {})).icao_address,
              address);
  }
  EXPECT_EQ(addresses.size(), 2000u);
  EXPECT_EQ(callsign("wing-1"), "WING1");
  EXPECT_EQ(callsign("12345678901"), "45678901");
  EXPECT_EQ(callsign("-- --"), "");
}

}  // namespace
}  // namespace skein::vehicle_links::traffic_exchange_test
