// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "skein/data/event/record.h"
#include "skein/record/figures/alert_statistics.h"
#include "skein/record/figures/flight_statistics.h"
#include "skein/record/figures/forecast_statistics.h"
#include "skein/record/figures/memory_statistics.h"
#include "skein/record/figures/metrics.h"
#include "skein/record/figures/mission/mission_statistics.h"
#include "skein/record/figures/payload_statistics.h"
#include "skein/record/figures/radio_statistics.h"
#include "skein/record/figures/reading_ages.h"
#include "skein/record/figures/separation_statistics.h"
#include "skein/record/figures/team_statistics.h"
#include "skein/record/figures/traffic_statistics.h"
#include "skein/record/store/believer.h"
#include "skein/record/store/summary.h"

namespace skein::record {

/// Gathers the key figures of a run from its records, in the order of the calls. Shared
/// by all recorders, so that a figure means the same wherever it comes from.
class RunStatistics {
 public:
  /// Takes in what a run gives its recorders.
  void take(const Record& record);

  void entity(const EntityRecord& entity);
  void truth(Time time, EntityId id, const VehicleState& state);
  /// See FlightStatistics.
  void estimate(Time time, EntityId id, const Vec3& p_N,
                std::optional<double> cross_track) {
    last_flown_ = std::max(last_flown_, time);
    flight_statistics_.estimate(time, id, p_N, cross_track);
  }
  void reserve(EntityId id, double reserve) { flight_statistics_.reserve(id, reserve); }
  PayloadStatistics& payload() { return payload_; }
  MissionStatistics& missions() { return missions_; }
  ForecastStatistics& forecasts() { return forecasts_; }
  MemoryStatistics& memory() { return memory_; }
  SeparationStatistics& separation() { return separation_; }
  TeamStatistics& team() { return team_; }
  TrafficStatistics& traffic() { return traffic_; }
  AlertStatistics& alerts() { return alerts_; }
  RadioStatistics& radio() { return radio_; }
  void reading() { ++observations_; }
  void crossing(const Crossing& crossing);
  /// An event of the kind kAllocation starts the allocation phase; those between
  /// kOverConfident and kTrusted bound the time in which the belief is distrusted.
  void event(const Event& event);
  /// Compares, gathers and returns the metrics with their latencies; scores forecasts for
  /// this time.
  PerimeterMetrics perimeter(const PerimeterRecord& record, const TrueBoundary& truth);
  /// Gathers metrics that were computed before (a reader of stored ones). Figures of the
  /// mission that came first have no prefix; others `mission_<name>_`.
  void metrics(Time time, const Believer& who, const PerimeterMetrics& metrics);

  /// The figures so far, without those of the clock: counts, distances flown, and
  /// `<metric>_mean`, `_final`, `_run_mean` (before the unit).
  std::map<std::string, double> figures() const;

 private:
  struct Mean {
    double sum = 0;
    double count = 0;
    void add(double value) {
      sum += value;
      count += 1;
    }
  };
  struct Gathered {
    Mean allocation, run;
    std::optional<double> final;
  };
  using Gathering = std::vector<Gathered>;  // of each metric field
  struct Flight {
    std::string name;
    std::optional<Vec3> last;
    double distance = 0;
  };

  std::map<EntityId, Flight> flights_;
  FlightStatistics flight_statistics_;
  PayloadStatistics payload_;
  MissionStatistics missions_;
  ForecastStatistics forecasts_;
  MemoryStatistics memory_;
  SeparationStatistics separation_;
  TeamStatistics team_;
  TrafficStatistics traffic_;
  AlertStatistics alerts_;
  RadioStatistics radio_;
  ReadingAges ages_;
  std::vector<std::pair<Believer, Gathering>> gathered_;  // in order of first beliefs
  std::optional<Time> allocation_start_;
  bool judged_ = false;  // whether the belief agrees with its crossings is known
  std::optional<Time> over_confident_since_;
  Time over_confident_, last_metrics_;
  std::set<EntityId> aircraft_;
  Time last_flown_;  // of a true state, or an estimate
  std::uint64_t observations_ = 0, crossings_ = 0;
};

}  // namespace skein::record
