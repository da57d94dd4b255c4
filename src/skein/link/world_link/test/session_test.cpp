// SPDX-License-Identifier: Apache-2.0
#include "skein/link/world_link/session.h"

#include <gtest/gtest.h>

#include <optional>

#include "skein/link/world_link/test/packet_line.h"

namespace skein::world_link::session_test {
namespace {

using Kind = SessionChange::Kind;

SessionOptions with_id(std::uint64_t id) {
  SessionOptions options;
  options.id = id;
  options.hello.software = "test " + std::to_string(id);
  return options;
}

// Clocks that began at other times than the test's.
const Time kWorldClock = Time::from_seconds(1000), kAgentClock = Time::from_seconds(-7);

struct Ends {
  End world{with_id(100), kWorldClock}, agent{with_id(200), kAgentClock};
};

TEST(Session, BringsEveryParcelOnceAndInOrderOverAnyLine) {
  for (const Trouble& trouble : troubles()) {
    PacketLine line(trouble, 1);
    Ends ends;
    line.run_for(5, &ends.world, &ends.agent);
    ASSERT_TRUE(ends.world.session.up() && ends.agent.session.up());
    std::vector<std::string> sent;
    for (int k = 0; k < 200; ++k) {
      sent.push_back("parcel " + std::to_string(k));
      ends.world.post(sent.back(), line.now);
      ends.agent.post(sent.back(), line.now);
      line.run_for(0.1, &ends.world, &ends.agent);
    }
    line.run_for(9, &ends.world, &ends.agent);
    EXPECT_EQ(ends.agent.came, sent) << "loss " << trouble.loss;
    EXPECT_EQ(ends.world.came, sent) << "loss " << trouble.loss;
    EXPECT_EQ(ends.agent.session.waiting(), 0u);
    EXPECT_EQ(ends.agent.changes, std::vector{Kind::kUp});
    EXPECT_EQ(ends.world.changes, std::vector{Kind::kUp});
  }
}

TEST(Session, OfWhatIsShownNothingOlderComesAfterTheNewest) {
  PacketLine line({0.2, 0.05, 0.3, 0.2}, 2);
  Ends ends;
  line.run_for(3, &ends.world, &ends.agent);
  for (int k = 0; k < 300; ++k) {
    ends.agent.show(std::to_string(k));
    line.run_for(0.1, &ends.world, &ends.agent);
  }
  ASSERT_GT(ends.world.came.size(), 100u);
  for (std::size_t k = 1; k < ends.world.came.size(); ++k)
    EXPECT_LT(std::stoi(ends.world.came[k - 1]), std::stoi(ends.world.came[k]));
}

TEST(Session, KnowsTheOtherClockToHalfARoundTrip) {
  for (const Trouble& trouble : troubles()) {
    PacketLine line(trouble, 3);
    Ends ends;
    line.run_for(30, &ends.world, &ends.agent);
    ends.agent.post("now", line.now);
    line.run_for(3, &ends.world, &ends.agent);
    ASSERT_EQ(ends.world.came.size(), 1u);
    // Jitter makes ways differ by at most itself, steps add one hundredth on each way.
    EXPECT_NEAR(ends.world.shift.seconds(), (kWorldClock - kAgentClock).seconds(),
                trouble.jitter / 2 + 0.011);
  }
}

TEST(Session, SaysOnceThatTheOtherIsLostAndBackAndKeepsWhatIsYoung) {
  PacketLine line({}, 4);
  Ends ends;
  line.run_for(1, &ends.world, &ends.agent);
  line.cut = true;
  ends.agent.post("old", line.now);
  line.run_for(8, &ends.world, &ends.agent);
  EXPECT_FALSE(ends.agent.session.up());
  EXPECT_EQ(ends.agent.changes, (std::vector{Kind::kUp, Kind::kDown}));
  ends.agent.post("young", line.now);
  ends.agent.show("state");
  line.run_for(4, &ends.world, &ends.agent);
  line.cut = false;
  line.run_for(1, &ends.world, &ends.agent);
  EXPECT_EQ(ends.agent.changes, (std::vector{Kind::kUp, Kind::kDown, Kind::kUp}));
  EXPECT_EQ(ends.world.changes, (std::vector{Kind::kUp, Kind::kDown, Kind::kUp}));
  EXPECT_EQ(ends.world.came, std::vector<std::string>{"young"});
  ends.agent.post("after", line.now);
  line.run_for(1, &ends.world, &ends.agent);
  EXPECT_EQ(ends.world.came.back(), "after");
}

TEST(Session, GoesOnWithWhoeverBeginsAnew) {
  PacketLine line({0.1, 0.02, 0.05, 0.1}, 5);
  Ends ends;
  line.run_for(2, &ends.world, &ends.agent);
  for (int k = 0; k < 5; ++k) ends.agent.post("before", line.now);
  line.run_for(1, &ends.world, &ends.agent);
  // The world is killed and is back before it is missed; then again, later.
  for (std::uint64_t id : {101u, 102u}) {
    line.run_for(id == 101 ? 0.5 : 5, nullptr, &ends.agent);
    ends.agent.post("to " + std::to_string(id), line.now);
    End again(with_id(id), Time());
    line.run_for(5, &again, &ends.agent);
    EXPECT_EQ(again.came, std::vector<std::string>{"to " + std::to_string(id)});
    again.post("hello from " + std::to_string(id), line.now);
    line.run_for(2, &again, &ends.agent);
    EXPECT_EQ(ends.agent.came.back(), "hello from " + std::to_string(id));
  }
  EXPECT_EQ(ends.agent.changes, (std::vector{Kind::kUp, Kind::kRestarted, Kind::kUp,
                                             Kind::kDown, Kind::kUp}));
}

TEST(Session, OfTwoTheOneThatBeganLaterCounts) {
  Ends ends;
  End older(with_id(150), Time());
  Time now;
  const auto hand = [&](End& from, End& to) {
    from.session.step(now + from.ahead, [&](const Packet& p) { to.take(p, now); });
  };
  for (int k = 0; k < 100; ++k) {
    now = now + Time::from_seconds(0.1);
    hand(ends.agent, ends.world);
    hand(older, ends.world);
    hand(ends.world, ends.agent);
    EXPECT_NE(ends.world.session.peer(), 150u);
  }
  // Once the newer one is silent, the older one is taken.
  for (int k = 0; k < 30; ++k) {
    now = now + Time::from_seconds(0.1);
    hand(older, ends.world);
    hand(ends.world, older);
  }
  EXPECT_EQ(ends.world.session.peer(), 150u);
  EXPECT_TRUE(older.session.up());
}

TEST(Session, AByeEndsItAtOnceAndLatePacketsDoNotRaiseIt) {
  Ends ends;
  PacketLine line({}, 6);
  line.run_for(1, &ends.world, &ends.agent);
  std::optional<Packet> late;
  ends.agent.session.step(line.now + Time::from_seconds(1),
                          [&](const Packet& p) { late = p; });
  ASSERT_TRUE(late);
  ends.agent.session.say_bye(line.now, "the end",
                             [&](const Packet& p) { ends.world.take(p, line.now); });
  EXPECT_FALSE(ends.world.session.up());
  ends.world.take(*late, line.now);
  EXPECT_EQ(ends.world.changes, (std::vector{Kind::kUp, Kind::kDown}));
}

TEST(Session, IsTakenUpByOneThatAsksWhoIsThere) {
  PacketLine line({}, 8);
  Ends ends;
  line.run_for(1, &ends.world, &ends.agent);
  // A new world got a packet without a hello, and answers that it knows nobody.
  Packet question;
  question.session = 101;
  question.number = 1;
  ends.agent.take(question, line.now);
  std::optional<Packet> answer;
  ends.agent.session.step(line.now + ends.agent.ahead,
                          [&](const Packet& packet) { answer = packet; });
  ASSERT_TRUE(answer);
  ASSERT_TRUE(answer->hello);
  EXPECT_EQ(answer->hello->software, "test 200");
}

TEST(Session, HoldsABoundedNumberOfParcels) {
  SessionOptions options = with_id(200);
  options.max_parcels = 10;
  options.max_bytes = 1000;
  End agent(options, Time());
  for (int k = 0; k < 50; ++k) agent.post(std::to_string(k), Time());
  EXPECT_EQ(agent.session.waiting(), 10u);
  EXPECT_EQ(agent.session.dropped(), 40u);
  agent.post(std::string(900, 'x'), Time());
  agent.post(std::string(900, 'y'), Time());
  EXPECT_EQ(agent.session.waiting(), 1u);
  EXPECT_FALSE(agent.session.post(std::vector<std::byte>(kMaxValue + 1), Time()));
  End world(with_id(100), Time());
  PacketLine line({}, 7);
  line.run_for(1, &world, &agent);
  EXPECT_EQ(world.came, std::vector<std::string>{std::string(900, 'y')});
}

TEST(Session, WhatIsRefusedIsSaidOnce) {
  Ends ends;
  Packet refusal;
  refusal.session = 100;
  refusal.heard_session = 200;
  refusal.number = 1;
  refusal.bye = Bye{true, "another scenario"};
  for (int k = 0; k < 3; ++k) ends.agent.take(refusal, Time());
  EXPECT_EQ(ends.agent.changes, std::vector{Kind::kRefused});
  refusal.heard_session = 7;  // to somebody else
  refusal.bye->why = "other";
  ends.agent.take(refusal, Time());
  EXPECT_EQ(ends.agent.changes.size(), 1u);
}

}  // namespace
}  // namespace skein::world_link::session_test
