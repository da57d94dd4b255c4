// SPDX-License-Identifier: Apache-2.0
#include "skein/link/physics/channel_map.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "skein/data/vehicle/control.h"

namespace skein::physics::channel_map_test {
namespace {

using Make = ChannelMap::Make;

MultirotorAirframe rotors_at(std::vector<RotorPlace> places) {
  MultirotorAirframe airframe;
  airframe.rotors = std::move(places);
  return airframe;
}

std::array<float, 8> applied(const ChannelMap& map, std::vector<double> outputs) {
  std::array<float, 8> channels{};
  map.apply(outputs, std::span(channels).first(map.channels()));
  return channels;
}

// The autopilot's rolls right, pitches up and yaws right; ours pitches down and yaws
// left.
TEST(ChannelMap, HasTheSignsOfThePlantsSurfaces) {
  const auto ardupilot = ChannelMap::usual(Make::kArduPilot, FixedWingAirframe{});
  const auto px4 = ChannelMap::usual(Make::kPx4, FixedWingAirframe{});
  ASSERT_TRUE(ardupilot && px4);
  for (const auto& channels : {applied(ardupilot.value(), {0.5, 0.25, 0.75, 0.125}),
                               applied(px4.value(), {0.5, 0.25, 0.125, 0.75})}) {
    EXPECT_EQ(channels[channel::kAileron], 0.5F);
    EXPECT_EQ(channels[channel::kElevator], -0.25F);
    EXPECT_EQ(channels[channel::kRudder], -0.125F);
    EXPECT_EQ(channels[channel::kThrottle], 0.75F);
    EXPECT_EQ(channels[channel::kBrake], 0);
  }
}

TEST(ChannelMap, FindsTheMotorsOfAnXByTheirPlaces) {
  // Ours: rear right, front left, rear left, front right.
  const auto map = ChannelMap::usual(
      Make::kArduPilot,
      rotors_at({{{-1, 1}, -1}, {{1, -1}, -1}, {{-1, -1}, 1}, {{1, 1}, 1}}));
  ASSERT_TRUE(map);
  EXPECT_EQ(map.value().channels(), 4u);
  // Front right, rear left, front left, rear right.
  const auto channels = applied(map.value(), {0.125, 0.25, 0.5, 0.75});
  EXPECT_EQ(channels[0], 0.75F);
  EXPECT_EQ(channels[1], 0.5F);
  EXPECT_EQ(channels[2], 0.25F);
  EXPECT_EQ(channels[3], 0.125F);
}

TEST(ChannelMap, RefusesRotorsThatTurnTheOtherWayOrAreNoX) {
  const auto turned =
      rotors_at({{{1, 1}, -1}, {{-1, -1}, -1}, {{1, -1}, 1}, {{-1, 1}, 1}});
  const auto plus = rotors_at({{{1, 0}, 1}, {{-1, 0}, 1}, {{0, -1}, -1}, {{0, 1}, -1}});
  for (const Airframe& airframe : {Airframe(turned), Airframe(plus)}) {
    EXPECT_FALSE(ChannelMap::usual(Make::kPx4, airframe));
    EXPECT_TRUE(ChannelMap::of_words({"rotor-2", "none", "rotor-0"}, airframe));
  }
  EXPECT_FALSE(ChannelMap::usual(Make::kArduPilot, SelfStabilised{}));
}

TEST(ChannelMap, IsReadFromWords) {
  const auto map =
      ChannelMap::of_words({"none", "-elevator", "throttle"}, FixedWingAirframe{});
  ASSERT_TRUE(map);
  const auto channels = applied(map.value(), {1, 0.5, 0.25});
  EXPECT_EQ(channels[channel::kElevator], 0.5F);
  EXPECT_EQ(channels[channel::kThrottle], 0.25F);
  EXPECT_EQ(channels[channel::kAileron], 0);
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"flap"},
                                                {"rotor-0"},
                                                {"-throttle"},
                                                {"aileron", "aileron"}})
    EXPECT_FALSE(ChannelMap::of_words(wrong, FixedWingAirframe{})) << wrong[0];
}

TEST(ChannelMap, BoundsWhatItIsGiven) {
  const auto map = ChannelMap::usual(Make::kArduPilot, FixedWingAirframe{});
  ASSERT_TRUE(map);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const auto channels = applied(map.value(), {7, kNaN, -3, -9});
  EXPECT_EQ(channels[channel::kAileron], 1);
  EXPECT_EQ(channels[channel::kElevator], 0);
  EXPECT_EQ(channels[channel::kThrottle], 0);
  EXPECT_EQ(channels[channel::kRudder], 1);
}

}  // namespace
}  // namespace skein::physics::channel_map_test
