// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/tuning_gains.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/world/build.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::tuning_gains_test {
namespace {

namespace fs = std::filesystem;

scenario::ReadOutcome read_with(const std::vector<std::string>& changes) {
  std::vector<scenario::Override> overrides;
  for (const std::string& text : changes) overrides.push_back({text});
  return scenario::read_scenario(fs::path(SKEIN_SOURCE_DIR) / "scenarios/tuning.yaml",
                                 kind_table(), overrides);
}

autopilot::LapGains gains_with(const std::vector<std::string>& changes) {
  const auto read = read_with(changes);
  EXPECT_TRUE(read.ok()) << read.report();
  const auto gains = tuning_gains_of(*read.scenario);
  EXPECT_TRUE(gains.ok());
  return gains.value();
}

class GainsFile : public testing::Test {
 protected:
  GainsFile() {
    std::string pattern = (fs::temp_directory_path() / "gains-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~GainsFile() override { fs::remove_all(folder_); }
  Result<autopilot::LapGains> read(const std::string& text,
                                   const autopilot::LapGains& base) {
    std::ofstream(folder_ / "gains.yaml") << text;
    return read_tuning_gains(folder_ / "gains.yaml", base);
  }
  fs::path folder_;
};

TEST(TuningGains, AreTheScenariosThenTheAircraftsThenTheAutopilots) {
  const autopilot::FixedWingGains own;
  EXPECT_EQ(gains_with({"aircraft[0].autopilot.lateral.l2_time_s=1.75"}).lateral.l2.time,
            1.75);
  const auto filed = gains_with({"aircraft[0].plant.aircraft=light-sport"});
  const auto said =
      gains_with({"aircraft[0].plant.aircraft=light-sport",
                  "aircraft[0].autopilot.wing_gains={roll_gain_per_s: 2.25}"});
  EXPECT_EQ(said.wing.roll_gain, 2.25);
  EXPECT_EQ(said.wing.height_gain, own.height_gain) << "of the autopilot";
  const auto file = gains_of(
      read_with({"aircraft[0].plant.aircraft=light-sport"}).scenario->aircraft[0].plant);
  const autopilot::FixedWingGains expected = file.wing.value_or(own);
  EXPECT_EQ(filed.wing.roll_gain, expected.roll_gain);
  EXPECT_EQ(filed.wing.height_gain, expected.height_gain);
}

TEST(TuningGains, NeedAFixedWingAndTheAutopilotSkein) {
  for (const char* change :
       {"aircraft[0].plant=kinematic", "aircraft[0].autopilot=path"}) {
    const auto read = read_with({change});
    ASSERT_TRUE(read.ok()) << read.report();
    EXPECT_FALSE(tuning_gains_of(*read.scenario).ok()) << change;
  }
}

TEST_F(GainsFile, KeepsWhatItDoesNotSayAndComesBackAsItWasWritten) {
  const auto base = gains_with({});
  const auto some = read("lateral: {law: l1, l1_period_s: 7.5}\n", base);
  ASSERT_TRUE(some.ok()) << some.error().text();
  EXPECT_EQ(some.value().lateral.law, autopilot::LateralLaw::kL1);
  EXPECT_EQ(some.value().lateral.l1.period, 7.5);
  EXPECT_EQ(some.value().wing.roll_gain, base.wing.roll_gain);

  autopilot::LapGains changed = quickened(base, 1.3);
  for (const TuningKnob& knob : tuning_knobs(changed))
    knob.set(changed, knob.get(changed) * 1.25);
  const auto back = read(write_tuning_gains(changed), base);
  ASSERT_TRUE(back.ok()) << back.error().text();
  EXPECT_EQ(write_tuning_gains(back.value()), write_tuning_gains(changed));
  for (const TuningKnob& knob : tuning_knobs(changed))
    EXPECT_EQ(knob.get(back.value()), knob.get(changed)) << knob.key;
}

TEST_F(GainsFile, SaysWhereItIsWrong) {
  const auto bad = read("lateral:\n  l2_time_s: 0\n", gains_with({}));
  ASSERT_FALSE(bad.ok());
  EXPECT_NE(bad.error().text().find("gains.yaml:2"), std::string::npos)
      << bad.error().text();
}

TEST_F(GainsFile, KnobsAreKeysOfTheFileAndOfTheLawThatIsFlown) {
  const auto base = gains_with({});
  for (const auto law : {autopilot::LateralLaw::kCourse, autopilot::LateralLaw::kL1,
                         autopilot::LateralLaw::kL2Plus}) {
    autopilot::LapGains gains = base;
    gains.lateral.law = law;
    for (const TuningKnob& knob : tuning_knobs(gains)) {
      const std::string key = knob.key;
      const auto dot = key.find('.');
      const auto said =
          read(key.substr(0, dot) + ": {" + key.substr(dot + 1) + ": 1.5}\n", gains);
      ASSERT_TRUE(said.ok()) << said.error().text();
      EXPECT_EQ(knob.get(said.value()), 1.5) << key;
      EXPECT_NE(knob.get(gains), 1.5) << key;
      EXPECT_GT(knob.get(gains), 0) << key;
    }
    EXPECT_EQ(tuning_knobs(gains).size(), 8u);
  }
}

TEST(LapGains, TheTextOfAnEntryIsReadAsTheSameGains) {
  const auto quick = quickened(gains_with({}), 1.6);
  const auto read =
      read_with({"aircraft[0].autopilot.lap_gains=[" + lap_gains_text(quick) + "]"});
  ASSERT_TRUE(read.ok()) << read.report();
  EXPECT_TRUE(build(*read.scenario, KindRegistry()).ok());
  const std::string written = scenario::write_scenario(*read.scenario, kind_table());
  EXPECT_NE(written.find("lap_gains"), std::string::npos);
}

TEST(LapGains, AreForFixedWingsOnly) {
  const auto read = read_with({"aircraft[0].plant={kind: multirotor, aircraft: quad}",
                               "aircraft[0].autopilot.lap_gains=[{lateral: {}}]"});
  ASSERT_TRUE(read.ok()) << read.report();
  const auto built = build(*read.scenario, KindRegistry());
  ASSERT_FALSE(built.ok());
  EXPECT_NE(built.error().text().find("lap_gains"), std::string::npos)
      << built.error().text();
}

}  // namespace
}  // namespace skein::assemble::tuning_gains_test
