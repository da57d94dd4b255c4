// SPDX-License-Identifier: Apache-2.0
// On board nothing is allocated each second.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "skein/model/well_clear/band_advisor.h"
#include "skein/model/well_clear/test/random_encounter.h"

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

namespace skein::model::test::allocation_test {
namespace {

TEST(BandAdvisor, AllocatesNothingOnceItHasMetAsMany) {
  const WellClearConfiguration c = *well_clear_configuration("skein_suas");
  BandAdvisor advisor(c);
  const auto fly = [&](int from) {
    std::size_t count = 0;
    for (int second = 0; second < 60; ++second) {
      RandomEncounter random(second % 20);
      const AircraftMotion own = random.aircraft(500, 50);
      std::vector<TrackedIntruder> tracks;
      for (const Intruder& each : random.intruders(6, c))
        tracks.push_back(
            {static_cast<std::uint32_t>(tracks.size()), each.motion, 5, 3, each.alerter});
      const std::size_t before = allocations;
      advisor.advise(from + second, own, tracks, {1, 20, 0});
      count += allocations - before;
    }
    return count;
  };
  EXPECT_GT(fly(0), 0u);
  EXPECT_EQ(fly(60), 0u);
}

}  // namespace
}  // namespace skein::model::test::allocation_test
