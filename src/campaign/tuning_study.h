#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "campaign/batch.h"
#include "campaign/study_summary.h"
#include "scenario/kind_table.h"

namespace skein::campaign {

/// Gains under a name.
struct GainSet {
  std::string name;
  std::string lap_gains;  ///< an entry of the autopilot's `lap_gains`, on one line
};

/// A route flown several times round, every lap with other gains.
struct TuningStudy {
  std::filesystem::path base;  ///< first aircraft: a fixed wing with an agent `route`
  std::vector<GainSet> sets;   ///< one per lap, at least one
  std::vector<std::string> overrides;  ///< for every run
  int first_seed = 1;
  int seeds = 6;
};

/// One flight: lap k was flown with `sets[k]`, an index of the study's sets.
struct TuningFlight {
  std::size_t item = 0;
  std::vector<std::size_t> sets;
};

struct TuningPlan {
  std::vector<BatchItem> items;
  std::vector<TuningFlight> flights;  ///< one per seed
};

/// All flights of the study. From each seed to the next the sets move on by a lap, so
/// that every set is flown first, second and so on equally often.
/// Fails: kBadInput for an override or gains that do not fit the scenario.
Result<TuningPlan> plan_tuning_study(const TuningStudy& study,
                                     const scenario::KindTable& kinds);

/// Laps of a flight with the same gains all the time.
inline constexpr int kGainsLaps = 3;

/// The same gains in all of kGainsLaps laps, one flight per seed.
Result<TuningPlan> plan_gains_flights(const TuningStudy& study, const GainSet& gains,
                                      const scenario::KindTable& kinds);

/// What a lap of this flight costs:
///
///   J = (e / 1 m)^2 + (h / 1 m)^2 + (V / 1 m/s)^2 + (s / 20 deg/s)^2
///
/// with the RMS values of true cross-track, height and airspeed error and of the
/// surfaces' rates. A lap that was not completed costs 1000.
/// @param lap  from 0.
double lap_cost(const record::RunSummary& flight, int lap);

/// The mean over the laps of a flight of plan_gains_flights().
double flight_cost(const record::RunSummary& flight);

/// A figure of the laps flown with set `set`, one value per flight that completed it:
/// one of kLapFigures, or "cost" (of every flight that ended well).
std::vector<double> values_of(const TuningPlan& plan,
                              const std::vector<BatchOutcome>& outcomes, std::size_t set,
                              const std::string& figure);

/// One row per flight and lap: seed, lap, gains, content hash, cost, then kLapFigures.
std::string tuning_csv(const TuningStudy& study, const TuningPlan& plan,
                       const std::vector<BatchOutcome>& outcomes);

/// For each set `SET/FIGURE` and `SET/FIGURE_ci95` of each of kLapFigures and of the
/// cost, `SET/laps`, and `runs`, `runs_failed`, `runs_missing`.
StudyFigures tuning_figures(const TuningStudy& study, const TuningPlan& plan,
                            const std::vector<BatchOutcome>& outcomes);

}  // namespace skein::campaign
