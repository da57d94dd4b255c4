// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/radio_statistics.h"

#include <gtest/gtest.h>

namespace skein::record::radio_statistics_test {
namespace {

std::map<std::string, double> figures_of(const RadioStatistics& statistics) {
  std::map<std::string, double> figures;
  statistics.add_figures(figures);
  return figures;
}

RadioUseRecord use_of(double time, std::uint32_t id, double sending, double busy) {
  RadioUseRecord record{Time::from_seconds(time), EntityId{id}, {}};
  record.value.sending_share = sending;
  record.value.busy_share = busy;
  return record;
}

ReceivedMessage received(LossCause cause, std::uint32_t hops = 0) {
  return {EntityId{1}, "report", false, cause, hops, false};
}

TEST(RadioStatistics, CountsMessagesByWhatBecameOfThem) {
  RadioStatistics statistics;
  for (int k = 0; k < 5; ++k)
    statistics.message(received(LossCause::kNone, k == 0 ? 2 : 0));
  statistics.message(received(LossCause::kQueueFull));
  for (int k = 0; k < 2; ++k) statistics.message(received(LossCause::kPending));
  const auto figures = figures_of(statistics);
  EXPECT_EQ(figures.at("messages_sent"), 8);
  EXPECT_EQ(figures.at("message_copies"), 8);
  EXPECT_EQ(figures.at("messages_lost"), 1);
  EXPECT_EQ(figures.at("messages_lost_queue_full"), 1);
  EXPECT_EQ(figures.at("messages_pending"), 2);
  EXPECT_EQ(figures.at("messages_relayed"), 1);
  EXPECT_FALSE(figures.contains("messages_lost_pending"));
}

TEST(RadioStatistics, AMessageToAllIsSentOnceAndMayBeLostByEachReceiver) {
  RadioStatistics statistics;
  const EntityId one{1}, two{2};
  for (int receiver = 0; receiver < 4; ++receiver)
    statistics.message({one, "place_report", receiver > 0,
                        receiver == 2 ? LossCause::kChance : LossCause::kNone});
  statistics.message({one, "queue-full", false});
  statistics.message({two, "place_report", false, LossCause::kChance});
  statistics.message({two, "place_report", false, LossCause::kNone, 0, true});
  const auto figures = figures_of(statistics);
  EXPECT_EQ(figures.at("messages_sent"), 3);
  EXPECT_EQ(figures.at("messages_sent_place_report"), 2);
  EXPECT_EQ(figures.at("messages_sent_queue_full"), 1);
  EXPECT_EQ(figures.at("message_copies"), 6);
  EXPECT_EQ(figures.at("messages_lost"), 2);
  EXPECT_EQ(statistics.sent_by(one), 2);
  EXPECT_EQ(statistics.sent_by(two), 1) << "what others sent in its name is not its own";
  EXPECT_EQ(statistics.sent_by(EntityId{3}), 0);
}

TEST(RadioStatistics, LoadsCountByTheTimeThatTheyCover) {
  RadioStatistics statistics;
  for (std::uint32_t id = 0; id < 2; ++id) statistics.radio(use_of(10, id, 0.1, 0.2));
  for (std::uint32_t id = 0; id < 2; ++id) statistics.radio(use_of(12, id, 0.1, 0.9));
  const auto figures = figures_of(statistics);
  EXPECT_NEAR(figures.at("radio_load_mean"), (10 * 0.3 + 2 * 1.0) / 12, 1e-12);
  EXPECT_EQ(figures.at("radio_load_max"), 1);
  EXPECT_EQ(figures.at("radio_sending_max"), 0.1);
}

}  // namespace
}  // namespace skein::record::radio_statistics_test
