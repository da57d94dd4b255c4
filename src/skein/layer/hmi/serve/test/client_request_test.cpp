// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/client_request.h"

#include <gtest/gtest.h>

namespace skein::hmi::client_request_test {
namespace {

template <class What>
What read(const char* text) {
  const auto request = parse_client_request(text);
  EXPECT_TRUE(request) << request.error().text();
  if (!request) return {};
  const auto* what = std::get_if<What>(&request.value().what);
  EXPECT_TRUE(what) << text;
  return what ? *what : What{};
}

TEST(ClientRequest, ReadsWhatPagesAskFor) {
  EXPECT_EQ(read<CommandRequest>(R"({"number": 1, "line": "pause"})").line, "pause");
  EXPECT_EQ(
      read<CommandRequest>(R"({"number":1,"command":{"kind":"pause","paused":true}})")
          .line,
      R"({"kind":"pause","paused":true})");
  EXPECT_FALSE(read<HoldRequest>(R"({"number":1,"hold":false})").hold);
  EXPECT_EQ(read<HandOverRequest>(R"({"number":1,"hand_over":3})").client, 3U);
  EXPECT_EQ(read<NameRequest>(R"({"number":1,"name":"Anna"})").name, "Anna");
  EXPECT_FALSE(read<TruthRequest>(R"({"number":1,"truth":false})").shown);
  EXPECT_EQ(read<SeekRequest>(R"({"number":1,"seek_s":12.5})").time, 12.5);
  EXPECT_EQ(parse_client_request(R"({"hold":true,"number":77})").value().number, 77U);
}

TEST(ClientRequest, NamesCannotSteerAnything) {
  EXPECT_EQ(read<NameRequest>(R"({"number":1,"name":"a\u202eb\u0007"})").name,
            "a\\u202eb\\x07");
}

TEST(ClientRequest, RefusesEverythingElse) {
  std::string deep = R"({"number":1,"command":)";
  for (int k = 0; k < 5000; ++k) deep += R"({"a":)";
  for (const std::string& bad :
       {std::string(""), std::string("{"), std::string("[]"), std::string("null"),
        std::string(R"({"number":1})"), std::string(R"({"line":"pause"})"),
        std::string(R"({"number":-1,"line":"pause"})"),
        std::string(R"({"number":1.5,"line":"pause"})"),
        std::string(R"({"number":4294967296,"line":"pause"})"),
        std::string(R"({"number":1,"line":5})"),
        std::string(R"({"number":1,"command":"pause"})"),
        std::string(R"({"number":1,"hold":1})"),
        std::string(R"({"number":1,"seek_s":1e999})"),
        std::string(R"({"number":1,"line":"pause","hold":true})"),
        std::string(R"({"number":1,"other":true})"),
        R"({"number":1,"name":")" + std::string(65, 'x') + R"("})", deep}) {
    const auto request = parse_client_request(bad);
    EXPECT_FALSE(request) << bad.substr(0, 80);
  }
}

}  // namespace
}  // namespace skein::hmi::client_request_test
