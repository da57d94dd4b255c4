#pragma once

#include "skein/layer/reasoning/agent/task_executor.h"

namespace skein::reasoning {

/// A task that commands anew at each step: it says what it wants flown at the height
/// above the ground ahead, and no-fly zones are kept out of here.
class GuidedTask : public TaskExecutor {
 public:
  explicit GuidedTask(TaskContext context) : context_(std::move(context)) {}

  void fly(const TaskStep& step, AgentOutput& out) final;

 protected:
  /// What the task wants flown, and its course over ground just ahead.
  struct Setpoint {
    decltype(AutopilotCommand::guidance) guidance;
    double course = 0;  ///< [rad]
  };

  /// @param altitude_msl  that will be commanded [m].
  virtual Setpoint next_setpoint(const TaskStep& step, double altitude_msl,
                                 AgentOutput& out) = 0;

  /// Circles a point, with room to correct in the wind.
  Setpoint circle_at(const Vec2& centre, const NavEstimate& nav) const;

  /// The radius of turns with room to correct in a wind [m].
  double wide_radius(const Vec2& wind) const;

  const TaskContext& context() const { return context_; }

 private:
  TaskContext context_;
};

}  // namespace skein::reasoning
