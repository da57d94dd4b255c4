// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/traffic/detection_tables.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

namespace skein::exchange::detection_tables_test {
namespace {

std::string reference_file(const std::string& name) {
  std::ifstream in(SKEIN_SHARED_DATA "/team/detect/" + name);
  return {std::istreambuf_iterator<char>(in), {}};
}

Encounter head_on() {
  Encounter e;
  e.name = "h";
  e.own = {Vec3(0, 0, -200), Vec3(20, 0, 0)};
  e.numbers = {7};
  e.intruders = {{{Vec3(2000, 0, -200), Vec3(-20, 0, 0)}, 0, 0, 0}};
  return e;
}

TEST(DetectionTables, AnswersAHeadOnEncounter) {
  DetectionTables tables(*model::well_clear_configuration("skein_suas"));
  std::string alerts;
  tables.add_alerts(head_on(), alerts);
  // 609.6 m around the intruder are 34.76 s away and 30.48 s wide.
  EXPECT_TRUE(alerts.starts_with("h,7,2,34.760000,65.240000,34.760000,65.240000,34.7600"))
      << alerts;
  std::string bands, guidance;
  tables.add_bands(head_on(), bands, guidance);
  EXPECT_EQ(bands.find("nan"), std::string::npos);
  EXPECT_NE(bands.find("h,track_deg,0.000000,"), std::string::npos);
  EXPECT_NE(guidance.find("h,track_deg,"), std::string::npos);
}

TEST(DetectionTables, TimelinesEndWhenAskedTo) {
  DetectionTables tables(*model::well_clear_configuration("skein_suas"));
  EXPECT_EQ(tables.usual_timeline(), 100);
  std::string out;
  tables.add_timeline(head_on(), 100, out);
  // 20 s before the volume is entered at 34.76 s, and when two answers had it; left at
  // 65.24 s, and when only one of the last four was within.
  EXPECT_EQ(out, "h,0,2\nh,16,3\nh,68,0\nh,100,0\n");
  out.clear();
  tables.add_timeline(head_on(), 20, out);
  EXPECT_EQ(out, "h,0,2\nh,16,3\nh,20,3\n");
}

TEST(DetectionTables, TimelinesAreThoseOfTheReferenceDataLineByLine) {
  const std::string theirs = reference_file("suas_timeline.csv");
  if (theirs.empty()) GTEST_SKIP() << "without ../shared/data/team/detect";
  const auto configuration = *model::well_clear_configuration("skein_suas");
  const auto encounters = read_encounters(reference_file("suas_encounters.csv"),
                                          "suas_encounters.csv", configuration);
  ASSERT_TRUE(encounters.ok()) << encounters.error().text();
  const DetectionTables tables(configuration);
  std::string mine = DetectionTables::timeline_header();
  for (const Encounter& encounter : encounters.value())
    if (theirs.find("\n" + encounter.name + ",") != std::string::npos)
      tables.add_timeline(encounter, tables.usual_timeline(), mine);
  EXPECT_EQ(mine, theirs);
}

}  // namespace
}  // namespace skein::exchange::detection_tables_test
