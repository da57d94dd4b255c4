// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/network/network_results.h"

#include <gtest/gtest.h>

namespace skein::exchange::network_results_test {
namespace {

NetworkMessage unicast(double sent, std::optional<double> delivered, MessageFate fate) {
  NetworkMessage message;
  message.from = 0;
  message.to = 1;
  message.bytes = 1000;
  message.sent = Time::from_seconds(sent);
  if (delivered) message.delivered = Time::from_seconds(*delivered);
  message.fate = fate;
  return message;
}

TEST(NetworkResults, WhatHappensInTheWarmUpDoesNotCount) {
  NetworkCase network;
  network.duration = Time::from_seconds(5);
  NetworkResult result;
  result.messages = {unicast(0.2, 0.3, MessageFate::kDelivered),
                     unicast(0.5, {}, MessageFate::kRetryLimit),
                     unicast(0.9, 1.5, MessageFate::kDelivered),
                     unicast(1.0, 1.2, MessageFate::kDelivered),
                     unicast(2.0, {}, MessageFate::kLost),
                     unicast(4.9, {}, MessageFate::kPending)};
  const NetworkSummary all = summarize(network, result);
  EXPECT_EQ(all.sent, 6u);
  EXPECT_DOUBLE_EQ(all.loss_ratio, 2.0 / 5);
  EXPECT_DOUBLE_EQ(all.goodput_bps, 3 * 8000.0 / 5);
  const NetworkSummary later = summarize(network, result, Time::from_seconds(1));
  EXPECT_EQ(later.sent, 3u);
  EXPECT_EQ(later.pending, 1u);
  EXPECT_DOUBLE_EQ(later.loss_ratio, 0.5);
  // What was sent before and received after it is on the air after it.
  EXPECT_DOUBLE_EQ(later.goodput_bps, 2 * 8000.0 / 4);
  ASSERT_EQ(later.delays.size(), 1u);
  EXPECT_NEAR(later.mean_delay, 0.2, 1e-9);
}

// Nothing delivered is no delay of 0.
TEST(NetworkResults, SayNoDelayWhereNothingWasDelivered) {
  NetworkCase network;
  network.duration = Time::from_seconds(5);
  NetworkResult result;
  result.messages = {unicast(0.2, {}, MessageFate::kRetryLimit)};
  const std::string text = network_summary_text(summarize(network, result));
  EXPECT_NE(text.find("delay       -\n"), std::string::npos) << text;
  result.messages = {unicast(0.2, 0.3, MessageFate::kDelivered)};
  EXPECT_NE(network_summary_text(summarize(network, result)).find("mean 100.0000 ms"),
            std::string::npos);
}

// Of large networks parts are left out, and the page says so.
TEST(NetworkPage, SaysWhatItLeavesOut) {
  const auto page_of = [](std::uint32_t nodes) {
    NetworkCase network;
    for (std::uint32_t k = 0; k < nodes; ++k) {
      network.names.push_back(k);
      network.nodes.push_back({{{Time(), Vec3(100.0 * k, 0, 0)}}, std::nullopt});
    }
    network.duration = Time::from_seconds(5);
    NetworkResult result;
    result.nodes.resize(nodes);
    result.hearers.resize(nodes);
    return network_page("n", network, result);
  };
  const std::string small = page_of(60), large = page_of(130);
  EXPECT_EQ(small.find("Shown for at most"), std::string::npos);
  EXPECT_EQ(small.find("shown are the busiest"), std::string::npos);
  EXPECT_NE(large.find("Shown for at most 60 nodes."), std::string::npos);
  EXPECT_NE(large.find("shown are the busiest 100 of 130"), std::string::npos);
}

TEST(NetworkResults, SayWhatIsTooLong) {
  NetworkCase network;
  network.names = {10, 11};
  network.nodes.resize(2);
  network.duration = Time::from_seconds(5);
  NetworkResult result;
  NetworkMessage to_all = unicast(0.5, {}, MessageFate::kTooLong);
  to_all.to = kAllNodesOfCase;
  result.messages = {unicast(0.2, {}, MessageFate::kTooLong), to_all};
  const NetworkSummary summary = summarize(network, result);
  EXPECT_EQ(summary.too_long, 2u);
  EXPECT_EQ(summary.loss_ratio, 1);
  EXPECT_NE(network_summary_text(summary).find("too long    2 messages"),
            std::string::npos);
  EXPECT_EQ(network_messages_csv(network, result),
            "message,from,to,sent_s,delivered_s,outcome,transmissions,rts\n"
            "0,10,11,0.200000000,,too-long,0,0\n"
            "0,10,11,0.500000000,,too-long,0,0\n");
}

}  // namespace
}  // namespace skein::exchange::network_results_test
