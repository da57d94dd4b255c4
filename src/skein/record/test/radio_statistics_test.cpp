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
  record.use.sending_share = sending;
  record.use.busy_share = busy;
  return record;
}

TEST(RadioStatistics, CountsMessagesByWhatBecameOfThem) {
  RadioStatistics statistics;
  for (int k = 0; k < 5; ++k) statistics.message(LossCause::kNone, k == 0 ? 2 : 0, false);
  statistics.message(LossCause::kQueueFull, 0, false);
  for (int k = 0; k < 2; ++k) statistics.message(LossCause::kPending, 0, false);
  const auto figures = figures_of(statistics);
  EXPECT_EQ(figures.at("messages_sent"), 8);
  EXPECT_EQ(figures.at("messages_lost"), 1);
  EXPECT_EQ(figures.at("messages_lost_queue_full"), 1);
  EXPECT_EQ(figures.at("messages_pending"), 2);
  EXPECT_EQ(figures.at("messages_relayed"), 1);
  EXPECT_FALSE(figures.contains("messages_lost_pending"));
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
