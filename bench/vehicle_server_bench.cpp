// SPDX-License-Identifier: Apache-2.0
// Simulated MAVLink vehicles in one thread; items are seconds of one vehicle with one
// ground station, at its own rates.
#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "skein/link/vehicle_services/vehicle_server.h"

namespace {

using namespace skein;
using namespace skein::vehicle_services;

constexpr std::size_t kVehicles = 300;

VehicleSnapshot flying() {
  VehicleSnapshot snapshot;
  snapshot.motion.p_N = {300, 250, -500};
  snapshot.motion.v_N = {20, 0, 0};
  snapshot.condition.armed = true;
  snapshot.condition.on_ground = false;
  snapshot.condition.position = true;
  snapshot.condition.mode = VehicleMode::kGuided;
  return snapshot;
}

// @param security  signs; null: nothing is signed.
void run(benchmark::State& state, mavlink::LinkSecurity* security) {
  const auto frame = geo::LocalFrame::at({47, 8, 0}).value();
  std::size_t bytes = 0, frames = 0;
  std::vector<VehicleServer> servers;
  std::vector<Outbox> outboxes;
  Clocks now;
  for (std::size_t k = 0; k < kVehicles; ++k) {
    VehicleServerOptions options;
    options.system = static_cast<std::uint8_t>(k % 250 + 1);
    servers.emplace_back(options, frame);
    servers.back().open(1, now);
    outboxes.emplace_back(
        options.system, 1,
        [&](Channel, std::span<const std::byte> sent) {
          ++frames;
          bytes += sent.size();
        },
        security);
  }
  const VehicleSnapshot snapshot = flying();
  // Snapshots of 10 Hz, steps of 50 Hz.
  const auto second = [&] {
    for (int step = 0; step < 50; ++step) {
      now.wall += Time::from_seconds(0.02);
      now.simulated += Time::from_seconds(0.02);
      for (std::size_t k = 0; k < kVehicles; ++k) {
        if (step % 5 == 0) servers[k].update(snapshot);
        servers[k].step(now, outboxes[k]);
      }
    }
  };
  second();
  frames = bytes = 0;
  for (auto _ : state) second();
  const auto seconds = static_cast<double>(state.iterations()) * kVehicles;
  state.SetItemsProcessed(static_cast<std::int64_t>(seconds));
  state.counters["frames/s"] = static_cast<double>(frames) / seconds;
  state.counters["bytes/s"] = static_cast<double>(bytes) / seconds;
}

void plain(benchmark::State& state) {
  run(state, nullptr);
}
BENCHMARK(plain)->Unit(benchmark::kMillisecond);

void with_signatures(benchmark::State& state) {
  mavlink::LinkSecurity security(mavlink::key_of("benchmark"));
  security.set_time(1'767'225'600'000'000'000);
  security.secure(1, 1);
  run(state, &security);
}
BENCHMARK(with_signatures)->Unit(benchmark::kMillisecond);

}  // namespace
