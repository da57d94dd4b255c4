// SPDX-License-Identifier: Apache-2.0
#include "app/test/program.h"

namespace skein::app {
namespace {

constexpr const char* kFire =
    "name: fire\n"
    "duration_s: 500\n"
    "start_utc: 2026-08-01T10:00:00Z\n"
    "environment:\n"
    "  terrain: flat\n"
    "  wind: {kind: uniform, speed_mps: 3, from_deg: 250}\n"
    "  phenomena: [{kind: front, rate_mps: 0.06, age_s: 2000}]\n"
    "  zones: [{name: field, centre_m: [900, 300], radius_m: 80}]\n"
    "aircraft: [{count: 2, start: {distance_m: 600}}]\n"
    "missions:\n"
    "  - kind: perimeter\n"
    "    prior: {radius_m: 150, radius_sd_m: 60, rate_mps: 0.05, rate_sd_mps: 0.03}\n"
    "    forecast: {horizons_s: [120, 600], period_s: 120}\n";

nlohmann::json features(const std::string& text) {
  return nlohmann::json::parse(text)["features"];
}

TEST_F(Program, ExportsWhatARunKnowsForAMap) {
  const auto scenario = write("fire.yaml", kFire);
  const Finished flown = run({"run", scenario.string(), "--out", "r"});
  ASSERT_EQ(flown.status, 0) << flown.err;
  const auto exported = [&](const std::string& what) {
    const Finished done =
        run({"export", "r", "--what", what, "--at", "400", "--out", what + ".geojson"});
    EXPECT_EQ(done.status, 0) << done.err;
    return features(read_file(folder_ / (what + ".geojson")));
  };
  const auto perimeter = exported("perimeter");
  ASSERT_EQ(perimeter.size(), 1u);
  EXPECT_EQ(perimeter[0]["properties"]["time_utc"], "2026-08-01T10:06:40Z");
  EXPECT_GT(double(perimeter[0]["properties"]["area_ha"]), 1);
  // What burns more surely is smaller.
  double area = 0;
  const auto bands = exported("bands");
  ASSERT_EQ(bands.size(), 5u);
  for (const auto& band : bands) {
    EXPECT_GT(double(band["properties"]["area_ha"]), area);
    area = band["properties"]["area_ha"];
  }
  // Two horizons with three areas each, of the newest forecast.
  const auto prediction = exported("prediction");
  ASSERT_EQ(prediction.size(), 6u);
  EXPECT_EQ(prediction[0]["properties"]["ahead_min"], 2);
  EXPECT_EQ(prediction[5]["properties"]["ahead_min"], 10);
  EXPECT_EQ(prediction[0]["properties"]["made_utc"],
            prediction[5]["properties"]["made_utc"]);
  EXPECT_EQ(exported("tracks").size(), 2u);
  const auto zones = exported("zones");
  ASSERT_EQ(zones.size(), 1u);
  EXPECT_EQ(zones[0]["properties"]["name"], "field");
  EXPECT_TRUE(zones[0]["properties"]["ceiling_m"].is_null()) << "no limit";

  const Finished early =
      run({"export", "r", "--what", "prediction", "--at", "0", "--out", "e.kml"});
  EXPECT_EQ(early.status, 2);
  EXPECT_NE(early.err.find("has no prediction at 0 s"), std::string::npos) << early.err;
  EXPECT_EQ(run({"export", "none", "--what", "zones", "--out", "e.kml"}).status, 2);
  EXPECT_EQ(run({"export", "r", "--what", "zones", "--out", "e.pdf"}).status, 2);
  // Of a run that has ended a file is written once, however often it were to be renewed.
  const Finished renewed =
      run({"export", "r", "--what", "perimeter", "--out", "p.shp", "--every", "60"});
  EXPECT_EQ(renewed.status, 0) << renewed.err;
  EXPECT_TRUE(fs::exists(folder_ / "p.dbf"));
}

TEST_F(Program, ExportRefusesTimesThatAreNone) {
  write("s.yaml", "duration_s: 2\naircraft: [{count: 1}]\n");
  ASSERT_EQ(run({"run", "s.yaml", "--out", "r"}).status, 0);
  for (const char* at : {"nan", "1e10", "-1", "inf"}) {
    const Finished done =
        run({"export", "r", "--what", "tracks", "--at", at, "--out", "t.geojson"});
    EXPECT_EQ(done.status, 2) << at;
    EXPECT_NE(done.err.find("a number from 0 to 4e+06"), std::string::npos) << done.err;
  }
}

}  // namespace
}  // namespace skein::app
