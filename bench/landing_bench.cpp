// SPDX-License-Identifier: Apache-2.0
// Landings of whole aircraft with all their sensors, against the wind, from all around.
//
//   mean, most   distance at rest from the point [m]
//   accidents    before they came to rest
//   toppled      afterwards

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <vector>

#include "skein/assemble/kinds/kinds_of.h"
#include "skein/assemble/world/build.h"
#include "skein/scenario/scenario_file.h"
#include "skein/simulation/run.h"

namespace skein {
namespace {

constexpr int kAircraft = 30;
constexpr double kStill = 0.3;    // at rest [m/s]
constexpr double kStillTime = 1;  // for this long [s]

// Where each aircraft comes to rest.
class Touches final : public Recorder {
 public:
  struct One {
    bool touched = false, rests = false, broke = false;
    Time still_since;
    double off = 0;  // from the point, at rest [m]
  };
  void record(const Record& record) override {
    if (const auto* truth = std::get_if<TruthRecord>(&record)) take(*truth);
    if (const auto* event = std::get_if<Event>(&record))
      if (event->kind == EventKind::kAccident) all[event->entity.value].broke = true;
  }

  std::map<std::uint32_t, One> all;

 private:
  void take(const TruthRecord& truth) {
    const VehicleState& state = truth.state;
    One& one = all[truth.id.value];
    one.touched |= state.on_ground;
    if (!one.touched || state.v_N.norm() > kStill) one.still_since = truth.time;
    if (one.rests || (truth.time - one.still_since).seconds() < kStillTime) return;
    one.rests = true;
    one.off = geo::horizontal(state.p_N).norm();
  }
};

void landing(benchmark::State& state, const char* aircraft, double wind,
             const char* turbulence, double distance) {
  const std::string text = fmt::format(
      "seed: 1\n"
      "duration_s: 500\n"
      "environment: {{terrain: flat, phenomena: [], turbulence: {},\n"
      "  wind: {{kind: uniform, speed_mps: {}, from_deg: 0}}}}\n"
      "missions: []\n"
      "aircraft:\n"
      "  - {{count: {}, plant: {{kind: fixed-wing, aircraft: {}}}, autopilot: skein,\n"
      "     sensors: [flight], altitude_agl_m: 100,\n"
      "     agent: {{kind: route, points_m: [[0, 0]], laps: 1, lands: true}},\n"
      "     start: {{placement: ring, distance_m: {}}}}}\n",
      turbulence, wind, kAircraft, aircraft, distance);
  for (auto _ : state) {
    const auto read = scenario::read_scenario_text(text, "landing", SKEIN_SOURCE_DIR,
                                                   assemble::kind_table());
    if (!read.ok()) throw std::runtime_error(read.report());
    auto built = assemble::build(*read.scenario, assemble::KindRegistry());
    if (!built) throw std::runtime_error(built.error().text());
    Touches touches;
    simulation::Run run(built.value().world, built.value().options, touches);
    if (auto done = run.run_to_end(); !done)
      throw std::runtime_error(done.error().text());
    double sum = 0, max = 0, resting = 0, accidents = 0, toppled = 0;
    for (const auto& [id, one] : touches.all) {
      accidents += one.broke && !one.rests;
      toppled += one.broke && one.rests;
      if (!one.rests) continue;
      ++resting;
      sum += one.off;
      max = std::max(max, one.off);
    }
    state.counters["mean"] = resting > 0 ? sum / resting : 0;
    state.counters["most"] = max;
    state.counters["accidents"] = accidents;
    state.counters["toppled"] = toppled;
  }
}

#define SKEIN_LANDING(name, aircraft, distance)                          \
  BENCHMARK_CAPTURE(landing, name##_calm, aircraft, 0, "none", distance) \
      ->Iterations(1)                                                    \
      ->Unit(benchmark::kMillisecond);                                   \
  BENCHMARK_CAPTURE(landing, name##_light, aircraft, 4,                  \
                    "{kind: dryden, intensity: light}", distance)        \
      ->Iterations(1)                                                    \
      ->Unit(benchmark::kMillisecond);                                   \
  BENCHMARK_CAPTURE(landing, name##_moderate, aircraft, 8,               \
                    "{kind: dryden, intensity: moderate}", distance)     \
      ->Iterations(1)                                                    \
      ->Unit(benchmark::kMillisecond)
SKEIN_LANDING(bixler, "bixler", 600);
SKEIN_LANDING(aerosonde, "aerosonde", 600);
SKEIN_LANDING(light_sport, "light-sport", 1500);
#undef SKEIN_LANDING

}  // namespace
}  // namespace skein
