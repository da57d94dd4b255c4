// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "skein/layer/reasoning/agent/task_executor.h"

namespace skein::reasoning {

/// How a task that is flown by plans has them flown.
struct PlannedTaskOptions {
  double radius_factor = 1.1;  ///< planned turns, over the minimum radius of the aircraft
  bool in_time = true;         ///< plans are flown in time; else at cruise airspeed
  bool over_ground = true;     ///< at the aircraft's height above ground; else as planned
  /// Off its plan it joins the plan again; else it plans anew, unless `stubborn`.
  bool rejoins = true;
  bool stubborn = false;
  bool for_wind = true;  ///< planned anew for another wind
  bool stays = true;     ///< at the end, as far as is known; see Itinerary::stays
};

/// A task that is flown on turns and straights planned for the wind.
///
/// What is left of it is planned from where the aircraft is, wings level, when it begins,
/// after a pause, and when the wind has become another than it was planned for; before
/// the end of a part of it the next one is planned on from there. The trajectory planner
/// leads such a plan around zones and back to it (Itinerary). Without a plan, as in too
/// strong a wind, the aircraft loiters and tries again ten seconds later.
class PlannedTask : public TaskExecutor {
 public:
  const FlightIntent* plan(const TaskStep& step, AgentOutput& out) final;
  TaskProgress progress(const AgentInput& in) const override;
  void interrupt() override { intent_.number = 0; }

 protected:
  PlannedTask(const FlightContext& context, const PlannedTaskOptions& options)
      : context_(context), options_(options) {}

  /// From where and in what a part is planned.
  struct Start {
    FlightState state;         ///< at the altitude of the plan
    double time = 0;           ///< [s]
    FlightLimits limits;       ///< with the turn radius of plans
    Vec2 wind = Vec2::Zero();  ///< as believed now [m/s]
  };

  /// What is planned at a time.
  struct Part {
    FlightPlan plan;
    std::vector<double> milestones;  ///< see Itinerary
    bool last = true;                ///< nothing comes after it
    bool nothing = false;            ///< there is nothing left to fly
    std::string why_not;             ///< why the plan is empty
    bool never = false;              ///< and that it always will be
  };

  /// What is left of the task, or the next part of it.
  virtual Part plan_part(const Start& start, const TaskStep& step) = 0;

  /// A milestone has been passed, in their order. Those that were left out, as they lie
  /// in no-fly zones, count as passed.
  virtual void pass(const TaskStep&) {}

  /// The last part has been flown. @returns whether nothing is left; else it plans anew.
  virtual bool finish(const TaskStep&, AgentOutput&) { return true; }

  /// At each step, before it plans. @returns what to fly instead; null: nothing.
  virtual const FlightIntent* before(const TaskStep&, AgentOutput&) { return nullptr; }

  /// Of plans [m]; on the way to them the aircraft climbs or sinks.
  virtual double altitude_of_plans(const NavEstimate& nav) const;

  /// Where it stays when it is done: the end of its last plan.
  virtual std::optional<Vec2> end_place() const { return std::nullopt; }

  /// Has all that is left planned anew at the next step.
  void renew() { intent_.number = 0; }

  /// Nothing is left to do.
  void set_done() { done_ = true; }

  const FlightContext& context() const { return context_; }
  const FlightPlan& flown() const { return plan_; }
  bool done() const { return done_; }

 private:
  bool must_plan(const TaskStep& step) const;
  bool plan_on(const TaskStep& step, AgentOutput& out);
  Start start_of_part(const TaskStep& step, bool goes_on) const;
  void count_passed(const TaskStep& step, double now);
  bool take(Part part, double now, const TaskStep& step, AgentOutput& out);
  const FlightIntent* stay(const TaskStep& step);

  FlightContext context_;
  PlannedTaskOptions options_;
  FlightIntent intent_;
  FlightPlan plan_;  // as planned here
  std::vector<double> milestones_;
  std::size_t counted_ = 0;  // milestones of the intent that pass() has been told of
  bool last_ = true, done_ = false, stuck_ = false, was_off_ = false;
  Vec2 wind_ = Vec2::Zero();  // that it was planned for
  Time planned_, try_again_;
  double time_to_go_ = 0;
  int refusals_ = 0;  // of plans, one after the other
  int plans_ = 0;     // that it has made
  std::string impossible_;
};

}  // namespace skein::reasoning
