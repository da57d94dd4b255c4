// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/access.h"

#include <gtest/gtest.h>

#include "skein/layer/hmi/serve/message_rate.h"

namespace skein::hmi::access_test {
namespace {

constexpr const char* kTokens =
    "# who may see the run\n"
    "\n"
    "0123456789abcdef viewer\n"
    "operator-operator operator  Anna Novak \r\n"
    "instructor_instructor\tinstructor\n";

TEST(Access, TokensHaveRolesAndNames) {
  const auto table = AccessTable::parse(kTokens, "tokens");
  ASSERT_TRUE(table) << table.error().text();
  EXPECT_FALSE(table.value().is_open());
  EXPECT_EQ(table.value().find("0123456789abcdef")->role, AccessRole::kViewer);
  const auto anna = table.value().find("operator-operator");
  ASSERT_TRUE(anna);
  EXPECT_EQ(anna->role, AccessRole::kOperator);
  EXPECT_EQ(anna->name, "Anna Novak");
  EXPECT_EQ(table.value().find("instructor_instructor")->role, AccessRole::kInstructor);
}

TEST(Access, OtherTokensHaveNothing) {
  const auto table = AccessTable::parse(kTokens, "tokens");
  ASSERT_TRUE(table);
  for (const char* wrong : {"", "0123456789abcde", "0123456789abcdeF",
                            "0123456789abcdef ", "0123456789abcdef0"})
    EXPECT_FALSE(table.value().find(wrong)) << wrong;
}

TEST(Access, BadTablesSayWhereAndWhat) {
  struct Case {
    const char* text;
    const char* says;
  };
  for (const auto& [text, says] :
       {Case{"short viewer", "t:1: a token has 16"},
        Case{"\n0123456789abcdef boss", "t:2: \"boss\" is no role"},
        Case{"0123456789abcde/ viewer", "of letters, digits, - and _"},
        Case{"0123456789abcdef viewer\n0123456789abcdef operator", "twice"},
        Case{"# nobody\n", "there is no token"},
        Case{"0123456789abcdef", "\"\" is no role"}}) {
    const auto table = AccessTable::parse(text, "t");
    ASSERT_FALSE(table) << text;
    EXPECT_NE(table.error().text().find(says), std::string::npos) << table.error().text();
  }
}

TEST(Access, TokenIsFoundAmongCookies) {
  EXPECT_EQ(token_in_cookies("skein_token=abc"), "abc");
  EXPECT_EQ(token_in_cookies("a=1; skein_token=abc; b=2"), "abc");
  EXPECT_EQ(token_in_cookies("xskein_token=abc"), "");
  EXPECT_EQ(token_in_cookies(";;=;a"), "");
  EXPECT_NE(token_cookie("abc", false).find("HttpOnly; SameSite=Strict"),
            std::string::npos);
  EXPECT_NE(token_cookie("abc", true).find("Secure"), std::string::npos);
}

TEST(Access, PagesOfOtherServersAreTold) {
  EXPECT_TRUE(is_same_origin("", "localhost:8080"));
  EXPECT_TRUE(is_same_origin("http://localhost:8080", "localhost:8080"));
  EXPECT_FALSE(is_same_origin("http://localhost:8081", "localhost:8080"));
  EXPECT_FALSE(is_same_origin("http://evil.example", "localhost:8080"));
  EXPECT_FALSE(is_same_origin("null", "localhost:8080"));
}

TEST(Access, NamesThatLeadHereFromElsewhereAreTold) {
  for (const char* here :
       {"localhost", "localhost:8080", "127.0.0.1:80", "[::1]:8080", "[::1]", "127.3.2.1",
        "[::ffff:127.0.0.1]:8080", "[::ffff:7f00:1]"})
    EXPECT_TRUE(names_this_machine(here)) << here;
  for (const char* elsewhere :
       {"", "evil.example:8080", "127.0.0.1.evil.example", "localhost.evil.example",
        "[::2]", "[::1", "10.0.0.1", "[::ffff:10.0.0.1]"})
    EXPECT_FALSE(names_this_machine(elsewhere)) << elsewhere;
}

TEST(MessageRate, AllowsABurstAndThenSoManyASecond) {
  MessageRate rate(10);
  const MessageRate::Moment start = MessageRate::Moment() + std::chrono::seconds(100);
  int allowed = 0;
  for (int k = 0; k < 100; ++k) allowed += rate.allows(start);
  EXPECT_EQ(allowed, 10);
  for (int k = 1; k <= 100; ++k)
    allowed += rate.allows(start + std::chrono::milliseconds(50 * k));
  EXPECT_NEAR(allowed, 10 + 50, 1);
}

}  // namespace
}  // namespace skein::hmi::access_test
