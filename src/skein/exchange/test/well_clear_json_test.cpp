// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/traffic/well_clear_json.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace skein::exchange::well_clear_json_test {
namespace {

using Json = nlohmann::ordered_json;

Json suas() {
  return Json::parse(to_json(*model::well_clear_configuration("skein_suas")));
}

std::string refusal(const Json& json) {
  const auto read = well_clear_configuration_from_json(json.dump(), "mine.json");
  return read ? std::string("accepted") : read.error().text();
}

void expect_refused(const Json& json, const std::string& part) {
  EXPECT_NE(refusal(json).find(part), std::string::npos) << refusal(json);
}

TEST(WellClearJson, BuiltInConfigurationsAreThoseOfTheReferenceData) {
  std::ifstream in(SKEIN_SHARED_DATA "/team/detect/configurations.json");
  if (!in) GTEST_SKIP() << "without ../shared/data/team/detect";
  for (const Json& each : Json::parse(in)) {
    const auto read = well_clear_configuration_from_json(each.dump(), "reference");
    ASSERT_TRUE(read.ok()) << read.error().text();
    const auto built_in =
        model::well_clear_configuration(each.at("name").get<std::string>());
    ASSERT_TRUE(built_in.has_value());
    // The last bits of numbers differ: knots, feet and degrees are turned into SI.
    Json theirs = Json::parse(to_json(read.value())).flatten();
    Json mine = Json::parse(to_json(*built_in)).flatten();
    ASSERT_EQ(theirs.size(), mine.size());
    for (const auto& item : theirs.items()) {
      if (!item.value().is_number()) {
        EXPECT_EQ(mine.at(item.key()), item.value()) << item.key();
        continue;
      }
      const double value = item.value().get<double>();
      EXPECT_NEAR(mine.at(item.key()).get<double>(), value, 1e-9 * (1 + std::abs(value)))
          << item.key();
    }
  }
}

TEST(WellClearJson, WhatIsWrittenReadsAsTheSame) {
  for (const char* name : {"DO_365B_no_SUM", "skein_suas"}) {
    const auto configuration = *model::well_clear_configuration(name);
    const auto read =
        well_clear_configuration_from_json(to_json(configuration), "written");
    ASSERT_TRUE(read.ok()) << read.error().text();
    EXPECT_EQ(to_json(read.value()), to_json(configuration));
  }
}

TEST(WellClearJson, EveryKeyIsNeededAndNoOtherIsTaken) {
  const Json good = suas();
  EXPECT_EQ(refusal(good), "accepted");
  for (const auto& item : good.items()) {
    Json without = good;
    without.erase(item.key());
    expect_refused(without, "mine.json: " + item.key() + ": is missing.");
    if (!item.value().is_object()) continue;
    for (const auto& inner : item.value().items()) {
      if (item.key() == "alerters") continue;
      Json less = good;
      less[item.key()].erase(inner.key());
      expect_refused(less, item.key() + "." + inner.key() + ": is missing.");
    }
    Json more = good;
    if (item.key() == "alerters") continue;
    more[item.key()]["colour"] = 1;
    expect_refused(more, item.key() + ".colour: unknown key. Allowed: ");
  }
  Json more = good;
  more["lookahead"] = 90;
  expect_refused(more, "lookahead: unknown key.");
  more = good;
  more["alerters"]["1"][1]["DTHR"] = 90;
  expect_refused(more, "alerters.1[1].DTHR: unknown key.");
  more = good;
  more["source"] = "a note";
  EXPECT_EQ(refusal(more), "accepted");
}

TEST(WellClearJson, NamesWhatIsOfAnotherTypeOrTwice) {
  Json json = suas();
  json["track"]["step_deg"] = "one";
  expect_refused(json, "track.step_deg: must be a number from");
  json = suas();
  json["alt"] = 3;
  expect_refused(json, "alt: must be an object.");
  json = suas();
  json["hysteresis"]["m"] = 1.5;
  expect_refused(json, "hysteresis.m: must be an integer from");
  json = suas();
  json["alerters"]["1"] = Json::object();
  expect_refused(json, "alerters.1: must be a list");
  json = suas();
  json["corrective"] = "SOON";
  expect_refused(json, "corrective: must be one of: NONE");
  std::string text = suas().dump();
  text.insert(1, "\"name\":\"again\",");
  const auto twice = well_clear_configuration_from_json(text, "mine.json");
  ASSERT_FALSE(twice.ok());
  EXPECT_NE(twice.error().text().find("the key \"name\" stands twice in an object."),
            std::string::npos);
  for (const char* bad : {"", "[", "[]", "7", "{\"name\":"})
    EXPECT_FALSE(well_clear_configuration_from_json(bad, "mine.json").ok()) << bad;
}

TEST(WellClearJson, NamesValuesThatAreImpossible) {
  const auto with = [](const char* group, const char* key, double value) {
    Json json = suas();
    json[group][key] = value;
    return json;
  };
  expect_refused(with("speed", "accel_mps2", 0), "speed.accel_mps2: 0 must be above 0.");
  expect_refused(with("speed", "max_mps", 5), "speed.max_mps: 5 must be above");
  expect_refused(with("alt", "step_m", 1e-5), "alt.step_m: 1e-05 must be at least");
  expect_refused(with("track", "step_deg", 90), "track.step_deg: 90 must be from");
  expect_refused(with("recovery", "ca_factor", 1), "recovery.ca_factor: 1 must be");
  expect_refused(with("recovery", "horizontal_m", 100), "at least nmac_horizontal_m");
  expect_refused(with("hysteresis", "n", 100), "hysteresis.n: 100 must be from 1 to 16.");
  expect_refused(with("hysteresis", "m", 5), "hysteresis.m: 5 must be from 1 to n, 4.");
  Json json = suas();
  json["alerters"]["1"][1]["alerting_time_s"] = 300;
  expect_refused(json,
                 "alerters.1[1].alerting_time_s: 300 must be from 0 to lookahead_s");
  json = suas();
  json["alerters"]["1"][2]["region"] = "MID";
  expect_refused(json, "MID comes after MID; regions must rise");
  json = suas();
  json["corrective"] = "FAR";
  expect_refused(json, "alerters.1: has no level of the corrective region, FAR.");
  json = suas();
  json["alerters"] = Json::object();
  expect_refused(json, "alerters: must have one alerter at least.");
}

}  // namespace
}  // namespace skein::exchange::well_clear_json_test
