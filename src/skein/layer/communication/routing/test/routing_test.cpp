// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>

#include "skein/layer/communication/routing/flooding.h"
#include "skein/layer/communication/routing/learned_routes.h"
#include "skein/layer/communication/routing/no_routing.h"
#include "skein/role/contract/contract.h"

namespace skein::communication::routing_test {
namespace {

constexpr EntityId kFar{5}, kHere{0}, kNear{1}, kOther{2};
const Time kNow = Time::from_seconds(100);

const HeardLately kReceivesNear = [](EntityId node, EntityId other) {
  return node == kHere && (other == kNear || other == kOther);
};

TEST(Routing, AllKeepTheContract) {
  const contract::Violations none;
  EXPECT_EQ(contract::routing_violations([] { return std::make_unique<NoRouting>(); }),
            none);
  EXPECT_EQ(contract::routing_violations([] {
              return std::make_unique<Flooding>(FloodingOptions{},
                                                contract::kRoutingEntities, 3);
            }),
            none);
  EXPECT_EQ(contract::routing_violations([] {
              return std::make_unique<LearnedRoutes>(LearnedRoutesOptions{},
                                                     contract::kRoutingEntities, 3);
            }),
            none);
}

TEST(NoRouting, SendsOnlyWhatIsItsOwn) {
  NoRouting routing;
  EXPECT_EQ(routing.next(kHere, {kHere, kFar, 0}, kReceivesNear, kNow), kFar);
  EXPECT_EQ(routing.next(kHere, {kHere, kEveryone, 0}, kReceivesNear, kNow), kEveryone);
  EXPECT_FALSE(routing.next(kNear, {kHere, kFar, 1}, kReceivesNear, kNow));
}

TEST(Flooding, SendsToWhomItHearsElseToAllUpToItsHops) {
  Flooding routing({.hops = 2, .delay = 0.05}, 6, 1);
  EXPECT_EQ(routing.next(kHere, {kHere, kNear, 0}, kReceivesNear, kNow), kNear);
  EXPECT_EQ(routing.next(kHere, {kHere, kFar, 0}, kReceivesNear, kNow), kEveryone);
  EXPECT_EQ(routing.next(kHere, {kOther, kFar, 2}, kReceivesNear, kNow), kEveryone);
  EXPECT_FALSE(routing.next(kHere, {kOther, kFar, 3}, kReceivesNear, kNow));
  for (int i = 0; i < 100; ++i) {
    const double delay = routing.delay(kHere);
    EXPECT_GE(delay, 0);
    EXPECT_LE(delay, 0.05);
  }
}

TEST(LearnedRoutes, KnowTheWayThatAMessageHasCome) {
  LearnedRoutes routing({.flooding = {}, .lifetime = Time::from_seconds(10)}, 6, 1);
  const RoutedMessage back{kHere, kFar, 0};
  EXPECT_EQ(routing.next(kHere, back, kReceivesNear, kNow), kEveryone);
  routing.learn(kHere, kNear, {kFar, kHere, 2}, kNow);
  EXPECT_EQ(routing.next(kHere, back, kReceivesNear, kNow), kNear);
  // A longer way does not count, a shorter one does.
  routing.learn(kHere, kOther, {kFar, kHere, 3}, kNow);
  EXPECT_EQ(routing.next(kHere, back, kReceivesNear, kNow), kNear);
  routing.learn(kHere, kOther, {kFar, kHere, 1}, kNow);
  EXPECT_EQ(routing.next(kHere, back, kReceivesNear, kNow), kOther);
  // It grows old, is forgotten when it fails, and is no way when its first is not heard.
  const Time later = kNow + Time::from_seconds(10.1);
  EXPECT_EQ(routing.next(kHere, back, kReceivesNear, later), kEveryone);
  routing.learn(kHere, kNear, {kFar, kHere, 3}, later);
  EXPECT_EQ(routing.next(kHere, back, kReceivesNear, later), kNear);
  const HeardLately deaf = [](EntityId, EntityId) { return false; };
  EXPECT_EQ(routing.next(kHere, back, deaf, later), kEveryone);
  EXPECT_TRUE(routing.failed(kHere, kNear));
  EXPECT_EQ(routing.next(kHere, back, kReceivesNear, later), kEveryone);
}

TEST(LearnedRoutes, KnowTheWayThatTheyHaveOverheard) {
  LearnedRoutes routing({}, 6, 1);
  // What 0 said for 5 goes on by 1, which hears 5.
  routing.overhear(kHere, kNear, kFar, {kHere, kFar, 1}, kNow);
  EXPECT_EQ(routing.next(kHere, {kHere, kFar, 0}, kReceivesNear, kNow), kNear);
  // It is not known how far it is from 3 on.
  LearnedRoutes other({}, 6, 1);
  other.overhear(kHere, kNear, EntityId{3}, {kHere, kFar, 1}, kNow);
  EXPECT_EQ(other.next(kHere, {kHere, kFar, 0}, kReceivesNear, kNow), kEveryone);
}

TEST(LearnedRoutes, LearnNothingFromWhomTheyHearThemselves) {
  LearnedRoutes routing({}, 6, 1);
  routing.learn(kHere, kNear, {kNear, kHere, 0}, kNow);
  const HeardLately deaf_to_it = [](EntityId, EntityId other) { return other == kOther; };
  EXPECT_EQ(routing.next(kHere, {kHere, kNear, 0}, deaf_to_it, kNow), kEveryone);
}

}  // namespace
}  // namespace skein::communication::routing_test
