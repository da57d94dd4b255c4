// SPDX-License-Identifier: Apache-2.0
// Real sockets on this machine, in real time.
#include "app/study/mixed_network/mixed_network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace skein::mixed_network::mixed_network_test {
namespace {

using Arrivals = std::vector<MixedNetwork::Arrival>;

MixedNetworkOptions two_entities(const char* radio, std::vector<bool> real) {
  MixedNetworkOptions options;
  options.radio =
      load_radio(radio, std::filesystem::current_path(), assemble::own_radio_parts())
          .value();
  options.places = {{0, 0, -2}, {50, 0, -2}};
  options.station = Vec3(50, 50, -2);
  options.real = std::move(real);
  return options;
}

// What arrives of one message of each, within two seconds.
Arrivals arrivals_of(MixedNetworkOptions options) {
  const std::size_t entities = options.places.size();
  MixedNetwork network(std::move(options));
  const std::atomic<bool> stop = false;
  const auto started = network.start(stop);
  EXPECT_TRUE(started);
  Arrivals arrivals;
  const Time begin = network.now();
  std::uint32_t said = 0;
  while (network.now() - begin < Time::from_seconds(2)) {
    if (said < entities && network.now() - begin > Time::from_seconds(0.2 * said))
      network.say(EntityId{said++}, 100);
    network.step(arrivals);
  }
  return arrivals;
}

std::ptrdiff_t count(const Arrivals& all, std::uint32_t from, std::uint32_t to) {
  return std::count_if(all.begin(), all.end(), [&](const auto& each) {
    return each.from.value == from && each.to.value == to;
  });
}

TEST(MixedNetwork, EachMessageArrivesOnceWhoeverIsReal) {
  for (const bool first : {false, true})
    for (const bool second : {false, true}) {
      const Arrivals all = arrivals_of(two_entities("nn8", {first, second}));
      EXPECT_EQ(count(all, 0, 1), 1) << first << second;
      EXPECT_EQ(count(all, 1, 0), 1) << first << second;
    }
}

TEST(MixedNetwork, TheStationDoesNotSayAgainWhatRealOnesHearThemselves) {
  MixedNetworkOptions options = two_entities("nn8", {true, true});
  options.places.push_back({25, 40, -2});
  options.real.push_back(false);
  const Arrivals all = arrivals_of(options);
  EXPECT_EQ(count(all, 0, 1), 1);
  EXPECT_EQ(count(all, 0, 2), 1);
  EXPECT_EQ(count(all, 2, 0), 1);
  EXPECT_EQ(count(all, 2, 1), 1);
}

TEST(MixedNetwork, NeedsNoSocketsWhereAllAreSimulated) {
  MixedNetworkOptions options = two_entities("nn8", {false, false});
  options.places[1] = Vec3(5000, 0, -2);  // out of reach
  EXPECT_TRUE(arrivals_of(options).empty());
}

TEST(MixedNetwork, FailsWhereRealOnesDoNotMeetAndWhenItIsStopped) {
  MixedNetworkOptions options = two_entities("nn8", {true, true});
  options.places[1] = Vec3(5000, 0, -2);
  MixedNetwork apart(options);
  std::atomic<bool> stop = true;
  const auto stopped = apart.start(stop);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
  // Said to be out of reach, they need not.
  options.apart = {{EntityId{0}, EntityId{1}}};
  EXPECT_TRUE(arrivals_of(options).empty());
}

}  // namespace
}  // namespace skein::mixed_network::mixed_network_test
