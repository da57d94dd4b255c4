// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "skein/scenario/scenario_file.h"
#include "skein/scenario/test/fake_kinds.h"
#include "skein/scenario/test/reading.h"
#include "skein/scenario/text.h"
#include "skein/scenario/units.h"
#include "skein/scenario/utc.h"

namespace skein::scenario::test::description_test {
namespace {

TEST(Description, HasValidDefaults) {
  EXPECT_NO_THROW(check_defaults("scenario", *scenario_fields().description()));
}

TEST(Description, RefusesADefaultOutsideItsRange) {
  KindTable kinds;
  EXPECT_THROW(
      kinds.add("estimator", "bad", "",
                Fields<QkfOptions>().number("gain", &QkfOptions::gain, "", {.above = 1})),
      Bug);
  EXPECT_NO_THROW(kinds.add("estimator", "good", "",
                            Fields<QkfOptions>()
                                .number("gain", &QkfOptions::gain, "", {.above = 1})
                                .required()));
}

TEST(Description, RefusesKeysAndKindsDescribedTwice) {
  Fields<QkfOptions> fields;
  fields.number("gain", &QkfOptions::gain, "");
  EXPECT_THROW(fields.number("gain", &QkfOptions::gain, ""), Bug);
  KindTable kinds = fake_kinds();
  EXPECT_THROW(kinds.add("radio", "ideal", ""), Bug);
}

TEST(Description, NarrowsIntegersToTheirType) {
  struct Small {
    std::uint8_t value = 0;
  };
  KindTable kinds;
  kinds.add("radio", "ideal", "", Fields<Small>().integer("value", &Small::value, ""));
  const std::string schema = json_schema(kinds);
  EXPECT_NE(schema.find("\"maximum\": 255"), std::string::npos);
}

TEST(Description, LimitsListsOfStructs) {
  std::string many = "radio: {kind: joint, layers: [";
  for (int i = 0; i <= 10000; ++i) many += "{},";
  EXPECT_EQ(problems_of(many + "]}"),
            "test.yaml:1:30 radio.layers: 10001 elements; needs a list, at "
            "most 10000, each keys with values.\n");
}

TEST(Description, NamesTheLineOfAKindThatLacksARequiredKey) {
  KindTable kinds = fake_kinds();
  kinds.add("radio", "strict", "",
            Fields<QkfOptions>()
                .number("gain", &QkfOptions::gain, "", {.above = 0})
                .required());
  const ReadOutcome outcome =
      read_scenario_text("name: x\nradio: strict", "a.yaml", "/", kinds);
  ASSERT_EQ(outcome.problems.size(), 1u);
  EXPECT_EQ(outcome.problems[0].text(),
            "a.yaml:2:8 radio.gain: is missing; needs a number above 0.");
}

TEST(Schema, DescribesKeysRangesAndKinds) {
  const auto schema = nlohmann::json::parse(json_schema(fake_kinds()));
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema["additionalProperties"], false);
  const auto& step = schema["properties"]["step_s"];
  EXPECT_EQ(step["minimum"], 0.001);
  EXPECT_EQ(step["default"], 0.1);
  EXPECT_EQ(step["description"], "Time step of the simulation. [s]");
  const auto& group = schema["properties"]["aircraft"]["items"]["properties"];
  EXPECT_EQ(group["plant"]["$ref"], "#/$defs/kind-of-plant");
  EXPECT_EQ(group["failures"]["items"]["required"][0], "at_s");
  const auto& kinds = schema["$defs"]["kind-of-radio"]["oneOf"];
  ASSERT_EQ(kinds.size(), 6u);  // each by name alone and with keys
  EXPECT_EQ(kinds[0]["const"], "joint");
  EXPECT_EQ(kinds[1]["properties"]["airspeed_mps"]["exclusiveMinimum"], 0);
  EXPECT_EQ(kinds[3]["properties"]["kind"]["const"], "qkf");
}

TEST(Markdown, HasARowForEveryKey) {
  const std::string text = markdown_keys(fake_kinds());
  for (const char* row :
       {"| `step_s` | a number from 0.001 to 10 [s] | `0.1` | Time step of the simu",
        "### aircraft[].start\n", "| `sensors` | list of [sensor](#sensor) | `[gnss, ",
        "| `at_s` | a number from 0 to 4000000 [s] | required | When it happens. |\n",
        "#### radio: qkf\n", "| `colour` | red or green | `red` | A \\| B. |\n",
        "### joint.layers[]\n", "<br>`heun`: second order"}) {
    EXPECT_NE(text.find(row), std::string::npos) << row << "\n" << text;
  }
}

TEST(Text, EditDistanceCountsSwapsOnce) {
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("modle", "model"), 1);
  EXPECT_EQ(edit_distance("same", "same"), 0);
}

TEST(Text, FindsNoNameThatIsFarAway) {
  const std::vector<std::string> names = {"estimator", "strategy"};
  EXPECT_EQ(nearest_name("estmator", names), "estimator");
  EXPECT_EQ(nearest_name("colour", names), "");
  EXPECT_EQ(nearest_name("", names), "");
}

TEST(Text, FindsTheFirstByteThatIsNoText) {
  EXPECT_EQ(first_bad_byte("Z\xC3\xBCrich \xF0\x9F\x94\xA5\t\r\n"), std::nullopt);
  for (const char* bad :
       {"ab\x80", "ab\xC0\x80", "ab\xE0\x80\x80", "ab\xED\xA0\x80", "ab\xF4\x90\x80\x80",
        "ab\xF0\x9F\x94", "ab\xC3", "ab\x7F", "ab\x04"}) {
    EXPECT_EQ(first_bad_byte(bad), 2u) << bad;
  }
}

TEST(Units, AreTheLongestEndingOfAKey) {
  EXPECT_EQ(unit_of("rate_sd_mps")->symbol, "m/s");
  EXPECT_EQ(unit_of("area_m2")->symbol, "m^2");
  EXPECT_EQ(unit_of("yaw_rad_s")->symbol, "rad/s");
  EXPECT_EQ(unit_of("airspeed_mps")->symbol, "m/s");
  EXPECT_EQ(stem_of("airspeed_km_h"), "airspeed");
  EXPECT_FALSE(unit_of("m"));
  EXPECT_FALSE(unit_of("items"));
  EXPECT_FALSE(unit_of("control_points"));
}

TEST(Utc, KnowsTheCalendar) {
  EXPECT_EQ(parse_utc("1970-01-01T00:00:00Z"), 0);
  EXPECT_EQ(parse_utc("2024-02-29T23:59:59Z"), 1709251199);
  for (const char* bad :
       {"", "2023-02-29T00:00:00Z", "2024-01-01T24:00:00Z", "2024-01-01 00:00:00Z",
        "2024-01-01T00:00:00", "1969-12-31T00:00:00Z", "2024-1-01T00:00:000Z"}) {
    EXPECT_FALSE(parse_utc(bad)) << bad;
  }
}

}  // namespace
}  // namespace skein::scenario::test::description_test
