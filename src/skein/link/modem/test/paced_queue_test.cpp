// SPDX-License-Identifier: Apache-2.0
#include "skein/link/modem/paced_queue.h"

#include <gtest/gtest.h>

namespace skein::modem::paced_queue_test {
namespace {

Time seconds(double s) {
  return Time::from_seconds(s);
}

Waiting waiting_of(std::uint64_t number, Urgency urgency, Time since,
                   bool injected = false) {
  Waiting waiting;
  waiting.carried.message.number = number;
  waiting.urgency = urgency;
  waiting.injected = injected;
  waiting.since = since;
  return waiting;
}

std::vector<std::uint64_t> all_of(PacedQueue& queue, Time now) {
  std::vector<std::uint64_t> numbers;
  while (auto next = queue.take(now)) numbers.push_back(next->carried.message.number);
  return numbers;
}

TEST(PacedQueue, SendsUrgentOnesFirstAndInjectedOnesLast) {
  PacedQueue queue({});
  queue.put(waiting_of(1, Urgency::kSafety, seconds(0), true));
  queue.put(waiting_of(2, Urgency::kReport, seconds(0)));
  queue.put(waiting_of(3, Urgency::kSafety, seconds(0)));
  queue.put(waiting_of(4, Urgency::kCommand, seconds(0)));
  queue.put(waiting_of(5, Urgency::kSafety, seconds(0)));
  EXPECT_EQ(all_of(queue, seconds(0)), (std::vector<std::uint64_t>{3, 5, 4, 2, 1}));
}

TEST(PacedQueue, LetsOutNoMoreThanTheModemCarries) {
  constexpr double kRate = 15'000;
  constexpr std::size_t kBytes = 100;
  PacedQueue queue({kRate, 10'000, seconds(1000)});
  for (std::uint64_t k = 0; k < 5000; ++k)
    queue.put(waiting_of(k, Urgency::kReport, seconds(0)));
  std::vector<double> times;
  // Looked at each millisecond, as the thread of a link does.
  for (int ms = 0; ms < 20'000; ++ms) {
    const Time now = seconds(ms * 1e-3);
    while (queue.take(now)) {
      queue.went(kBytes, now);
      times.push_back(now.seconds());
    }
  }
  // All of the rate is used: 20 s, but for the one that is on its way.
  EXPECT_NEAR(static_cast<double>(times.size()), kRate / (8 * kBytes) * 20, 1);
  for (std::size_t from = 0; from < times.size(); ++from)
    for (std::size_t to = from; to < times.size(); ++to)
      ASSERT_LE(static_cast<double>(to - from) * 8 * kBytes,
                kRate * (times[to] - times[from] + 0.010) + 1e-6)
          << "by the documented bound, one datagram aside";
}

TEST(PacedQueue, CountsWhatItDropsAndKeepsTheUrgent) {
  PacedQueue queue({0, 2, seconds(1)});
  queue.put(waiting_of(1, Urgency::kReport, seconds(0)));
  queue.put(waiting_of(2, Urgency::kReport, seconds(0)));
  queue.put(waiting_of(3, Urgency::kReport, seconds(0)));
  EXPECT_EQ(queue.losses().full, 1u) << "no room";
  queue.put(waiting_of(4, Urgency::kSafety, seconds(0)));
  EXPECT_EQ(queue.losses().full, 2u) << "the youngest report gave way";
  EXPECT_EQ(all_of(queue, seconds(0.5)), (std::vector<std::uint64_t>{4, 1}));
  queue.put(waiting_of(5, Urgency::kSafety, seconds(0)));
  EXPECT_TRUE(all_of(queue, seconds(1.5)).empty());
  EXPECT_EQ(queue.losses().expired, 1u);
  EXPECT_TRUE(queue.empty());
}

TEST(PacedQueue, SendsCopiesOfAMessageOnce) {
  PacedQueue queue({});
  for (const std::uint32_t receiver : {3u, 4u, 5u}) {
    Waiting copy = waiting_of(receiver, Urgency::kReport, seconds(0));
    copy.to = {receiver + 1, receiver};
    copy.carried.receivers = {receiver};
    copy.key.assign(receiver == 5 ? 2 : 1, std::byte{1});
    queue.put(std::move(copy));
  }
  const auto first = queue.take(seconds(0)), second = queue.take(seconds(0));
  ASSERT_TRUE(first && second && queue.empty());
  EXPECT_EQ(first->carried.receivers, (std::vector<std::uint32_t>{3, 4}));
  EXPECT_EQ(first->to, (Address{kAll, kAll}));
  EXPECT_EQ(second->to, (Address{6, 5}));
}

TEST(PacedQueue, DropsTheDeadBeforeItRefusesTheLiving) {
  PacedQueue queue({0, 2, seconds(1)});
  queue.put(waiting_of(1, Urgency::kSafety, seconds(0)));
  queue.put(waiting_of(2, Urgency::kSafety, seconds(2)));
  queue.put(waiting_of(3, Urgency::kReport, seconds(2)));
  EXPECT_EQ(queue.losses().expired, 1u);
  EXPECT_EQ(queue.losses().full, 0u);
  EXPECT_EQ(all_of(queue, seconds(2)), (std::vector<std::uint64_t>{2, 3}));
}

}  // namespace
}  // namespace skein::modem::paced_queue_test
