// Whole fleets as runs move them: plant, sensors, estimator, autopilot, gusts, agents and
// radio at 100 Hz, on one core, without fire and without records.
//
//   aircraft   aircraft in real time on one core = aircraft x simulated time / time of
//              the processor, so that others on the machine count little
//   us_step    of one aircraft, for one of its steps [us]

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "assemble/build.h"
#include "assemble/kinds_of.h"
#include "scenario/scenario_file.h"
#include "simulation/run.h"

namespace skein {
namespace {

constexpr double kStepsPerSecond = 100;

class Nothing final : public Recorder {
 public:
  void entity(EntityId, const std::string&, const std::string&) override {}
  void truth(Time, EntityId, const VehicleState&) override {}
  void estimate(EntityId, const NavEstimate&, const AutopilotStatus&) override {}
  void reading(const FireReading&) override {}
  void message(const Message&, Time, bool) override {}
  void perimeter(Time, const geo::Region&, EntityId, const BoundaryEstimate&) override {}
  void event(const Event&) override {}
  void crossing(const Crossing&) override {}
  Result<void> step_done(Time) override { return {}; }
};

class Quiet final : public OperatorConsole {
 public:
  void show(const RunProgress&) override {}
  bool stop_requested() const override { return false; }
};

// Time that the processor spends on the run, without building it [s].
double run_fleet(const std::string& plant, const std::string& sensors,
                 const std::string& turbulence, long count, double seconds) {
  const std::string text = fmt::format(
      "duration_s: {}\n"
      "environment: {{wind: {{kind: uniform, speed_mps: 5, from_deg: 250}}, "
      "turbulence: {}, fire: none}}\n"
      "station: {{agent: listener}}\n"
      "record: {{rate_hz: 1}}\n"
      "aircraft:\n"
      "  - {{count: {}, plant: {}, autopilot: skein, sensors: [{}], agent: route,\n"
      "     start: {{placement: ring, distance_m: 2000}}}}\n",
      seconds, turbulence, count, plant, sensors);
  const auto read =
      scenario::read_scenario_text(text, "fleet", ".", assemble::kind_table());
  if (!read.ok()) throw std::runtime_error(read.report());
  auto built = assemble::build(*read.scenario);
  if (!built) throw std::runtime_error(built.error().text());
  built.value().options.threads = 1;
  Nothing recorder;
  Quiet console;
  const std::clock_t begin = std::clock();
  (void)simulation::run(built.value().world, built.value().options, recorder, console)
      .value();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void fleet(benchmark::State& state, const char* plant, const char* sensors,
           const char* turbulence) {
  const long count = state.range(0);
  // Two seconds at least, and no longer than all are on their routes.
  const double seconds =
      std::clamp(std::round(6000.0 / static_cast<double>(count)), 2.0, 300.0);
  double spent = 0, flown = 0;
  for (auto _ : state) {
    const double time = run_fleet(plant, sensors, turbulence, count, seconds);
    state.SetIterationTime(time);
    spent += time;
    flown += static_cast<double>(count) * seconds;
  }
  state.counters["aircraft"] = flown / spent;
  state.counters["us_step"] = 1e6 * spent / (flown * kStepsPerSecond);
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
