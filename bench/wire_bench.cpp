// SPDX-License-Identifier: Apache-2.0
// How fast messages and records are coded and decoded, per core.

#include <benchmark/benchmark.h>

#include "skein/data/describe/wire.h"
#include "skein/data/event/record.h"

namespace skein {
namespace {

Message message_of(MessageContent content) {
  return {EntityId{3}, EntityId{0}, 12345, Time::from_seconds(1234.5),
          std::move(content)};
}

AircraftReport a_report() {
  AircraftReport report;
  report.nav.time = Time::from_seconds(1234.4);
  report.nav.p_N = {512.3, -1204.8, -320.1};
  report.nav.v_N = {12.1, -8.4, 0.3};
  report.task_number = 17;
  return report;
}

FireReading a_reading() {
  return {Time::from_seconds(1234.4), EntityId{3}, {512.3, -1204.8}, 3.1, true};
}

// One message there and back; its memory is used again, as a link would.
void there_and_back(benchmark::State& state, const Message& message) {
  std::vector<std::byte> coded;
  for (auto _ : state) {
    coded.clear();
    wire::encode(message, coded);
    auto decoded = wire::decode<Message>(coded);
    if (!decoded) return state.SkipWithError("it was not read back");
    benchmark::DoNotOptimize(decoded);
  }
  state.counters["messages"] = benchmark::Counter(static_cast<double>(state.iterations()),
                                                  benchmark::Counter::kIsRate);
  state.counters["bytes"] = static_cast<double>(coded.size());
}
BENCHMARK_CAPTURE(there_and_back, reading, message_of(a_reading()));
BENCHMARK_CAPTURE(there_and_back, report, message_of(a_report()));
BENCHMARK_CAPTURE(there_and_back, task, message_of(Task{17, FlyTo{{100, 200}}}));
BENCHMARK_CAPTURE(there_and_back, heartbeat, message_of(Heartbeat{}));

void canonical(benchmark::State& state, const Record& record) {
  std::vector<std::byte> coded;
  for (auto _ : state) {
    wire::encode_canonical(record, coded);
    benchmark::DoNotOptimize(coded.data());
  }
  state.counters["bytes"] = static_cast<double>(coded.size());
}
BENCHMARK_CAPTURE(canonical, truth, Record(TruthRecord{}));
BENCHMARK_CAPTURE(canonical, estimate, Record(EstimateRecord{}));

}  // namespace
}  // namespace skein
