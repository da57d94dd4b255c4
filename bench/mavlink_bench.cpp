// SPDX-License-Identifier: Apache-2.0
// MAVLink frames read and written by one core; items are frames.
#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/frame_writer.h"
#include "skein/link/mavlink/messages.h"

namespace {

using namespace skein::mavlink;

GlobalPositionInt position() {
  GlobalPositionInt message;
  message.time_boot_ms = 123'456;
  message.lat = 472'345'678;
  message.lon = 86'543'210;
  message.alt = 512'000;
  message.relative_alt = 80'000;
  message.vx = 1'500;
  message.hdg = 9'000;
  return message;
}

Attitude attitude() {
  Attitude message;
  message.time_boot_ms = 123'456;
  message.roll = 0.1F;
  message.pitch = 0.05F;
  message.yaw = 2;
  message.yawspeed = 0.2F;
  return message;
}

// What a vehicle sends, as one stream: position, attitude, speeds, its state.
std::vector<std::byte> telemetry(int rounds) {
  std::vector<std::byte> stream;
  FrameWriter writer(1, 1);
  const auto add = [&](std::span<const std::byte> frame) {
    stream.insert(stream.end(), frame.begin(), frame.end());
  };
  for (int k = 0; k < rounds; ++k) {
    add(writer.write(position()));
    add(writer.write(attitude()));
    VfrHud hud;
    hud.airspeed = 15;
    hud.groundspeed = 17;
    hud.alt = 512;
    hud.climb = 1;
    hud.heading = 90;
    hud.throttle = 50;
    add(writer.write(hud));
    Heartbeat heartbeat;
    heartbeat.mavlink_version = 3;
    add(writer.write(heartbeat));
  }
  return stream;
}

// Frames found, and each message taken out of its frame, as a receiver of telemetry does.
void Read(benchmark::State& state) {
  const std::vector<std::byte> stream = telemetry(250);
  FrameParser parser;
  std::int64_t sum = 0;
  for (auto _ : state)
    parser.read(stream, [&](const Frame& frame) {
      switch (frame.id()) {
        case kFacts<GlobalPositionInt>.id:
          sum += unpack<GlobalPositionInt>(frame.payload()).lat;
          break;
        case kFacts<Attitude>.id:
          sum += unpack<Attitude>(frame.payload()).time_boot_ms;
          break;
        case kFacts<VfrHud>.id:
          sum += unpack<VfrHud>(frame.payload()).heading;
          break;
        default:
          sum += unpack<Heartbeat>(frame.payload()).mavlink_version;
      }
    });
  benchmark::DoNotOptimize(sum);
  if (parser.counts().skipped_bytes > 0) state.SkipWithError("bytes were skipped");
  state.SetItemsProcessed(static_cast<std::int64_t>(parser.counts().frames));
}
BENCHMARK(Read);

void Write(benchmark::State& state) {
  FrameWriter writer(1, 1);
  GlobalPositionInt message = position();
  for (auto _ : state) {
    ++message.time_boot_ms;
    benchmark::DoNotOptimize(writer.write(message).data());
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(Write);

void WriteSigned(benchmark::State& state) {
  FrameWriter writer(1, 1);
  Signer signer(key_of("bench"), 1, 0);
  const GlobalPositionInt message = position();
  for (auto _ : state) benchmark::DoNotOptimize(writer.write(message, signer, 0).data());
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(WriteSigned);

// The frames of Read() found and checked by their signatures.
void ReadSigned(benchmark::State& state) {
  std::vector<std::byte> stream;
  FrameWriter writer(1, 1);
  Signer signer(key_of("bench"), 1, 0);
  for (int k = 0; k < 1000; ++k) {
    const auto frame = writer.write(position(), signer, 0);
    stream.insert(stream.end(), frame.begin(), frame.end());
  }
  std::int64_t valid = 0;
  for (auto _ : state) {
    SignatureChecker checker(key_of("bench"));
    FrameParser parser;
    parser.read(stream, [&](const Frame& frame) {
      valid += checker.check(frame, 0) == SignatureVerdict::kValid;
    });
  }
  if (valid != 1000 * state.iterations()) state.SkipWithError("not all are valid");
  state.SetItemsProcessed(valid);
}
BENCHMARK(ReadSigned);

}  // namespace
