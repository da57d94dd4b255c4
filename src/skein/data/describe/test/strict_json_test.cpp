// SPDX-License-Identifier: Apache-2.0
#include "skein/data/describe/strict_json.h"

#include <gtest/gtest.h>

namespace skein::strict_json::strict_json_test {
namespace {

TEST(StrictJson, ReadsWhatIsWithinBounds) {
  Problems problems("f.json");
  const auto json = parse(R"({"a": 1.5, "b": [3, 4], "c": "word"})", problems);
  ASSERT_TRUE(json);
  const Value value(*json, "", problems);
  EXPECT_TRUE(value.is_object_of({"a", "b"}, {"c", "d"}));
  EXPECT_EQ(value.at("a").number(0, 2), 1.5);
  EXPECT_EQ(value.at("b").items(2)[1].integer(0, 9), 4);
  EXPECT_EQ(value.at("c").text(4), "word");
  EXPECT_FALSE(value.has("d"));
  EXPECT_FALSE(problems.any());
}

TEST(StrictJson, CollectsProblemsWithTheirPlaces) {
  Problems problems("f.json");
  const auto json =
      parse(R"({"a": "x", "b": 18446744073709551615, "c": "\u0007"})", problems);
  ASSERT_TRUE(json);
  const Value value(*json, "", problems);
  EXPECT_FALSE(value.is_object_of({"a", "d"}, {"b"}));
  (void)value.at("a").number(0, 1);
  (void)value.at("b").integer(-5, 5);
  (void)value.at("c").text(9);
  (void)value.at("a").items(9);
  const std::string text = problems.error().text();
  for (const char* part :
       {"lacks the key \"d\"", "unknown key \"c\"", ": a: must be a number from 0 to 1",
        ": b: must be an integer from -5 to 5", ": c: must be a text", "must be a list"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

TEST(StrictJson, RefusesKeysGivenTwiceAndWhatIsNoJson) {
  for (const char* text : {R"({"a": 1, "a": 2})", R"([{"a": {"b": 1, "b": 1}}])", "", "{",
                           "nan", "\xff", "[1,]"}) {
    Problems problems("f.json");
    EXPECT_FALSE(parse(text, problems)) << text;
    EXPECT_TRUE(problems.any()) << text;
  }
  // The same key in two objects is none given twice.
  Problems problems("f.json");
  EXPECT_TRUE(parse(R"([{"a": 1}, {"a": {"a": 2}}])", problems));
  EXPECT_FALSE(problems.any());
  EXPECT_FALSE(parse(std::string(100'000, '[') + std::string(100'000, ']'), problems));
  EXPECT_NE(problems.error().text().find("nests more than 64 deep"), std::string::npos);
}

TEST(StrictJson, FieldsTakeWhatIsThereAndNameWhatIsNot) {
  Problems problems("f.json");
  const auto json = parse(
      R"({"n": 2, "w": 3.5, "on": true, "word": "b", "list": [1, 2], "of": {"z": 1, "a": 2},
          "more": 1, "flag": "yes"})",
      problems);
  ASSERT_TRUE(json);
  {
    Fields fields(Value(*json, "", problems));
    EXPECT_EQ(fields.number("n", 0, 9), 2);
    EXPECT_EQ(fields.number("not there", 0, 9, 7.0), 7);
    EXPECT_TRUE(fields.flag("on", false));
    EXPECT_EQ(fields.word("word", {"a", "b"}), 1U);
    EXPECT_EQ(fields.items("list", 5).size(), 2U);
    const auto members = fields.members("of", 5);
    ASSERT_EQ(members.size(), 2U);
    EXPECT_EQ(members[0].first, "z") << "in the order of the text";
    EXPECT_FALSE(problems.any());
    EXPECT_EQ(fields.whole("w", 1, 9), 1);
    EXPECT_EQ(fields.text("missing"), "");
    EXPECT_FALSE(fields.flag("flag", false));
  }
  const std::string text = problems.error().text();
  for (const char* part :
       {"w: must be an integer from 1 to 9", "missing: is missing", "flag: must be true",
        "more: unknown key. Allowed: n, not there, on"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

TEST(StrictJson, CountsWhatItDoesNotShow) {
  Problems problems("f.json");
  for (int k = 0; k < 25; ++k) problems.add("[1]", "is wrong.");
  EXPECT_TRUE(problems.full());
  EXPECT_NE(problems.error().text().find("And 5 more problems"), std::string::npos);
}

}  // namespace
}  // namespace skein::strict_json::strict_json_test
