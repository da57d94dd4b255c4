// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/layer/reasoning/task/planned_task.h"
#include "skein/layer/reasoning/task/tour/tour_plan.h"

namespace skein::reasoning {

/// How tours are planned and flown.
struct TourOptions {
  TourCurves curves = TourCurves::kTrochoids;
  double radius_factor = 1.2;  ///< planned turns, over the minimum radius of the aircraft
  double settling = 30;        ///< circling before planning, to learn of the wind [s]
  bool keeps_times = true;     ///< flies the plan in time; else at cruise airspeed
  bool replans = true;         ///< when the execution leaves the safety zone
};

/// Flies through points on turns and straights that it plans for the wind, each lap anew
/// with the wind as its autopilot then believes it to be; then stays at the end.
class TourTask final : public PlannedTask {
 public:
  TourTask(const FlightContext& context, const FlyTour& order,
           const TourOptions& options);

  TaskProgress progress(const AgentInput& in) const override;
  TaskKind rest() const override;
  std::uint32_t version() const override { return static_cast<std::uint32_t>(passed_); }
  std::optional<double> altitude_msl() const override { return altitude_msl_; }

 private:
  Part plan_part(const Start& start, const TaskStep& step) override;
  void pass(const TaskStep&) override { ++passed_; }
  bool finish(const TaskStep& step, AgentOutput& out) override;
  const FlightIntent* before(const TaskStep& step, AgentOutput& out) override;
  double altitude_of_plans(const NavEstimate&) const override { return altitude_msl_; }
  std::size_t visits() const;

  TourOptions options_;
  FlyTour order_;
  double altitude_msl_;
  std::vector<double> courses_;
  std::optional<Time> begin_;  // of planning
  FlightIntent settling_;
  std::size_t passed_ = 0, planned_ = 0;  // points of all laps
};

}  // namespace skein::reasoning
