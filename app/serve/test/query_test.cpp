// SPDX-License-Identifier: Apache-2.0
#include "app/serve/query.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace skein::serve::query_test {
namespace {

constexpr std::string_view kNames[] = {"name", "crs"};

TEST(Query, IsReadByNameWithItsCodes) {
  const auto values = read_query("name=a%20b+%C3%A4%2b&crs=&", kNames);
  ASSERT_TRUE(values) << values.error().text();
  EXPECT_EQ(values.value().at("name"), "a b \xC3\xA4+");
  EXPECT_EQ(values.value().at("crs"), "");
  EXPECT_TRUE(read_query("", {}).value().empty());
}

TEST(Query, WhatWouldBeIgnoredIsNamed) {
  const std::string long_value = "name=" + std::string(256, 'x');
  for (const auto& [query, named] :
       std::map<std::string, std::string>{{"nmae=x", "nmae"},
                                          {"name=x&format=kml", "format"},
                                          {"name=x&name=y", "name"},
                                          {"name=%zz", "name"},
                                          {"name=%4", "name"},
                                          {"name=%ff", "name"},
                                          {"name=%00", "name"},
                                          {"=x", ""},
                                          {"name", "is not known"},
                                          {long_value, "255"}}) {
    const auto values =
        read_query(query, query == "name" ? std::span<const std::string_view>() : kNames);
    ASSERT_FALSE(values) << query;
    EXPECT_NE(values.error().text().find(named), std::string::npos) << query;
    if (query == "name") continue;
    EXPECT_NE(values.error().text().find("Allowed: name, crs."), std::string::npos);
  }
  const auto answer = refused_query("%1b[2J=1", {});
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 400U);
  const std::string error = nlohmann::json::parse(*answer->body)["error"];
  EXPECT_EQ(error.find('\x1b'), std::string::npos) << error;
  EXPECT_NE(error.find("takes no parameters"), std::string::npos) << error;
  EXPECT_FALSE(refused_query("name=x", kNames));
}

}  // namespace
}  // namespace skein::serve::query_test
