// SPDX-License-Identifier: Apache-2.0
// Attackers and authentication of a run's radio, as scenarios describe them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/world/build.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::radio_security_test {
namespace {

namespace fs = std::filesystem;

// Of a scenario with this radio: what is wrong with it; empty: nothing.
std::string error_of(const std::string& radio) {
  const std::string text =
      "duration_s: 10\nenvironment: {phenomena: []}\naircraft: [{count: 2}]\nmissions: "
      "[]\nradio: {kind: medium, " +
      radio + "}\n";
  const auto read = scenario::read_scenario_text(text, "test", ".", kind_table());
  if (!read.ok()) return read.report();
  const auto made = build(*read.scenario, KindRegistry());
  return made.ok() ? "" : made.error().text();
}

std::string attack(const std::string& what) {
  return "attacks: [{position_m: [0, 0], " + what + "}]";
}

void expect_error(const std::string& radio, const std::string& key,
                  const std::string& wrong) {
  const std::string error = error_of(radio);
  EXPECT_NE(error.find(key), std::string::npos) << radio << ": " << error;
  EXPECT_NE(error.find(wrong), std::string::npos) << radio << ": " << error;
}

fs::path key_file(const std::string& content, fs::perms permissions) {
  const fs::path file = fs::path(testing::TempDir()) / "radio_security_test.key";
  std::ofstream(file, std::ios::binary) << content;
  fs::permissions(file, permissions);
  return file;
}

constexpr auto kOwner = fs::perms::owner_read | fs::perms::owner_write;

TEST(RadioSecurity, TakesAttacksOfAllKinds) {
  for (const char* what :
       {"jammer: {}", "power_dbm: -3, jammer: {}",
        "until_s: 5, jammer: {duty: 0.2, period_s: 3}",
        "flooder: {bytes: 100, rate_hz: 5, to: scout-1}", "flooder: {}",
        "spoofer: {as: station, to: scout-2, content: return-home}",
        "spoofer: {as: scout-1, to: station, offset_m: [500, 0]}",
        "replayer: {delay_s: 3, of: station}", "replayer: {}"})
    EXPECT_EQ(error_of(attack(what)), "") << what;
}

TEST(RadioSecurity, SaysWhatIsWrongWithAttacks) {
  expect_error(attack("spoofer: {as: nobody, to: station}"),
               "radio.attacks[0].spoofer.as", "no entity \"nobody\"");
  expect_error(attack("spoofer: {as: station, to: scout-3}"),
               "radio.attacks[0].spoofer.to", "no entity \"scout-3\"");
  expect_error(attack("spoofer: {as: station, to: station}"),
               "radio.attacks[0].spoofer.to", "another entity");
  expect_error(attack("replayer: {of: x}"), "radio.attacks[0].replayer.of", "no entity");
  expect_error(attack("flooder: {to: x}"), "radio.attacks[0].flooder.to", "no entity");
  expect_error(attack("flooder: {bytes: 5000}"), "radio.attacks[0].flooder.bytes",
               "more than the 1500");
  expect_error(attack("power_dbm: -101, jammer: {}"), "power_dbm", "-101");
  expect_error(attack("at_s: 20, until_s: 10, jammer: {}"), "until_s", "later than at_s");
  expect_error(attack("jammer: {duty: 0}"), "duty", "0");
  expect_error(attack("at_s: 20"), "jammer", "none is given");
  expect_error(attack("jammer: {}, replayer: {}"), "jammer", "several are given");
  expect_error("profile: lte, " + attack("jammer: {}"), "radio.attacks[0].jammer",
               "share no medium");
  expect_error("profile: lte, " + attack("replayer: {}"), "radio.attacks[0].replayer",
               "share no medium");
}

TEST(RadioSecurity, TakesKeysThatNobodyElseCanRead) {
  const auto with_key = [](const std::string& content, fs::perms permissions) {
    return "authentication: {key_file: " + key_file(content, permissions).string() + "}";
  };
  EXPECT_EQ(error_of(with_key(std::string(32, 'k'), kOwner)), "");
  EXPECT_EQ(error_of(with_key(std::string(64, 'a'), kOwner)), "");
  const std::string key = "radio.authentication.key_file";
  expect_error(with_key(std::string(32, 'k'), kOwner | fs::perms::group_read), key,
               "others can read");
  expect_error(with_key(std::string(31, 'k'), kOwner), key, "no key in this file");
  expect_error(with_key(std::string(66, 'a'), kOwner), key, "no key in this file");
  expect_error("authentication: {key_file: no-such.key}", "key_file", "no-such.key");
  expect_error("authentication: {}", "key_file", "");
}

}  // namespace
}  // namespace skein::assemble::radio_security_test
