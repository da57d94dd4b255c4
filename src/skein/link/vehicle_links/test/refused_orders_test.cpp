// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_links/refused_orders.h"

#include <gtest/gtest.h>

namespace skein::vehicle_links {
namespace {

TEST(RefusedOrders, AreReportedOnceAMinuteForEachAircraft) {
  RefusedOrders refused;
  for (int k = 0; k < 10'000; ++k) {  // for 100 s
    const Time now = Time::from_seconds(0.01 * k);
    refused.add("udp:1", {.shown = 3}, now);
    refused.add("udp:1", {.vehicle = "real-1"}, now);
  }
  const std::vector<RefusedOrder> all = refused.take();
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].shown, 3u);
  EXPECT_EQ(all[1].vehicle, "real-1");
  EXPECT_NE(all[1].text.find("udp:1"), std::string::npos);
  EXPECT_NE(all[3].text.find("(12002 so far)"), std::string::npos) << all[3].text;
  EXPECT_TRUE(refused.take().empty());
}

TEST(RefusedOrders, AreBoundedWhileNobodyTakesThem) {
  RefusedOrders refused;
  for (int k = 0; k < 5000; ++k)
    refused.add("udp:1", {.shown = 3}, Time::from_seconds(100.0 * k));
  EXPECT_LE(refused.take().size(), 1000u);
}

}  // namespace
}  // namespace skein::vehicle_links
