// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/outbox.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/team/protocol/round_trips.h"

namespace skein::reasoning::outbox_test {
namespace {

constexpr EntityId kSelf{1}, kA{2}, kB{3};

// How many messages go to each in so many steps, a second apart.
std::map<EntityId, int> repeated(TeamOutbox& outbox, int from, int steps) {
  std::map<EntityId, int> all;
  for (int k = from; k < from + steps; ++k) {
    outbox.begin(Time::from_seconds(k));
    outbox.send_repeated(1);
    for (const TeamOutgoing& out : outbox.take().send) ++all[*out.to];
  }
  return all;
}

TEST(TeamOutbox, CountsWhatGoesToAllAndToEach) {
  TeamOutbox outbox(kSelf);
  outbox.begin(Time());
  EXPECT_EQ(outbox.send_all(TeamQuery{}), 1u);
  outbox.send(kA, TeamReject{});
  outbox.send(kB, TeamReject{});
  outbox.send(kA, TeamReject{});
  EXPECT_EQ(outbox.send_all(TeamQuery{}), 2u);
  const auto step = outbox.take();
  ASSERT_EQ(step.send.size(), 5u);
  EXPECT_EQ(step.send[2].message.number, 1u);
  EXPECT_EQ(step.send[3].message.number, 2u);
  EXPECT_TRUE(outbox.take().send.empty()) << "sent once";
}

TEST(TeamOutbox, RepeatsSoOftenAndNotForEver) {
  TeamOutbox outbox(kSelf);
  outbox.begin(Time());
  outbox.repeat(kA, TeamConfirm{1}, 3, 100);
  outbox.repeat(kB, TeamConfirm{1}, 3, 1);
  const auto all = repeated(outbox, 0, 10);
  EXPECT_EQ(all.at(kA), 3);
  EXPECT_EQ(all.at(kB), 2) << "at 0 s and at 1 s";
}

TEST(TeamOutbox, DropsWhatIsOver) {
  TeamOutbox outbox(kSelf);
  outbox.begin(Time());
  for (const EntityId id : {kA, kB}) outbox.repeat(id, TeamConfirm{1}, 9, 100);
  outbox.drop_repeated_to(kA);
  EXPECT_FALSE(repeated(outbox, 0, 2).contains(kA));
  outbox.drop_repeated_except_to(kB);
  EXPECT_EQ(repeated(outbox, 2, 2).at(kB), 2);
  outbox.drop_repeated();
  EXPECT_TRUE(repeated(outbox, 4, 2).empty());
}

TEST(RoundTrips, AreThoseOfQueriesThatWereSent) {
  RoundTrips trips;
  trips.sent(1, 10);
  EXPECT_FALSE(trips.answered(kA, 2, 0, 12)) << "there was no such query";
  EXPECT_FALSE(trips.answered(kA, 1, 5, 12)) << "held for longer than it took";
  EXPECT_DOUBLE_EQ(*trips.answered(kA, 1, 0.5, 12), 1.5);
  EXPECT_DOUBLE_EQ(*trips.answered(kB, 1, 0, 11), 1.5) << "the longest counts";
  trips.forget(kA);
  EXPECT_DOUBLE_EQ(*trips.answered(kB, 1, 0, 11), 1);
}

}  // namespace
}  // namespace skein::reasoning::outbox_test
