// SPDX-License-Identifier: Apache-2.0
#include "skein/base/service_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace skein::service_process_test {
namespace {

// Gives back what it is asked; some words do harm.
ServiceMessage obey(const ServiceMessage& request) {
  const std::string word = request.texts.empty() ? "" : request.texts[0];
  if (word == "crash") std::raise(SIGSEGV);
  if (word == "abort") std::abort();
  if (word == "throw") throw std::runtime_error("no");
  if (word == "leave") _exit(0);
  if (word == "eat") return {{}, std::vector<double>(std::size_t{1} << 30)};  // 8 GiB
  ServiceMessage answer = request;
  for (double& number : answer.numbers) number *= 2;
  return answer;
}

ServiceProcess started() {
  auto process = ServiceProcess::start(obey);
  EXPECT_TRUE(process.ok());
  return std::move(process).value();
}

TEST(ServiceProcess, AnswersOneRequestAfterTheOther) {
  ServiceProcess process = started();
  std::vector<double> many(3'000'000);
  std::iota(many.begin(), many.end(), -7.5);
  for (const auto& numbers : {std::vector<double>{}, {1, -2.5}, many}) {
    const ServiceMessage request{{"a", "", std::string(2'000'000, 'x'), "b\n"}, numbers};
    const auto answer = process.ask(request);
    ASSERT_TRUE(answer.ok()) << answer.error().text();
    EXPECT_EQ(answer.value().texts, request.texts);
    ASSERT_EQ(answer.value().numbers.size(), numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
      ASSERT_EQ(answer.value().numbers[i], 2 * numbers[i]);
  }
}

TEST(ServiceProcess, WhatEndsItIsAnError) {
  for (const auto& [word, why] :
       {std::pair{"crash", "its reader crashed (Segmentation fault)"},
        {"abort", "its reader crashed (Aborted)"},
        {"throw", "its reader ran out of memory or failed"},
        {"leave", "its reader ran out of memory or failed"}}) {
    ServiceProcess process = started();
    const auto answer = process.ask({{word}, {}});
    ASSERT_FALSE(answer.ok()) << word;
    EXPECT_EQ(answer.error().message, why);
    EXPECT_FALSE(process.ask({{"a"}, {}}).ok());
    EXPECT_TRUE(started().ask({{"a"}, {}}).ok()) << "another one is not touched";
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(ServiceProcess, ItsMemoryIsLimited) {
  const auto answer = started().ask({{"eat"}, {}});
  ASSERT_FALSE(answer.ok());
  EXPECT_EQ(answer.error().message, "its reader ran out of memory or failed");
}
#endif

TEST(ServiceProcess, ServesThreadsThatHaveOneEach) {
  std::vector<std::thread> threads;
  std::atomic<int> good = 0;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 10; ++k) {
        auto first = ServiceProcess::start(obey), second = ServiceProcess::start(obey);
        ServiceProcess moved = std::move(first).value();
        good +=
            moved.ask({{"a"}, {1}}).ok() && second.value().ask({{}, {1}}).ok() ? 1 : 0;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(good, 40);
}

}  // namespace
}  // namespace skein::service_process_test
