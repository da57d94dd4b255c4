// SPDX-License-Identifier: Apache-2.0
// Whole fleets as runs move them: plant, sensors, estimator, autopilot, gusts, agents and
// radio at 100 Hz, on one core, without fire and without records.
//
//   aircraft   aircraft in real time on one core = aircraft x simulated time / time of
//              the processor, so that others on the machine count little
//   us_step    of one aircraft, for one of its steps [us]

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <numeric>
#include <vector>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/world/build.h"
#include "skein/scenario/scenario_file.h"
#include "skein/simulation/run.h"

namespace skein {
namespace {

constexpr double kStepsPerSecond = 100;

// Records nothing, and takes the time of the processor at each second of the run.
class Stopwatch final : public Recorder {
 public:
  void record(const Record&) override {}
  Result<void> step_done(Time now) override {
    if (now.ns() % Time::from_seconds(1).ns() == 0) at_.push_back(std::clock());
    return {};
  }

  // Spent on each second from second `from` on [s].
  std::vector<double> seconds(std::size_t from) const {
    std::vector<double> spent;
    for (std::size_t k = from; k + 1 < at_.size(); ++k)
      spent.push_back(static_cast<double>(at_[k + 1] - at_[k]) / CLOCKS_PER_SEC);
    return spent;
  }

 private:
  std::vector<std::clock_t> at_;
};

constexpr int kStart = 2;  // until then aircraft join and get their routes [s]

// Time that the processor spends on each second of flight after the start [s].
std::vector<double> run_fleet(const std::string& plant, const std::string& sensors,
                              const std::string& turbulence, long count, int seconds) {
  const std::string text = fmt::format(
      "duration_s: {}\n"
      "environment: {{wind: {{kind: uniform, speed_mps: 5, from_deg: 250}}, "
      "turbulence: {}, phenomena: []}}\n"
      "missions: []\n"
      "record: {{rate_hz: 1}}\n"
      "aircraft:\n"
      "  - {{count: {}, plant: {}, autopilot: skein, sensors: [{}], agent: route,\n"
      "     start: {{placement: ring, distance_m: 2000}}}}\n",
      kStart + seconds, turbulence, count, plant, sensors);
  const auto read =
      scenario::read_scenario_text(text, "fleet", ".", assemble::kind_table());
  if (!read.ok()) throw std::runtime_error(read.report());
  auto built = assemble::build(*read.scenario, assemble::KindRegistry());
  if (!built) throw std::runtime_error(built.error().text());
  built.value().options.threads = 1;
  Stopwatch stopwatch;
  simulation::Run run(built.value().world, built.value().options, stopwatch);
  if (auto done = run.run_to_end(); !done) throw std::runtime_error(done.error().text());
  return stopwatch.seconds(kStart);
}

// Median over the seconds of all iterations: others on the machine make some of them
// slow.
void fleet(benchmark::State& state, const char* plant, const char* sensors,
           const char* turbulence) {
  const long count = state.range(0);
  // Fleets are all measured over the same part of their flight.
  const int seconds = count == 1 ? 300 : 3;
  std::vector<double> times;
  for (auto _ : state) {
    const auto spent = run_fleet(plant, sensors, turbulence, count, seconds);
    times.insert(times.end(), spent.begin(), spent.end());
    state.SetIterationTime(std::accumulate(spent.begin(), spent.end(), 0.0));
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  const double per_aircraft = *middle / static_cast<double>(count);
  state.counters["aircraft"] = 1 / per_aircraft;
  state.counters["us_step"] = 1e6 * per_aircraft / kStepsPerSecond;
}

#define SKEIN_FLEET(name, plant, sensors, turbulence)        \
  BENCHMARK_CAPTURE(fleet, name, plant, sensors, turbulence) \
      ->Arg(1)                                               \
      ->Arg(100)                                             \
      ->Arg(1000)                                            \
      ->Arg(10000)                                           \
      ->UseManualTime()                                      \
      ->Iterations(3)                                        \
      ->Unit(benchmark::kMillisecond)
SKEIN_FLEET(wing_sensors_gusts, "fixed-wing", "flight", "dryden");
SKEIN_FLEET(wing_sensors_calm, "fixed-wing", "flight", "none");
SKEIN_FLEET(wing_true_gusts, "fixed-wing", "ideal-navigation", "dryden");
SKEIN_FLEET(wing_true_calm, "fixed-wing", "ideal-navigation", "none");
SKEIN_FLEET(quad_sensors_gusts, "multirotor", "flight", "dryden");
SKEIN_FLEET(quad_true_calm, "multirotor", "ideal-navigation", "none");
#undef SKEIN_FLEET

}  // namespace
}  // namespace skein
