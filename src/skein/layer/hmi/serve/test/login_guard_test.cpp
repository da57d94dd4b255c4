// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/login_guard.h"

#include <gtest/gtest.h>

namespace skein::hmi::login_guard_test {
namespace {

using namespace std::chrono_literals;

TEST(LoginGuard, EachWrongTokenOfAnAddressWaitsLonger) {
  LoginGuard guard;
  const LoginGuard::Moment now{1000s};
  for (int k = 0; k < LoginGuard::kFreeTries; ++k) EXPECT_EQ(guard.wrong("a", now), 0ms);
  EXPECT_EQ(guard.wrong("a", now), 250ms);
  EXPECT_EQ(guard.wrong("a", now), 500ms);
  for (int k = 0; k < 40; ++k) guard.wrong("a", now);
  EXPECT_EQ(guard.wrong("a", now), LoginGuard::kMaxWait);
  EXPECT_EQ(guard.wrong("b", now), 0ms);  // others are not slowed
  EXPECT_EQ(guard.count(), 49U);
}

TEST(LoginGuard, ForgetsOneByOne) {
  LoginGuard guard;
  const LoginGuard::Moment now{1000s};
  for (int k = 0; k < 8; ++k) guard.wrong("a", now);
  EXPECT_EQ(guard.remembered("a", now + 29s), 8);
  EXPECT_EQ(guard.remembered("a", now + 2 * 30s), 6);
  EXPECT_EQ(guard.remembered("a", now + 3600s), 0);
  EXPECT_EQ(guard.wrong("a", now + 3600s), 0ms);
}

TEST(LoginGuard, RemembersSoManyAddressesAtMost) {
  LoginGuard guard;
  LoginGuard::Moment now{1000s};
  for (std::size_t k = 0; k < 2 * LoginGuard::kMaxAddresses; ++k, now += 1ms)
    guard.wrong(std::to_string(k), now);
  EXPECT_EQ(guard.remembered("0", now), 0);  // the oldest have gone
  EXPECT_EQ(guard.remembered(std::to_string(2 * LoginGuard::kMaxAddresses - 1), now), 1);
}

}  // namespace
}  // namespace skein::hmi::login_guard_test
