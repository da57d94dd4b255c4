// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/kinds/modem_setup.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/world/build.h"
#include "skein/scenario/scenario_file.h"

namespace skein::assemble::modem_setup_test {
namespace {

scenario::ReadOutcome read_pair(const std::string& modem, const std::string& vehicle,
                                const std::string& more = "") {
  return scenario::read_scenario_text(
      "duration_s: 10\naircraft: [{name: real, vehicle: " + vehicle +
          "}, {name: other}]\nradio: {kind: medium, modem: {" + modem + "}" + more +
          "}\n",
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

TEST(ModemSetup, RefusesTwoModemsWithOneAddress) {
  const auto world = built("entities: [real-1], hw: 2", "{kind: remote}");
  ASSERT_FALSE(world.ok());
  EXPECT_NE(world.error().text().find("real-1"), std::string::npos);
  const auto read = read_pair("entities: [real-1], hw: 7", "{kind: remote}");
  ASSERT_TRUE(read.ok()) << read.report();
  const auto place = transport::parse_endpoint("udpout:127.0.0.1:9").value();
  const auto agent = make_agent_modem(*read.scenario, EntityId{1}, {place, 7});
  ASSERT_FALSE(agent.ok());
  EXPECT_EQ(agent.error().place, "--hw");
}

TEST(ModemSetup, TakesWhatASerialLineCarries) {
  const std::string modem = "entities: [real-1], endpoint: 'serial:/dev/ttyS9:9600'";
  EXPECT_NE(read_pair(modem, "{kind: remote}").report().find("7680"), std::string::npos);
  EXPECT_TRUE(read_pair(modem + ", pacing: false", "{kind: remote}").ok());
  const auto read = read_pair(modem + ", rate_bps: 7000", "{kind: remote}");
  ASSERT_TRUE(read.ok()) << read.report();
  const auto line = transport::parse_endpoint("serial:/dev/ttyS9:9600").value();
  const auto agent = make_agent_modem(*read.scenario, EntityId{1}, {line});
  ASSERT_TRUE(agent.ok());
  EXPECT_EQ(agent.value()->rate(), 7680);
  const auto fast = make_agent_modem(*read.scenario, EntityId{1}, {line, 0, 8000});
  ASSERT_FALSE(fast.ok());
  EXPECT_EQ(fast.error().place, "--modem-rate");
}

// A world whose radio authenticates messages, with a modem at any port.
class SealedModem : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("sealed-modem-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    const std::string key = write_key("team.key", 'k');
    auto read =
        read_pair("endpoint: 'udpin:0', entities: [real-1], advertisement_period_s: 0.1",
                  "{kind: remote}", ", authentication: {key_file: '" + key + "'}");
    ASSERT_TRUE(read.ok()) << read.report();
    scenario_ = std::move(read.scenario);
    auto made = make_world_modem(*scenario_);
    ASSERT_TRUE(made.ok()) << made.error().text();
    world_ = std::move(made).value();
    const auto places = world_->start();
    ASSERT_TRUE(places.ok());
    const auto place = transport::parse_endpoint(places.value().at(0));
    place_ = *transport::counterpart(place.value());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write_key(const std::string& name, char letter) {
    const auto file = folder_ / name;
    std::ofstream(file) << std::string(32, letter);
    std::filesystem::permissions(
        file, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    return file.string();
  }

  std::unique_ptr<modem::ModemLink> agent(const std::string& key_file) {
    auto made = make_agent_modem(*scenario_, EntityId{1}, {place_, 0, 0, key_file});
    EXPECT_TRUE(made.ok()) << made.error().text();
    EXPECT_TRUE(made.value()->start().ok());
    return std::move(made).value();
  }

  bool comes(const std::function<bool()>& true_at_last) {
    for (int k = 0; k < 1000; ++k) {
      if (true_at_last()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  std::filesystem::path folder_;
  std::optional<scenario::Scenario> scenario_;
  std::unique_ptr<modem::ModemLink> world_;
  transport::EndpointAddress place_;
};

TEST_F(SealedModem, HearsAnAgentWithTheKey) {
  const auto real = agent("");
  EXPECT_TRUE(comes([&] { return !world_->take(Time(), EntityId{1}).empty(); }));
  EXPECT_TRUE(comes([&] { return !real->take(Time()).empty(); }));
  const auto same_key = agent(write_key("copy.key", 'k'));
  EXPECT_TRUE(comes([&] { return !same_key->take(Time()).empty(); }));
  EXPECT_EQ(world_->statistics().unauthentic, 0u);
}

TEST_F(SealedModem, RefusesAnAgentWithAnotherKeyAndOneWithout) {
  const auto another = agent(write_key("other.key", 'o'));
  EXPECT_TRUE(comes([&] { return world_->statistics().unauthentic >= 3; }));
  EXPECT_TRUE(comes([&] { return another->statistics().unauthentic >= 3; }));
  const auto open = read_pair("entities: [real-1]", "{kind: remote}");
  auto unsealed = make_agent_modem(*open.scenario, EntityId{1}, {place_});
  ASSERT_TRUE(unsealed.ok() && unsealed.value()->start().ok());
  const auto before = world_->statistics().unauthentic;
  EXPECT_TRUE(comes([&] { return world_->statistics().unauthentic >= before + 5; }));
  EXPECT_EQ(world_->statistics().heard, 0u);
  const auto taken = world_->take(Time());
  ASSERT_EQ(taken.size(), 1u) << "that somebody was refused, once";
  EXPECT_EQ(std::get<modem::ModemAlert>(taken[0]).kind, modem::AlertKind::kRefused);
}

TEST_F(SealedModem, NeedsAKeyThatCanBeRead) {
  const auto made = make_agent_modem(*scenario_, EntityId{1}, {place_, 0, 0, "none.key"});
  ASSERT_FALSE(made.ok());
  EXPECT_EQ(made.error().place, "--key");
}

}  // namespace
}  // namespace skein::assemble::modem_setup_test
