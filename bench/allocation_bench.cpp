// SPDX-License-Identifier: Apache-2.0
// Allocation: what coalitions, sequences and tours cost to find, how far they are from
// their bounds.

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>

#include "skein/base/math.h"
#include "skein/solve/allocation/coalitions.h"
#include "skein/solve/allocation/search_random.h"
#include "skein/solve/allocation/sequences.h"
#include "skein/solve/allocation/task_satisfaction.h"
#include "skein/solve/touring/tours.h"

namespace skein::solve {
namespace {

constexpr double kSide = 12'000;  // of the area [m]

Vec2 somewhere(SearchRandom& random) {
  const double north = kSide * random.uniform();
  return {north, kSide * random.uniform()};
}

// Small and large fixed wings and copters; surveys and targets.
CoalitionProblem some_coalitions(std::uint64_t seed, std::size_t aircraft,
                                 std::size_t tasks, bool idle_allowed) {
  SearchRandom random(seed, 0);
  std::vector<TeamAircraft> team;
  for (std::size_t i = 0; i < aircraft; ++i) {
    const std::size_t type = random.below(3);
    TeamAircraft one;
    one.place = somewhere(random);
    one.v_min = (type == 0 ? 12 : type == 1 ? 21 : 0) * (0.9 + 0.3 * random.uniform());
    one.v_max = (type == 0 ? 22 : type == 1 ? 36 : 16) * (0.9 + 0.2 * random.uniform());
    one.cruise = (type == 0 ? 17 : type == 1 ? 26 : 12) * (0.9 + 0.2 * random.uniform());
    one.turn_radius = type == 0 ? 50 : type == 1 ? 150 : 0;
    one.endurance = (type == 0   ? 3000
                     : type == 1 ? 13'000
                                 : 1200) *
                    (0.6 + 0.7 * random.uniform());
    for (const char* sensor : {"camera", "thermal"})
      if (random.uniform() < 0.6)
        one.sensors[sensor] = {30 + 120 * random.uniform(), 0.6 + 0.4 * random.uniform()};
    team.push_back(one);
  }
  std::vector<TeamTask> all;
  for (std::size_t k = 0; k < tasks; ++k) {
    TeamTask task;
    task.place = somewhere(random);
    const std::string sensor = random.uniform() < 0.5 ? "camera" : "thermal";
    if (random.uniform() < 0.65)
      task.what = SurveillanceTask{sensor, 1e6 * math::pow(30, random.uniform())};
    else
      task.what = TrackingTask{sensor, 3 + 25 * random.uniform()};
    all.push_back(task);
  }
  return coalition_problem(team, all, 0, idle_allowed);
}

// Counters: gap of the worst case [%], share proven, and gain over greedy [%].
void coalitions(benchmark::State& state, std::size_t aircraft, std::size_t tasks,
                bool idle_allowed) {
  double gap = 0, proven = 0, gain = 0, count = 0;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const auto problem = some_coalitions(++seed, aircraft, tasks, idle_allowed);
    state.ResumeTiming();
    const CoalitionAnswer answer = best_coalitions(problem, {});
    state.PauseTiming();
    gap = std::max(gap, 100 * answer.quality.gap());
    proven += answer.quality.proven ? 1 : 0;
    const double greedy = utility_of(problem, greedy_coalitions(problem));
    gain += 100 * (answer.quality.value / greedy - 1);
    ++count;
    state.ResumeTiming();
  }
  state.counters["gap_%"] = gap;
  state.counters["proven"] = proven / count;
  state.counters["over_greedy_%"] = gain / count;
}
BENCHMARK_CAPTURE(coalitions, 12x6_idle, 12, 6, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(coalitions, 12x6_all, 12, 6, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(coalitions, 60x20_idle, 60, 20, true)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(20);
BENCHMARK_CAPTURE(coalitions, 60x20_all, 60, 20, false)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(20);

SequenceProblem some_sequences(std::uint64_t seed, std::size_t aircraft,
                               std::size_t tasks, SequenceObjective objective) {
  SearchRandom random(seed, 1);
  const auto starts = std::make_shared<std::vector<Vec2>>();
  const auto places = std::make_shared<std::vector<Vec2>>();
  SequenceProblem problem;
  problem.aircraft = aircraft;
  problem.objective = objective;
  problem.discount = 1.0 / 300;
  for (std::size_t a = 0; a < aircraft; ++a) starts->push_back(somewhere(random) / 2);
  for (std::size_t t = 0; t < tasks; ++t) {
    places->push_back(somewhere(random) / 2);
    SequenceTask task;
    task.value = 20 + 80 * random.uniform();
    if (objective != SequenceObjective::kDiscounted)
      task.service = 200 * random.uniform();
    problem.tasks.push_back(task);
  }
  problem.from_start = [=](std::size_t a, std::size_t t) {
    return ((*starts)[a] - (*places)[t]).norm() / 20;
  };
  problem.between = [=](std::size_t, std::size_t s, std::size_t t) {
    return ((*places)[s] - (*places)[t]).norm() / 20;
  };
  return problem;
}

void routes(benchmark::State& state, std::size_t aircraft, std::size_t tasks,
            SequenceObjective objective) {
  double gap = 0;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    const auto answer =
        best_sequences(some_sequences(++seed, aircraft, tasks, objective), {});
    gap = std::max(gap, 100 * answer.value().quality.gap());
  }
  state.counters["gap_%"] = gap;
}
BENCHMARK_CAPTURE(routes, last_end_14x5, 5, 14, SequenceObjective::kLastEnd)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(routes, discounted_10x5, 5, 10, SequenceObjective::kDiscounted)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(routes, discounted_100x20, 20, 100, SequenceObjective::kDiscounted)
    ->Unit(benchmark::kMillisecond);

void tours(benchmark::State& state, std::size_t places, std::size_t count) {
  SearchRandom random(places, 2);
  std::vector<Vec2> at;
  for (std::size_t k = 0; k < places; ++k) at.push_back(somewhere(random));
  TourProblem problem{places, count, [&](std::size_t a, std::size_t b) {
                        return (at[a] - at[b]).norm();
                      }};
  double gap = 0;
  for (auto _ : state) {
    Effort effort;
    effort.iterations = state.range(0);
    const TourAnswer answer = shortest_tours(problem, effort);
    gap = 100 * answer.quality.gap();
  }
  state.counters["gap_%"] = gap;
}
BENCHMARK_CAPTURE(tours, 200x5, 200, 5)
    ->Unit(benchmark::kMillisecond)
    ->Arg(10'000)
    ->Arg(100'000);

}  // namespace
}  // namespace skein::solve
