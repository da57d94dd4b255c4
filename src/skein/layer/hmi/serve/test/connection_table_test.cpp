// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/connection_table.h"

#include <gtest/gtest.h>

namespace skein::hmi::connection_table_test {
namespace {

TEST(AddressGroup, IsWhatOneMachineCanHave) {
  EXPECT_EQ(address_group("10.0.0.7"), "10.0.0.7");
  EXPECT_EQ(address_group("::ffff:10.0.0.7"), "10.0.0.7");
  // This machine has a whole network of addresses to come from.
  for (const char* here : {"127.0.0.1", "127.9.8.7", "::1", "::ffff:127.0.0.2"})
    EXPECT_EQ(address_group(here), "loopback");
  EXPECT_EQ(address_group("2001:db8:1:2:3:4:5:6"), address_group("2001:db8:1:2::9"));
  EXPECT_NE(address_group("2001:db8:1:2::9"), address_group("2001:db8:1:3::9"));
  EXPECT_EQ(address_group("nonsense"), "nonsense");
}

TEST(ConnectionTable, OneAddressDoesNotTakeTheRoomOfOthers) {
  ConnectionTable table({.in_all = 4, .per_address = 2});
  for (int k = 0; k < 2; ++k) {
    const auto entry = table.enter("a");
    ASSERT_TRUE(entry.taken);
    table.set_waiting(*entry.taken, false);
  }
  EXPECT_FALSE(table.enter("a").taken);  // both are being served
  EXPECT_TRUE(table.enter("b").taken);
  EXPECT_TRUE(table.enter("b").taken);
  EXPECT_EQ(table.size(), 4U);
}

TEST(ConnectionTable, WhoHasWaitedLongestMakesRoom) {
  ConnectionTable table({.in_all = 3, .per_address = 2});
  const auto first = *table.enter("a").taken, second = *table.enter("a").taken;
  table.set_waiting(first, true);  // it has been served since
  const auto third = table.enter("a");
  ASSERT_TRUE(third.taken);
  EXPECT_EQ(third.evicted, second);
  // In all: of whatever address.
  ASSERT_TRUE(table.enter("b").taken);
  const auto last = table.enter("c");
  ASSERT_TRUE(last.taken);
  EXPECT_EQ(last.evicted, first);
  EXPECT_EQ(table.size(), 3U);
  table.leave(first);  // it has been evicted: nothing
  table.leave(*last.taken);
  EXPECT_EQ(table.size(), 2U);
}

}  // namespace
}  // namespace skein::hmi::connection_table_test
