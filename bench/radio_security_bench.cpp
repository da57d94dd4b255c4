// SPDX-License-Identifier: Apache-2.0
// What a tag costs a sender and each receiver, beside coding the same report.

#include <benchmark/benchmark.h>

#include <span>
#include <vector>

#include "skein/data/describe/wire.h"
#include "skein/data/radio/message.h"
#include "skein/layer/communication/security/authenticity.h"

namespace {

using namespace skein;
using namespace skein::communication;

constexpr EntityId kSender{0}, kReceiver{1};

Message report() {
  Message message;
  message.from = kSender;
  message.to = kEveryone;
  message.content = AircraftReport{};
  return message;
}

AuthenticationOptions key() {
  AuthenticationOptions made;
  made.key.fill(std::byte{7});
  return made;
}

void code(benchmark::State& state) {
  const Message message = report();
  std::vector<std::byte> bytes;
  for (auto _ : state) {
    bytes.clear();
    wire::encode(message, bytes);
    benchmark::DoNotOptimize(bytes.data());
  }
  state.counters["bytes"] = static_cast<double>(bytes.size());
}
BENCHMARK(code);

void code_and_seal(benchmark::State& state) {
  const Message message = report();
  Authenticity team(key(), 2);
  std::vector<std::byte> bytes;
  for (auto _ : state) {
    bytes.clear();
    wire::encode(message, bytes);
    team.seal(kSender, bytes);
    benchmark::DoNotOptimize(bytes.data());
  }
  state.counters["bytes"] = static_cast<double>(bytes.size());
}
BENCHMARK(code_and_seal);

void judge(benchmark::State& state) {
  Authenticity team(key(), 2);
  std::vector<std::byte> bytes;
  wire::encode(report(), bytes);
  team.seal(kSender, bytes);
  for (auto _ : state) benchmark::DoNotOptimize(team.judge(kReceiver, kSender, bytes));
}
BENCHMARK(judge);

}  // namespace
