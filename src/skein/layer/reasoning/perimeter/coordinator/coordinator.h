// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/data/airspace/zone_set.h"
#include "skein/layer/reasoning/perimeter/confidence/confidence_monitor.h"
#include "skein/layer/reasoning/perimeter/coordinator/belief.h"
#include "skein/layer/reasoning/perimeter/coordinator/forecast_calibration.h"
#include "skein/layer/reasoning/perimeter/coordinator/roster.h"
#include "skein/role/mission.h"
#include "skein/role/monitoring_strategy.h"

namespace skein::perimeter {

struct CoordinatorOptions {
  std::vector<EntityId> team;  ///< the aircraft it commands
  Vec2 origin = Vec2::Zero();  ///< believed origin of the fire [m]
  /// Courses of the deployment transects, one per aircraft, repeated when there are fewer
  /// [rad]; empty = each flies towards the origin.
  std::vector<double> entry_courses;
  /// Each first flies to an entry of its own, so that they come from all sides
  /// (plan_entries); `entry_courses` do not count then.
  bool all_sides = false;
  double forced_crossing = 300;  ///< no crossing for this long: go and cross [s]; 0 = off
  double deployment_limit = 600;  ///< a transect without crossing ends after this [s]
  double lost_after = 5;          ///< an aircraft silent for this long is lost [s]
  double late_window = 60;        ///< readings this late still count [s]
  std::vector<Zone> zones;        ///< no-fly zones in force from the start
  std::uint32_t phenomenon = 0;  ///< whose perimeter: its place in the environment's list
  ForecastOptions forecast;      ///< of the perimeter, from the allocation phase on
  /// Between two beliefs that are given to be recorded.
  Time record_period = Time::from_seconds(5);
};

/// A perimeter mission: keeps the belief from all readings, runs the deployment phase,
/// lets the strategy decide, and orders the aircraft about.
///
/// Deployment: each aircraft flies its transect until its first crossing, towards the
/// origin from where it is, on a given course, or from an entry on its own side; then it
/// is allocated. When all in contact are allocated, the event "allocation" marks the
/// start of that phase, even if some transects met nothing.
///
/// No order leads into a no-fly zone in force, or soon in force, at the altitude of any
/// aircraft.
///
/// Warnings about the belief become events: "outlier" (readings set aside), "too-late"
/// (readings older than `late_window`), "over-confident" and "trusted" (see
/// ConfidenceMonitor), "hand-over" (the estimator went over to another method).
class Coordinator : public Mission {
 public:
  Coordinator(const CoordinatorOptions& options,
              std::unique_ptr<PerimeterEstimator> estimator,
              std::unique_ptr<MonitoringStrategy> strategy);

  void step(const AgentInput& in, AgentOutput& out) override;
  MissionDemand demand() const override;
  MissionGoal goal() const override { return PerimeterGoal{options_.phenomenon}; }

 private:
  // A number that grows and is reported now and then.
  struct Tally {
    int reported = 0;
    Time reported_at;
    bool is_news(int now_counted, Time now);
  };

  void listen(const AgentInput& in, AgentOutput& out);
  void report_confidence(Time now, AgentOutput& out);
  void deploy(Time now, AgentOutput& out);
  void begin_transects(Time now, AgentOutput& out);
  void send_to_entries(Time now, AgentOutput& out);
  void force_crossings(Time now, AgentOutput& out);
  void allocate(Time now, AgentOutput& out);
  void resend_lost_orders(const AgentInput& in, AgentOutput& out);
  void order(Member& member, TaskKind what, Time now, AgentOutput& out);
  void record_belief(Time now, AgentOutput& out);
  void look_ahead(Time now, AgentOutput& out);
  void record_forecast(Forecast ahead, AgentOutput& out) const;
  void note_crossing(const Crossing& crossing, AgentOutput& out);
  void judge(const Crossing& crossing, AgentOutput& out);
  std::vector<Zone> zones_in_force(Time now) const;

  CoordinatorOptions options_;
  Belief belief_;
  std::unique_ptr<MonitoringStrategy> strategy_;
  Roster roster_;
  ZoneSet zones_;
  BoundaryEstimate boundary_;
  ConfidenceMonitor confidence_;
  Tally outliers_, dropped_;
  std::string method_;  // of the belief, for estimators that change it
  Time last_heard_;     // when a reading last came, however old
  Time next_record_, next_forecast_;
  std::optional<ForecastRun> forecast_;  // that is being made
  ForecastCalibration calibration_;
  std::optional<Time> assembled_;  // when the first aircraft was there to be deployed
  bool allocating_ = false;
};

}  // namespace skein::perimeter
