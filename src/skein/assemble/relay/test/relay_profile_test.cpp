// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/relay/relay_profile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace skein::assemble::relay_profile_test {
namespace {

using impairment::Direction;
using impairment::index_of;

std::string problems_with(const std::string& text) {
  const auto profile = read_relay_profile(text, "x.yaml");
  return profile.ok() ? "" : profile.error().text();
}

constexpr const char* kBad =
    "delay_s: 0.1\n"
    "jitter_kind: normal\n"
    "loss: 0.05\n"
    "to_a: {delay_s: 0.3}\n"
    "outages: [{from_s: 10, until_s: 15}]\n"
    "outages_per_hour: 6\n"
    "changes:\n"
    "  - {at_s: 20, loss: 0.5}\n"
    "  - {at_s: 30, direction: to-b, cut: true}\n";

TEST(RelayProfile, IsReadAndWritten) {
  const auto profile = read_relay_profile(kBad, "bad.yaml");
  ASSERT_TRUE(profile.ok()) << profile.error().text();
  const impairment::ImpairmentPlan plan = plan_of(profile.value());
  const auto& to_b = plan.first[index_of(Direction::kToB)];
  const auto& to_a = plan.first[index_of(Direction::kToA)];
  EXPECT_EQ(to_b.delay, 0.1);
  EXPECT_EQ(to_a.delay, 0.3);
  EXPECT_EQ(to_a.loss, 0.05);
  EXPECT_EQ(to_a.jitter_kind, impairment::JitterKind::kNormal);
  ASSERT_EQ(plan.outages.spans.size(), 1u);
  EXPECT_EQ(plan.outages.spans[0].until, 15);
  EXPECT_EQ(plan.outages.per_hour, 6);
  ASSERT_EQ(plan.changes.size(), 2u);
  EXPECT_EQ(plan.changes[0].change.loss, 0.5);
  EXPECT_EQ(plan.changes[1].change.cut, true);
  EXPECT_EQ(plan.changes[1].directions, impairment::Directions::kToB);
  const std::string written = write_relay_profile(profile.value());
  const auto again = read_relay_profile(written, "written");
  ASSERT_TRUE(again.ok()) << again.error().text();
  EXPECT_EQ(write_relay_profile(again.value()), written);
}

TEST(RelayProfile, SaysWhatIsWrong) {
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(problems_with(text).find(part), std::string::npos) << problems_with(text);
  };
  says("loss: 1.5", "x.yaml:1:7 loss");
  says("losss: 0.5", "Did you mean \"loss\"?");
  says("delay_ms: 5", "delay_s");
  says("changes: [{loss: 1}]", "changes[0].at_s");
  says("outages: [{from_s: 5, until_s: 4}]", "must not be before from_s");
  says("queue_bytes: 0", "queue_bytes");
  says("changes: [{at_s: 1, direction: up}]", "to-b");
}

TEST(RelayProfile, IsChangedByOverrides) {
  const auto profile = load_relay_profile({}, {"loss=0.2", "to_b.delay_s=0.4"});
  ASSERT_TRUE(profile.ok()) << profile.error().text();
  EXPECT_EQ(profile.value().both.loss, 0.2);
  EXPECT_EQ(profile.value().to_b.delay, 0.4);
  const auto bad = load_relay_profile({}, {"loss=2"});
  ASSERT_FALSE(bad.ok());
  EXPECT_NE(bad.error().text().find("--set loss=2"), std::string::npos)
      << bad.error().text();
  EXPECT_FALSE(load_relay_profile("no-such-file.yaml", {}).ok());
}

TEST(RelayProfile, NamesWhatAStreamCannotSuffer) {
  const auto key_of = [](const std::string& text) -> std::string {
    const auto profile = read_relay_profile(text, "x.yaml");
    const auto good = check_for_streams(profile.value());
    return good.ok() ? "" : good.error().place;
  };
  EXPECT_EQ(key_of("delay_s: 1\nloss: 0"), "");
  EXPECT_EQ(key_of("loss: 0.1"), "loss");
  EXPECT_EQ(key_of("to_a: {duplicate: 0.1}"), "to_a.duplicate");
  EXPECT_EQ(key_of("changes: [{at_s: 1}, {at_s: 2, reorder: 1}]"), "changes[1].reorder");
}

}  // namespace
}  // namespace skein::assemble::relay_profile_test
