// SPDX-License-Identifier: Apache-2.0
#include "skein/base/loopback.h"

#include <gtest/gtest.h>

namespace skein::loopback_test {
namespace {

TEST(Loopback, IsWhatOtherMachinesCannotReach) {
  for (const char* here :
       {"localhost", "LocalHost", "localhost.", "127.0.0.1", "127.255.255.254", "127.1",
        "::1", "[::1]", "0:0:0:0:0:0:0:1", "[0:0::0:1]", "::ffff:127.0.0.1",
        "[::FFFF:127.9.9.9]", "::ffff:7f00:1"})
    EXPECT_TRUE(is_loopback(here)) << here;
  for (const char* elsewhere : {"",
                                ".",
                                "localhost.example",
                                "mylocalhost",
                                "126.255.255.255",
                                "128.0.0.1",
                                "10.127.0.1",
                                "0.0.0.0",
                                "127.0.0.1.example",
                                "127.0.0.1 x",
                                "127.0.0.256",
                                "127.0.0.1.5",
                                "::",
                                "[::]",
                                "::2",
                                "[::1",
                                "::1]",
                                "::127.0.0.1",
                                "::ffff:128.0.0.1",
                                "fe80::1",
                                "1::1",
                                "[127.0.0.1]",
                                "[localhost]"})
    EXPECT_FALSE(is_loopback(elsewhere)) << elsewhere;
}

}  // namespace
}  // namespace skein::loopback_test
