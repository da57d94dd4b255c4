#include "skein/assemble/modem_setup.h"

#include <gtest/gtest.h>

#include "skein/assemble/build.h"
#include "skein/assemble/kinds_of.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble {
namespace {

scenario::ReadOutcome read_pair(const std::string& modem, const std::string& vehicle) {
  return scenario::read_scenario_text(
      "duration_s: 10\naircraft: [{name: real, vehicle: " + vehicle +
          "}, {name: other}]\nradio: {kind: medium, modem: {" + modem + "}}\n",
      "test", ".", kind_table());
}

Result<Build> built(const std::string& modem, const std::string& vehicle) {
  const auto read = read_pair(modem, vehicle);
  EXPECT_TRUE(read.ok()) << read.report();
  if (!read.ok()) return Error{};
  return build(*read.scenario, KindRegistry());
}

TEST(ModemSetup, KnowsWhoIsBeyondTheModem) {
  const auto made = built("entities: [real-1]", "{kind: remote, listen: 'udpin:0'}");
  ASSERT_TRUE(made.ok()) << made.error().text();
  ASSERT_TRUE(made.value().modem);
  EXPECT_FALSE(made.value().modem->is_beyond(EntityId{0}));
  EXPECT_TRUE(made.value().modem->is_beyond(EntityId{1}));
  EXPECT_FALSE(made.value().modem->is_beyond(EntityId{2}));
}

TEST(ModemSetup, RefusesWhoHasNoModem) {
  const auto simulated = built("entities: [real-1]", "simulated");
  ASSERT_FALSE(simulated.ok());
  EXPECT_NE(simulated.error().text().find("remote"), std::string::npos);
  const auto nobody = built("entities: [real-1, real-7]", "{kind: remote}");
  ASSERT_FALSE(nobody.ok());
  EXPECT_NE(nobody.error().text().find("real-7"), std::string::npos);
  EXPECT_FALSE(read_pair("entities: []", "{kind: remote}").ok());
  EXPECT_FALSE(read_pair("entities: [real-1], endpoint: 'udpin'", "{kind: remote}").ok());
}

}  // namespace
}  // namespace skein::assemble
