#pragma once

#include <optional>
#include <vector>

#include "skein/layer/reasoning/agent/task_executor.h"
#include "skein/layer/reasoning/tour/tour_plan.h"

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
/// with the wind as its autopilot then believes it to be; then stays at the end. Where
/// the plan leads into a no-fly zone it flies around.
///
/// When the wind is as strong as its airspeed there is no plan: it goes on circling,
/// reports so, and tries again; so it does when its autopilot refuses a plan.
class TourTask final : public TaskExecutor {
 public:
  TourTask(const TaskContext& context, const FlyTour& order, const TourOptions& options);

  void fly(const TaskStep& step, AgentOutput& out) override;
  bool done() const override { return done_; }
  std::optional<double> altitude_msl() const override { return altitude_msl_; }

 private:
  void fly_plan(const AgentInput& in, AgentOutput& out);
  void plan_on(const AgentInput& in, const FlightState& from, double start,
               AgentOutput& out);
  void forget_plan(double now);
  std::size_t visits() const;

  TourOptions options_;
  EntityId self_;
  FlightLimits limits_;
  FlyTour order_;
  double altitude_msl_;
  std::vector<double> courses_;
  std::optional<Time> begin_;   // of planning
  FlightPlan plan_;             // what is being flown
  std::vector<double> passes_;  // of all points so far, as planned [s]
  bool done_ = false, stuck_ = false, was_off_plan_ = false;
};

}  // namespace skein::reasoning
