// SPDX-License-Identifier: Apache-2.0
// Telemetry allocates nothing: hundreds of vehicles send it from one thread.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "skein/link/vehicle_services/test/station.h"

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

namespace skein::vehicle_services::allocation_test {
namespace {

TEST(VehicleServer, AllocatesNothingForTelemetry) {
  VehicleServer server(test_options(Make::kArduPilot, false), test_frame());
  std::size_t frames = 0;
  Outbox out(7, 1, [&](Channel, std::span<const std::byte>) { ++frames; });
  Clocks now;
  VehicleSnapshot snapshot = flying();
  snapshot.not_ready = "a text that does not fit into a string without memory";
  snapshot.condition.mode_name = "another text that does not fit into a string";
  server.open(1, now);
  server.open(2, now);
  const auto run = [&](int steps) {
    for (int k = 0; k < steps; ++k) {
      now.wall += Time::from_seconds(0.02);
      now.simulated += Time::from_seconds(0.02);
      snapshot.motion.time = now.simulated;
      snapshot.motion.p_N.x() += 0.4;
      server.update(snapshot);
      server.step(now, out);
      EXPECT_TRUE(server.take_requests().empty());
    }
  };
  run(500);
  const std::size_t before = allocations, sent = frames;
  run(5000);
  EXPECT_EQ(allocations - before, 0U);
  EXPECT_GT(frames - sent, 7000U) << "100 s of two links";
}

}  // namespace
}  // namespace skein::vehicle_services::allocation_test
