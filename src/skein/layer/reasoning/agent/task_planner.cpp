// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/task_planner.h"

#include <fmt/format.h>

#include <utility>

namespace skein::reasoning {
namespace {

constexpr double kRestAgain = 20;  // what is left, unchanged [s]

// @returns  why the aircraft cannot fly so; empty: it does from now on.
std::string set_flight(FlightContext& context, const FlightChange& change) {
  FlightLimits& limits = context.limits;
  if (change.airspeed && !(*change.airspeed >= limits.slowest &&
                           *change.airspeed <= limits.fastest && *change.airspeed > 0))
    return fmt::format("{:.1f} m/s is not flown by this aircraft, but {:.1f} to {:.1f}",
                       *change.airspeed, limits.slowest, limits.fastest);
  if (change.altitude_agl && !(*change.altitude_agl > 0))
    return fmt::format("{:.1f} m is not above the ground", *change.altitude_agl);
  if (change.altitude_agl) context.altitude_agl = *change.altitude_agl;
  if (change.airspeed) {
    const double ratio = *change.airspeed / limits.airspeed;
    limits.turn_radius *= ratio * ratio;  // with the same bank
    limits.airspeed = *change.airspeed;
    context.ordered_airspeed = change.airspeed;
  }
  return {};
}

}  // namespace

void TaskPlanner::begin(const TaskKind& task) {
  auto made = make_(task, context_);
  if (!made) return;
  executor_ = std::move(made).value();
  kind_ = kind_of(task);
  state_ = TaskState::kFlying;
}

bool TaskPlanner::receive(const AgentInput& in, AgentOutput& out) {
  bool other = false;
  for (const Message& message : in.inbox) {
    if (const auto* task = std::get_if<Task>(&message.content))
      other = take(*task, in, out) || other;
    else if (const auto* change = std::get_if<TaskChange>(&message.content))
      obey(*change, in.now, out);
    else if (const auto* flight = std::get_if<FlightChange>(&message.content))
      obey(*flight, in, out);
  }
  return other;
}

bool TaskPlanner::take(const Task& task, const AgentInput& in, AgentOutput& out) {
  if (order_ > 0 && task.number <= order_) return false;
  order_ = number_ = task.number;
  assigned_.reset();
  if (in.autopilot.held.empty()) {
    if (fly(task.what, in.now, out)) return true;
  } else {
    kind_ = kind_of(task.what);
    refuse(in.now, in.autopilot.held, out);
  }
  Message report;
  report.to = station_;
  report.content = TaskReport{number_, state_, refused_, task.what};
  out.outbox.push_back(std::move(report));
  return true;
}

bool TaskPlanner::assign(std::optional<std::uint32_t> number,
                         const std::optional<TaskKind>& what, Time now,
                         AgentOutput& out) {
  if (is_ordered() || number == assigned_) return false;
  assigned_ = number;
  number_ = 0;
  if (what) {
    fly(*what, now, out);
  } else {
    executor_.reset();
    state_ = number ? TaskState::kImpossible : TaskState::kNone;
  }
  return true;
}

// @returns  whether this aircraft is able to.
bool TaskPlanner::fly(const TaskKind& what, Time now, AgentOutput& out) {
  kind_ = kind_of(what);
  auto made = make_(what, context_);
  if (!made) {
    refuse(now, made.error().message, out);
    return false;
  }
  executor_ = std::move(made).value();
  state_ = TaskState::kFlying;
  out.events.push_back({now, context_.self, EventKind::kTask, named(), numbers()});
  return true;
}

void TaskPlanner::refuse(Time now, std::string_view why, AgentOutput& out) {
  executor_.reset();
  state_ = TaskState::kImpossible;
  refused_ = why;
  out.events.push_back({now, context_.self, EventKind::kTaskRefused,
                        fmt::format("{}: {}", kind_, refused_), numbers()});
}

std::string TaskPlanner::named() const {
  return assigned_ ? fmt::format("team task {}: {}", *assigned_, kind_)
                   : fmt::format("task {}: {}", number_, kind_);
}

EventNumbers TaskPlanner::numbers() const {
  if (assigned_) return {.team_task = assigned_};
  return {.task = number_};
}

void TaskPlanner::obey(const TaskChange& change, Time now, AgentOutput& out) {
  if (change.number <= order_) return;
  order_ = change.number;
  if (!executor_) return;
  switch (change.action) {
    case TaskAction::kPause:
      if (state_ != TaskState::kFlying) return;
      executor_->interrupt();
      return set(TaskState::kPaused, now, EventKind::kTaskPaused, {}, out);
    case TaskAction::kResume:
      if (state_ != TaskState::kPaused) return;
      return set(TaskState::kFlying, now, EventKind::kTaskResumed, {}, out);
    case TaskAction::kCancel:
      executor_.reset();
      return set(TaskState::kNone, now, EventKind::kTaskCancelled, {}, out);
  }
}

void TaskPlanner::obey(const FlightChange& change, const AgentInput& in,
                       AgentOutput& out) {
  if (change.number > flight_change_) {
    flight_change_ = change.number;
    const Time now = in.now;
    const std::string why = in.autopilot.held.empty() ? set_flight(context_, change)
                                                      : std::string(in.autopilot.held);
    if (!why.empty()) {
      out.events.push_back({now, context_.self, EventKind::kFlightRefused, why});
    } else {
      out.events.push_back(
          {now, context_.self, EventKind::kFlightChanged,
           fmt::format("{:.0f} m above ground at {:.1f} m/s", context_.altitude_agl,
                       context_.limits.airspeed)});
      begin_again(change, now, out);
    }
  }
  Message known;
  known.to = station_;
  known.content =
      FlightChange{flight_change_, context_.altitude_agl, context_.limits.airspeed};
  out.outbox.push_back(std::move(known));
}

// What is left of the task is flown as the context says now.
void TaskPlanner::begin_again(const FlightChange& change, Time now, AgentOutput& out) {
  if (!executor_) return;
  TaskKind rest = executor_->rest();
  if (auto* to = std::get_if<FlyTo>(&rest); to && change.altitude_agl)
    to->altitude_msl.reset();
  executor_->interrupt();
  auto made = make_(rest, context_);
  if (made) {
    executor_ = std::move(made).value();
    return;
  }
  executor_.reset();
  refused_ = made.error().message;
  set(TaskState::kImpossible, now, EventKind::kTaskImpossible, refused_, out);
}

void TaskPlanner::set(TaskState state, Time now, EventKind event, std::string_view why,
                      AgentOutput& out) {
  state_ = state;
  std::string text = named();
  if (!why.empty()) text.append(": ").append(why);
  out.events.push_back({now, context_.self, event, std::move(text), numbers()});
}

void TaskPlanner::listen(const TaskStep& step) {
  if (executor_) executor_->listen(step);
}

const FlightIntent* TaskPlanner::plan(const FlightIntent* given, const TaskStep& step,
                                      AgentOutput& out) {
  computing_ = false;
  if (!executor_ || !flies()) return given;
  const FlightIntent* own = executor_->plan(step, out);
  const TaskProgress progress = executor_->progress(step.in);
  if (!progress.impossible.empty()) {
    set(TaskState::kImpossible, step.in.now, EventKind::kTaskImpossible,
        progress.impossible, out);
    return given;
  }
  if (progress.done && state_ == TaskState::kFlying)
    set(TaskState::kDone, step.in.now, EventKind::kTaskDone, {}, out);
  computing_ = !own;
  return own ? own : given;
}

std::string_view TaskPlanner::reason() const {
  if (state_ == TaskState::kPaused) return "paused";
  if (state_ == TaskState::kImpossible) return "impossible";
  if (computing_) return "planning";
  return executor_ ? kind_ : std::string_view();
}

TaskProgress TaskPlanner::progress(const AgentInput& in) const {
  return executor_ ? executor_->progress(in) : TaskProgress();
}

std::optional<double> TaskPlanner::altitude_msl() const {
  return executor_ ? executor_->altitude_msl() : std::nullopt;
}

void TaskPlanner::report(const AgentInput& in, AgentOutput& out) {
  if (!executor_ || number_ == 0) return;
  const Reported now{state_, number_, executor_->version()};
  // Who knows the order knows what is left of it until that changes.
  if (now.version == 0 && state_ != TaskState::kImpossible) return;
  if (now == reported_ && (in.now < report_again_ || !flies())) return;
  reported_ = now;
  report_again_ = in.now + Time::from_seconds(kRestAgain);
  Message report;
  report.to = station_;
  report.content =
      TaskReport{number_, state_, executor_->progress(in).impossible, executor_->rest()};
  out.outbox.push_back(std::move(report));
}

}  // namespace skein::reasoning
