#include "skein/layer/reasoning/team/onboard/onboard_team.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "skein/layer/reasoning/team/onboard/coalition_allocation.h"
#include "skein/layer/reasoning/team/onboard/packed_task.h"

namespace skein::reasoning {
namespace {

constexpr double kUnable = 60;        // after a task that it cannot fly [s]
constexpr double kEndurance = 86400;  // while nothing is known of it [s]
constexpr double kNotDone = 0.999;    // of a task, at most, until it is done

TeamConfig with_wind(TeamConfig config, bool in_wind, const Vec2& wind) {
  if (!in_wind) return config;
  config.allocate = CoalitionAllocation([&wind] { return wind; });
  config.utility = [&wind](const TeamTask& task, const TeamResources& self,
                           std::span<const TeamTask> bundle) {
    return worth_in_wind(task, self, bundle, wind);
  };
  return config;
}

std::string text_of(const TeamTask& task) {
  const auto what = unpacked(task);
  return fmt::format("{}{}: {}", task.single ? "" : "group ", task.number,
                     what ? kind_of(*what) : "nothing");
}

}  // namespace

OnboardTeam::OnboardTeam(EntityId self, OnboardTeamOptions options)
    : self_(self),
      options_(std::move(options)),
      link_(self, with_wind(options_.config, options_.in_wind, wind_)) {
  resources_.speed = options_.cruise;
  resources_.sensors = options_.sensors;
}

void OnboardTeam::step(const AgentInput& in, const TeamWork& work, AgentOutput& out) {
  note(work, in.now);
  say_resources(in, work);
  link_.step(in, out);
  take_task(in.now, out);
}

void OnboardTeam::note(const TeamWork& work, Time now) {
  if (!work.task) return;
  if (work.state == TaskState::kImpossible || work.state == TaskState::kNone)
    unable_until_ = now + Time::from_seconds(kUnable);
  const bool done = work.state == TaskState::kDone;
  link_.member().set_progress(*work.task,
                              done ? 1 : std::clamp(work.share, 0.0, kNotDone));
}

void OnboardTeam::say_resources(const AgentInput& in, const TeamWork& work) {
  if (in.nav) {
    resources_.place = in.nav->p_N;
    wind_ = in.nav->wind_N;
  }
  resources_.endurance =
      std::clamp(in.autopilot.endurance.value_or(kEndurance), 0.0, kEndurance);
  resources_.able = in.nav != nullptr && work.free && in.now >= unable_until_;
  link_.member().set_resources(resources_);
  link_.member().leave(work.leaves);
}

void OnboardTeam::take_task(Time now, AgentOutput& out) {
  const auto& executed = link_.member().tasks();
  if (executed.empty()) {
    if (task_) out.events.push_back({now, self_, "team-task-over", text_of(*task_)});
    task_.reset();
    return;
  }
  if (task_ && task_->number == executed.front()) return;
  const auto& known = link_.member().knowledge().tasks;
  const auto found = known.find(executed.front());
  if (found == known.end()) return;
  if (task_) out.events.push_back({now, self_, "team-task-over", text_of(*task_)});
  task_ = found->second;
  out.events.push_back({now, self_, "team-task", text_of(*task_)});
}

}  // namespace skein::reasoning
