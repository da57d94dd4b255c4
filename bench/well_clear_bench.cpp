// SPDX-License-Identifier: Apache-2.0
// Cost of alerts and bands, per core: those of the reference data's encounters, or where
// it is missing of made-up ones.
//
// Each encounter is answered some times between two readings of the processor's clock;
// counters are the mean and the worst of the encounters' mean times [us].

#include <benchmark/benchmark.h>

#include <ctime>
#include <string>
#include <vector>

#include "skein/base/input_file.h"
#include "skein/base/random.h"
#include "skein/exchange/traffic/encounters.h"
#include "skein/model/well_clear/bands.h"

namespace skein::model {
namespace {

std::vector<exchange::Encounter> made_up() {
  RandomStream random(11, 0, Purpose::kTest);
  std::vector<exchange::Encounter> all;
  const auto aircraft = [&](double reach) {
    const double course = 2 * geo::kPi * random.uniform();
    const Vec3 p(reach * (random.uniform() - 0.5), reach * (random.uniform() - 0.5),
                 -300 + 200 * (random.uniform() - 0.5));
    return AircraftMotion{p, Vec3(25 * math::cos(course), 25 * math::sin(course), 0)};
  };
  for (int i = 0; i < 200; ++i) {
    exchange::Encounter e{std::to_string(i), aircraft(1000), {}, {}};
    const int intruders = i % 2 == 0 ? 1 : 2 + i % 7;
    for (int k = 0; k < intruders; ++k) e.intruders.push_back({aircraft(6000), 0, 0, 0});
    all.push_back(std::move(e));
  }
  return all;
}

std::vector<exchange::Encounter> encounters(const std::string& prefix,
                                            const WellClearConfiguration& c,
                                            bool several) {
  const auto text = read_file(std::string(SKEIN_SHARED_DATA) + "/team/detect/" + prefix +
                              "_encounters.csv");
  std::vector<exchange::Encounter> all;
  if (text) {
    all = exchange::read_encounters(text.value(), prefix, c).value();
  } else {
    all = made_up();
  }
  std::erase_if(all, [&](const exchange::Encounter& e) {
    return (e.intruders.size() > 1) != several;
  });
  return all;
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <class Answer>
void measure(benchmark::State& state, const std::vector<exchange::Encounter>& all,
             int times, const Answer& answer) {
  double mean = 0, worst = 0;
  for (auto _ : state) {
    mean = worst = 0;
    for (const exchange::Encounter& e : all) {
      const double begin = processor_seconds();
      for (int k = 0; k < times; ++k) answer(e);
      const double each = (processor_seconds() - begin) / times;
      mean += each / static_cast<double>(all.size());
      worst = std::max(worst, each);
    }
  }
  state.counters["mean_us"] = 1e6 * mean;
  state.counters["worst_us"] = 1e6 * worst;
}

void alerts(benchmark::State& state, const std::string& prefix, const std::string& name,
            bool several) {
  const WellClearConfiguration c = *well_clear_configuration(name);
  measure(state, encounters(prefix, c, several), 1000, [&](const exchange::Encounter& e) {
    for (const Intruder& intruder : e.intruders)
      benchmark::DoNotOptimize(alert_level(c, e.own, intruder));
  });
}

void all_bands(benchmark::State& state, const std::string& prefix,
               const std::string& name, bool several) {
  const WellClearConfiguration c = *well_clear_configuration(name);
  BandMaker maker(c);
  measure(state, encounters(prefix, c, several), 20, [&](const exchange::Encounter& e) {
    for (std::size_t k = 0; k < kManoeuvreKinds; ++k)
      benchmark::DoNotOptimize(
          maker.bands(static_cast<ManoeuvreKind>(k), e.own, e.intruders).pieces.data());
  });
}

BENCHMARK_CAPTURE(alerts, do365_one, "do365", "DO_365B_no_SUM", false)->Iterations(1);
BENCHMARK_CAPTURE(alerts, do365_several, "do365", "DO_365B_no_SUM", true)->Iterations(1);
BENCHMARK_CAPTURE(alerts, suas_one, "suas", "skein_suas", false)->Iterations(1);
BENCHMARK_CAPTURE(alerts, suas_several, "suas", "skein_suas", true)->Iterations(1);
BENCHMARK_CAPTURE(all_bands, do365_one, "do365", "DO_365B_no_SUM", false)->Iterations(1);
BENCHMARK_CAPTURE(all_bands, do365_several, "do365", "DO_365B_no_SUM", true)
    ->Iterations(1);
BENCHMARK_CAPTURE(all_bands, suas_one, "suas", "skein_suas", false)->Iterations(1);
BENCHMARK_CAPTURE(all_bands, suas_several, "suas", "skein_suas", true)->Iterations(1);

}  // namespace
}  // namespace skein::model
