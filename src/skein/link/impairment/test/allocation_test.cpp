// SPDX-License-Identifier: Apache-2.0
// A channel allocates nothing once it has held as much before.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <vector>

#include "skein/link/impairment/impaired_channel.h"

namespace {
std::atomic<std::size_t> allocations{0};
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace skein::impairment::allocation_test {
namespace {

TEST(ImpairedChannel, AllocatesNothingForPacketsOnceWarm) {
  Impairment impairment;
  impairment.delay = 0.1;
  impairment.jitter = 0.05;
  impairment.loss = 0.1;
  impairment.duplicate = 0.1;
  impairment.reorder = 0.1;
  impairment.rate = 1e7;
  OutageOptions outages;
  outages.per_hour = 3600;
  outages.mean_duration = 0.1;
  ImpairedChannel channel(Traffic::kPackets, impairment,
                          RandomStream(1, 0, Purpose::kTest),
                          Outages(outages, RandomStream(1, 1, Purpose::kTest)));
  const std::vector<std::byte> packet(1000);
  Time now;
  std::size_t out = 0;
  const auto run = [&](int packets) {
    for (int k = 0; k < packets; ++k) {
      now += Time::from_seconds(0.001);
      channel.put(packet, now);
      while (channel.take(now)) ++out;
    }
  };
  run(20'000);  // the most that is ever held at once comes early, but not at the very
                // begin
  const std::size_t before = allocations, passed = out;
  run(20'000);
  EXPECT_EQ(allocations - before, 0u);
  EXPECT_GT(out - passed, 10'000u);
}

}  // namespace
}  // namespace skein::impairment::allocation_test
