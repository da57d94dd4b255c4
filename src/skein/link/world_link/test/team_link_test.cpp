// SPDX-License-Identifier: Apache-2.0
#include "skein/link/world_link/team_link.h"

#include <gtest/gtest.h>

namespace skein::world_link::team_link_test {
namespace {

constexpr EntityId kA{1}, kB{2}, kC{3};

Message to(EntityId whom, std::uint64_t number, Time time) {
  AircraftReport report;
  report.nav.time = time;
  return {kA, whom, number, time, report};
}

// What an end sends.
struct Line {
  std::vector<std::vector<std::byte>> sent;
  TeamLink::Send send = [this](std::span<const std::byte> bytes) {
    sent.emplace_back(bytes.begin(), bytes.end());
  };
};

TEST(TeamLink, BringsMessagesToWhomTheyAreForOnce) {
  Line line;
  TeamLink a(kA, 10), b(kB, 20);
  const Time at_a = Time::from_seconds(5), at_b = Time::from_seconds(100);
  for (std::uint64_t k = 0; k < 5; ++k) a.send(to(kB, k, at_a), at_a, line.send);
  a.send(to(kC, 9, at_a), at_a, line.send);
  std::vector<Message> came;
  // By two ways, and out of order.
  for (int way = 0; way < 2; ++way)
    for (const std::size_t k : {1u, 0u, 5u, 3u, 4u, 2u})
      b.receive(line.sent[k], at_b, came);
  std::vector<std::uint64_t> numbers;
  for (const Message& message : came) numbers.push_back(message.number);
  EXPECT_EQ(numbers, (std::vector<std::uint64_t>{1, 0, 3, 4, 2}));
  EXPECT_EQ(came[0].from, kA);
  EXPECT_EQ(std::get<AircraftReport>(came[0].content).nav.time, at_b);
}

TEST(TeamLink, KnowsWhoIsThere) {
  Line line;
  TeamLink a(kA, 10), b(kB, 20);
  std::vector<Message> came;
  EXPECT_FALSE(b.hears(kA, Time()));
  a.step(Time(), line.send);
  a.step(Time::from_seconds(0.5), line.send);
  ASSERT_EQ(line.sent.size(), 1u);
  b.receive(line.sent[0], Time::from_seconds(1), came);
  EXPECT_TRUE(b.hears(kA, Time::from_seconds(4)));
  EXPECT_FALSE(b.hears(kA, Time::from_seconds(4.1)));
  a.receive(line.sent[0], Time(), came);  // its own, by multicast
  EXPECT_FALSE(a.hears(kA, Time()));
}

TEST(TeamLink, TakesAnAgentThatBeganAnew) {
  Line line;
  TeamLink a(kA, 10), again(kA, 11), b(kB, 20);
  a.send(to(kB, 1, Time()), Time(), line.send);
  again.send(to(kB, 2, Time()), Time(), line.send);
  a.send(to(kB, 3, Time()), Time(), line.send);
  std::vector<Message> came;
  for (const auto& bytes : line.sent) b.receive(bytes, Time(), came);
  ASSERT_EQ(came.size(), 2u);
  EXPECT_EQ(came[1].number, 2u);
}

}  // namespace
}  // namespace skein::world_link::team_link_test
