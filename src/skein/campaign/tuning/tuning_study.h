// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "skein/campaign/batch/batch.h"
#include "skein/campaign/batch/scenario_reader.h"
#include "skein/campaign/batch/study_summary.h"

namespace skein::campaign {

/// Gains under a name.
struct GainSet {
  std::string name;
  std::string lap_gains;  ///< an entry of the autopilot's `lap_gains`, on one line
};

/// A route flown for several laps with several sets of gains.
struct TuningStudy {
  std::filesystem::path base;  ///< first aircraft: a fixed wing with an agent `route`
  std::vector<GainSet> sets;   ///< at least one
  std::vector<std::string> overrides;  ///< for every run
  int first_seed = 1;
  int seeds = 6;
};

/// One flight: lap k was flown with `sets[k]`, an index of the study's sets.
struct TuningFlight {
  std::size_t item = 0;
  std::vector<std::size_t> sets;

  /// Whether the gains changed meanwhile.
  bool changes() const;
};

struct TuningPlan {
  std::vector<BatchItem> items;
  std::vector<TuningFlight> flights;
};

/// Laps of a flight with the same gains all the time.
inline constexpr int kGainsLaps = 3;

/// One flight per seed, every lap with other gains. From each seed to the next the sets
/// move on by a lap, so that every set is flown first, second and so on equally often.
/// Fails: kBadInput for an override or gains that do not fit the scenario.
Result<TuningPlan> plan_laps(const TuningStudy& study, const ScenarioReader& reader);

/// One flight of kGainsLaps laps per set and seed, with the same gains in all laps; by
/// set, then by seed. Fails: as plan_laps().
Result<TuningPlan> plan_comparison(const TuningStudy& study,
                                   const ScenarioReader& reader);

/// One of kLapFigures of a lap, from 0; nothing when the lap was not completed.
std::optional<double> lap_figure(const record::RunSummary& flight, int lap,
                                 const std::string& figure);

/// What a lap of this flight costs:
///
///   J = (e / 1 m)^2 + (h / 1 m)^2 + (V / 1 m/s)^2 + (s / 20 deg/s)^2
///
/// with the RMS values of true cross-track, height and airspeed error and of the
/// surfaces' rates. A lap that was not completed costs 1000.
/// @param lap  from 0.
double lap_cost(const record::RunSummary& flight, int lap);

/// The mean over the laps of a flight of plan_comparison().
double flight_cost(const record::RunSummary& flight);

/// A figure of the laps flown with set `set`: one of kLapFigures, or "cost". One value
/// per flight, the mean over its laps with that set; flights without one are left out.
std::vector<double> values_of(const TuningPlan& plan,
                              const std::vector<BatchOutcome>& outcomes, std::size_t set,
                              const std::string& figure);

/// How many laps of a set were planned, and how many were completed.
struct LapCount {
  int planned = 0, completed = 0;
};
LapCount laps_of(const TuningPlan& plan, const std::vector<BatchOutcome>& outcomes,
                 std::size_t set);

/// Cost with set 1 less cost with set 0, over the seeds that were flown with both in
/// flights of plan_comparison().
MeanInterval cost_change(const TuningPlan& plan,
                         const std::vector<BatchOutcome>& outcomes);

/// One row per flight and lap: seed, lap, gains, content hash, cost, then kLapFigures.
std::string tuning_csv(const TuningStudy& study, const TuningPlan& plan,
                       const std::vector<BatchOutcome>& outcomes);

/// For each set `SET/FIGURE` and `SET/FIGURE_ci95` of each of kLapFigures and of the
/// cost, `SET/laps` (completed), and `runs`, `runs_failed`, `runs_missing`.
StudyFigures tuning_figures(const TuningStudy& study, const TuningPlan& plan,
                            const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
