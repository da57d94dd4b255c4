// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/onboard_team.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "skein/layer/reasoning/team/onboard/packed_task.h"

namespace skein::reasoning {
namespace {

constexpr double kUnable = 60;        // after a task that it cannot fly [s]
constexpr int kMaxDoublings = 6;      // of that
constexpr double kEndurance = 86400;  // while nothing is known of it [s]
constexpr double kNotDone = 0.999;    // of a task, at most, until it is done
constexpr double kLearnAgain = 1;     // of wind and zones, after [s]

// Of tasks for groups, which several fly, events have no number.
Event event_of(Time now, EntityId self, EventKind kind, const TeamTask& task) {
  Event event{now, self, kind,
              fmt::format("{}{}: {}", task.single ? "" : "group ", task.number,
                          name_of_kind(task))};
  if (task.single) event.numbers.team_task = task.number;
  return event;
}

}  // namespace

OnboardTeam::OnboardTeam(EntityId self, OnboardTeamOptions options)
    : self_(self),
      options_(std::move(options)),
      link_(self, with_sharing(options_.config, options_.sharing, conditions_)) {
  resources_.speed = static_cast<float>(options_.cruise);
  resources_.sensors = options_.sensors;
}

void OnboardTeam::step(const AgentInput& in, const TeamWork& work, AgentOutput& out) {
  note(work, in.now);
  learn(in, work);
  say_resources(in, work);
  link_.step(in, out);
  take_task(in.now, out);
}

void OnboardTeam::note(const TeamWork& work, Time now) {
  if (!work.task) return;
  if (work.state == TaskState::kImpossible) refuse(*work.task, now);
  if (work.state == TaskState::kNone) unable_until_ = now + Time::from_seconds(kUnable);
  const bool done = work.state == TaskState::kDone;
  if (done) flown_.insert(*work.task);
  link_.member().set_progress(*work.task,
                              done ? 1 : std::clamp(work.share, 0.0, kNotDone));
}

void OnboardTeam::refuse(std::uint32_t task, Time now) {
  Refusal& refusal = refusals_[task];
  if (refusal.times > 0 && now < refusal.until) return;
  refusal.until = now + Time::from_seconds(std::ldexp(kUnable, refusal.times));
  refusal.times = std::min(refusal.times + 1, kMaxDoublings);
}

void OnboardTeam::learn(const AgentInput& in, const TeamWork& work) {
  if (!in.nav) return;
  if (!learned_) {
    resources_.home_north = static_cast<std::int32_t>(std::lround(in.nav->p_N.x()));
    resources_.home_east = static_cast<std::int32_t>(std::lround(in.nav->p_N.y()));
  }
  if (learned_ && in.now - *learned_ < Time::from_seconds(kLearnAgain)) return;
  learned_ = in.now;
  conditions_.set_wind(in.nav->wind_N);
  conditions_.set_zones(work.zones, -in.nav->p_N.z(), in.now.seconds());
}

void OnboardTeam::say_resources(const AgentInput& in, const TeamWork& work) {
  if (in.nav) resources_.place = in.nav->p_N;
  resources_.endurance = static_cast<float>(
      std::clamp(in.autopilot.endurance.value_or(kEndurance), 0.0, kEndurance));
  resources_.able = in.nav != nullptr && work.free && in.now >= unable_until_;
  resources_.refused.clear();
  for (const auto& [task, refusal] : refusals_)
    if (in.now < refusal.until) resources_.refused.push_back(task);
  link_.member().set_resources(resources_);
  link_.member().leave(work.leaves);
}

bool OnboardTeam::may_begin(std::uint32_t task) const {
  if (flown_.contains(task) || refuses(resources_, task)) return false;
  const auto& known = link_.member().knowledge().tasks;
  const auto found = known.find(task);
  return found == known.end() ||
         std::ranges::all_of(found->second.after, [&](std::uint32_t before) {
           const auto other = known.find(before);
           return flown_.contains(before) || (other != known.end() && other->second.done);
         });
}

void OnboardTeam::take_task(Time now, AgentOutput& out) {
  const auto& executed = link_.member().tasks();
  // Who leads may not know yet what is done or refused: what comes next is flown at once.
  const auto next = std::ranges::find_if(
      executed, [this](std::uint32_t number) { return may_begin(number); });
  if (next == executed.end()) {
    if (task_)
      out.events.push_back(event_of(now, self_, EventKind::kTeamTaskOver, *task_));
    task_.reset();
    return;
  }
  if (task_ && task_->number == *next) return;
  const auto& known = link_.member().knowledge().tasks;
  const auto found = known.find(*next);
  if (found == known.end()) return;
  if (task_) out.events.push_back(event_of(now, self_, EventKind::kTeamTaskOver, *task_));
  task_ = found->second;
  out.events.push_back(event_of(now, self_, EventKind::kTeamTask, *task_));
}

}  // namespace skein::reasoning
