// SPDX-License-Identifier: Apache-2.0
// Aircraft that ArduPilot's simulator flies, for real: where SKEIN_ARDUPLANE names it.
#include <cstdlib>

#include "app/test/program.h"

namespace skein::app {
namespace {

TEST_F(Program, ArduPilotFliesAPlantOfSkeinsAndTheRunIsDoneAgainWithoutIt) {
  const char* arduplane = std::getenv("SKEIN_ARDUPLANE");
  if (!arduplane) GTEST_SKIP() << "SKEIN_ARDUPLANE does not name a program arduplane";
  const fs::path scenario =
      fs::path(SKEIN_SOURCE_DIR) / "scenarios/mixed-ardupilot-physics.yaml";
  const Finished flown =
      run({"run", scenario.string(), "--out", "first", "--set",
           std::string("aircraft[0].vehicle.physics.program[0]=") + arduplane, "--set",
           "aircraft[0].vehicle.physics.instance=40", "--set",
           "aircraft[0].vehicle.endpoint='tcp:127.0.0.1:6160'"});
  ASSERT_EQ(flown.status, 0) << flown.err;
  const auto summary = nlohmann::json::parse(read_file(folder_ / "first/summary.json"));
  EXPECT_EQ(summary["accidents"], 0) << flown.err;
  // Seen: 11 m, nearly all of it where it joins the route after its take-off.
  EXPECT_LT(summary["cross_track_rms_m"], 20);
  EXPECT_LT(summary["min_charge"], 0.95) << "it has not flown";
  const Finished again = run({"run", "--replay", "first", "--out", "again"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("The same content hash"), std::string::npos) << again.err;
}

TEST_F(Program, AProgramThatIsNotThereEndsTheRunBeforeItBegins) {
  const fs::path scenario =
      fs::path(SKEIN_SOURCE_DIR) / "scenarios/mixed-ardupilot-physics.yaml";
  const Finished refused =
      run({"run", scenario.string(), "--out", "first", "--set",
           "aircraft[0].vehicle.physics.program[0]=/no/such/arduplane", "--set",
           "aircraft[0].vehicle.physics.port=0"});
  EXPECT_EQ(refused.status, 2);
  const Finished missing =
      run({"run", scenario.string(), "--out", "second", "--set",
           "aircraft[0].vehicle.physics.program[0]=/no/such/arduplane", "--set",
           "aircraft[0].vehicle.physics.port=19002"});
  EXPECT_EQ(missing.status, 2) << missing.err;
  EXPECT_NE(missing.err.find("/no/such/arduplane"), std::string::npos) << missing.err;
}

}  // namespace
}  // namespace skein::app
