// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/message_load.h"

#include <gtest/gtest.h>

#include <random>

namespace skein::record::message_load_test {
namespace {

SentMessages two_and_a_station() {
  SentMessages run;
  run.senders = {{EntityId{0}, {"base", false}},
                 {EntityId{1}, {"a", true}},
                 {EntityId{2}, {"b, the second", true}}};
  run.duration = 30;
  return run;
}

TEST(MessageLoad, CountsByHandWhatIsSentInEachPhase) {
  SentMessages run = two_and_a_station();
  const auto phases = load_phases({{"first", 0}, {"second", 10}}, run.duration);
  ASSERT_TRUE(phases.ok());
  MessageLoad load(phases.value(), 18);
  load.add({0, EntityId{1}, "report", 82});
  load.add({9.9, EntityId{1}, "report", 82});
  load.add({10, EntityId{1}, "report", 82});
  load.add({5, EntityId{2}, "team_inform", 32});
  load.add({29, EntityId{0}, "heartbeat", 22});
  load.add({30, EntityId{0}, "heartbeat", 22});  // at the end: of no phase
  const MessageLoad::Sum& of_a = load.sums().at({0, EntityId{1}, "report"});
  EXPECT_EQ(of_a.messages, 2u);
  EXPECT_EQ(of_a.bytes, 200u);
  EXPECT_DOUBLE_EQ(load.rate(0, of_a), 20);
  EXPECT_EQ(load.sums().size(), 4u);
  const std::string csv = message_load_csv(load, run);
  EXPECT_NE(csv.find("\nfirst,0,10,a,report,2,200,20.00\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\nsecond,10,30,base,heartbeat,1,40,2.00\n"), std::string::npos);
  EXPECT_NE(csv.find(",\"b, the second\",team_inform,1,50,5.00\n"), std::string::npos);
  const std::string text = message_load_text(load, run);
  // The mean of two aircraft: 20 and 5 bytes/s; together with the station's.
  EXPECT_NE(text.find("all kinds                    12.5          2.5\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("all stations                  0.0          2.0\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("together, kbit/s              0.2          0.1\n"),
            std::string::npos)
      << text;
}

TEST(MessageLoad, PhasesAreWhatIsSumsOfThemToo) {
  const SentMessages run = two_and_a_station();
  std::mt19937 random(3);
  MessageLoad whole(load_phases({}, run.duration).value(), 9);
  MessageLoad parts(load_phases({{"a", 3}, {"b", 11.5}, {"c", 20}}, run.duration).value(),
                    9);
  for (int k = 0; k < 500; ++k) {
    const SentMessage message{static_cast<double>(random() % 3000) / 100.0,
                              {static_cast<std::uint32_t>(random() % 3)},
                              random() % 2 ? "x" : "y",
                              static_cast<std::uint32_t>(random() % 100)};
    whole.add(message);
    parts.add(message);
  }
  std::uint64_t bytes = 0, messages = 0;
  for (const auto& [key, sum] : whole.sums()) {
    bytes += sum.bytes;
    messages += sum.messages;
  }
  EXPECT_EQ(messages, 500u);
  for (const auto& [key, sum] : parts.sums()) bytes -= sum.bytes;
  EXPECT_EQ(bytes, 0u);
  EXPECT_EQ(parts.phases().front().name, "before");
}

TEST(MessageLoad, RefusesPhasesOutOfOrder) {
  EXPECT_FALSE(load_phases({{"a", 10}, {"b", 5}}, 30).ok());
  EXPECT_FALSE(load_phases({{"a", 10}, {"b", 10}}, 30).ok());
  EXPECT_FALSE(load_phases({{"a", 30}}, 30).ok());
  EXPECT_FALSE(load_phases({{"a", -1}}, 30).ok());
  EXPECT_FALSE(read_sent_messages("/nowhere/at/all").ok());
}

}  // namespace
}  // namespace skein::record::message_load_test
