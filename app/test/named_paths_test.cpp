// SPDX-License-Identifier: Apache-2.0
// Files that a scenario or a campaign names are looked for beside it, whatever the
// working folder is.
#include "app/test/program.h"

namespace skein::app {
namespace {

class NamedPaths : public Program {
 protected:
  NamedPaths() {
    for (const char* name : {"mine", "elsewhere"}) fs::create_directories(folder_ / name);
    fs::copy_file(SKEIN_SOURCE_DIR "/aircraft/bixler.yaml", folder_ / "mine/own.yaml");
    fs::copy_file(SKEIN_SOURCE_DIR "/radios/nn8.yaml", folder_ / "mine/radio.yaml");
  }
  static std::string flying(const std::string& aircraft) {
    return "duration_s: 2\naircraft: [{count: 1, plant: {kind: fixed-wing, aircraft: " +
           aircraft + "}, autopilot: skein, sensors: [flight]}]\nmissions: []\n";
  }
};

TEST_F(NamedPaths, AircraftAndRadiosAreBesideTheScenario) {
  write("mine/s.yaml",
        flying("own.yaml") + "radio: {kind: medium, profile: radio.yaml}\n");
  const Finished good = run({"check", "mine/s.yaml"});
  EXPECT_EQ(good.status, 0) << good.err;
  // The run's own scenario finds them too, from anywhere.
  const Finished flown = run({"run", "mine/s.yaml", "--out", "elsewhere/run"});
  ASSERT_EQ(flown.status, 0) << flown.err;
  const Finished again = run({"run", "--replay", "elsewhere/run", "--out", "again"});
  EXPECT_EQ(again.status, 0) << again.err;
}

TEST_F(NamedPaths, GivenInputIsFound) {
  const fs::path given = SKEIN_SHARED_DATA "/borders/aircraft-relative/s.yaml";
  if (!fs::exists(given)) GTEST_SKIP() << given << " is missing";
  const Finished good = run({"check", given.string()});
  EXPECT_EQ(good.status, 0) << good.err;
}

TEST_F(NamedPaths, WhatIsInTheWorkingFolderAloneIsRefusedWithTheEdit) {
  fs::copy_file(folder_ / "mine/own.yaml", folder_ / "other.yaml");
  fs::copy_file(folder_ / "mine/radio.yaml", folder_ / "other-radio.yaml");
  const std::string here = fs::canonical(folder_).string();
  for (const auto& [text, file] :
       {std::pair(flying("other.yaml"), "other.yaml"),
        std::pair(std::string("radio: {kind: medium, profile: other-radio.yaml}\n"),
                  "other-radio.yaml"),
        std::pair(std::string("radio: {kind: medium, file: other-radio.yaml}\n"),
                  "other-radio.yaml"),
        std::pair(std::string("commands: [{at_s: 1, do: task uav-1 plan file "
                              "other.yaml}]\n"),
                  "other.yaml")}) {
    write("mine/s.yaml", text);
    const Finished refused = run({"check", "mine/s.yaml"});
    EXPECT_EQ(refused.status, 2) << text;
    for (const std::string& part :
         {here + "/mine/" + file, here + "/" + file, "Write \"../" + std::string(file)})
      EXPECT_NE(refused.err.find(part), std::string::npos) << part << "\n" << refused.err;
  }
}

TEST_F(NamedPaths, ShippedOnesAreTakenByNameWhateverFilesThereAre) {
  write("mine/bixler", "no aircraft");
  write("mine/bixler.yaml", "no aircraft");
  write("bixler", "no aircraft");
  write("mine/s.yaml", flying("bixler"));
  const Finished shipped = run({"check", "mine/s.yaml"});
  EXPECT_EQ(shipped.status, 0) << shipped.err;
  write("mine/s.yaml", flying("bixler.yaml"));
  EXPECT_EQ(run({"check", "mine/s.yaml"}).status, 2) << "the file is asked for";
}

TEST_F(NamedPaths, TheCommandLineStartsInTheWorkingFolder) {
  fs::copy_file(folder_ / "mine/own.yaml", folder_ / "elsewhere/other.yaml");
  write("mine/s.yaml", flying("bixler"));
  const Finished good = run({"check", "mine/s.yaml", "--set",
                             "aircraft[0].plant.aircraft=elsewhere/other.yaml"});
  EXPECT_EQ(good.status, 0) << good.err;
}

TEST_F(NamedPaths, ChangesOfACampaignAreBesideIt) {
  write("elsewhere/s.yaml", flying("bixler"));
  const auto campaign = [&](const std::string& aircraft) {
    write("mine/campaign.yaml",
          "name: own\nscenario: ../elsewhere/s.yaml\nseeds: 1\n"
          "set: [\"aircraft[0].plant.aircraft=" +
              aircraft + "\"]\nfigures: [{figure: simulated_s}]\n");
    return run({"campaign", "mine/campaign.yaml", "--out", "out"});
  };
  const Finished good = campaign("own.yaml");
  EXPECT_EQ(good.status, 0) << good.err;
  fs::copy_file(folder_ / "mine/own.yaml", folder_ / "other.yaml");
  EXPECT_EQ(campaign("other.yaml").status, 2);
}

}  // namespace
}  // namespace skein::app
