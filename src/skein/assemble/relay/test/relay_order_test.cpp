// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/relay/relay_order.h"

#include <gtest/gtest.h>

#include <string>

namespace skein::assemble::relay_order_test {
namespace {

using impairment::Directions;

TEST(RelayOrder, IsAKeyAndAValue) {
  const auto loss = parse_relay_order("loss 0.3");
  ASSERT_TRUE(loss.ok()) << loss.error().text();
  EXPECT_EQ(loss.value().kind, RelayOrder::Kind::kChange);
  EXPECT_EQ(loss.value().change.loss, 0.3);
  EXPECT_EQ(loss.value().change.delay, std::nullopt);
  EXPECT_EQ(loss.value().directions, Directions::kBoth);
  const auto delay = parse_relay_order("  delay_s 0.5\tto-b\r");
  ASSERT_TRUE(delay.ok()) << delay.error().text();
  EXPECT_EQ(delay.value().change.delay, 0.5);
  EXPECT_EQ(delay.value().directions, Directions::kToB);
  EXPECT_EQ(parse_relay_order("cut true").value().change.cut, true);
  EXPECT_EQ(parse_relay_order("jitter_kind normal").value().change.jitter_kind,
            impairment::JitterKind::kNormal);
}

TEST(RelayOrder, IsAnOutageAResetOrAQuestion) {
  const auto outage = parse_relay_order("outage 5 to-a");
  ASSERT_TRUE(outage.ok());
  EXPECT_EQ(outage.value().kind, RelayOrder::Kind::kOutage);
  EXPECT_EQ(outage.value().length, Time::from_seconds(5));
  EXPECT_EQ(outage.value().directions, Directions::kToA);
  EXPECT_EQ(parse_relay_order("reset").value().kind, RelayOrder::Kind::kReset);
  EXPECT_EQ(parse_relay_order("stats").value().kind, RelayOrder::Kind::kStatistics);
}

TEST(RelayOrder, SaysWhatIsWrong) {
  const auto says = [](const std::string& line, const std::string& part) {
    const auto order = parse_relay_order(line);
    ASSERT_FALSE(order.ok()) << line;
    EXPECT_NE(order.error().text().find(part), std::string::npos) << order.error().text();
  };
  says("", "the line is empty");
  says("loss", "needs a value");
  says("loss 0.3 up", "\"up\" is no direction");
  says("loss 0.3 to-a now", "a direction at most");
  says("loss 3", "loss: 3");
  says("losss 0.3", "Did you mean \"loss\"?");
  says("loss {a: 1}", "neither key nor value");
  says("loss [1]", "neither key nor value");
  says("loss nan", "loss");
  says("outage -1", "from 0 to 86400");
  says("outage 1e99", "from 0 to 86400");
  says("reset now", "stands alone");
}

}  // namespace
}  // namespace skein::assemble::relay_order_test
