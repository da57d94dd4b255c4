#include "skein/layer/reasoning/mission/delegated/delegated_mission.h"

#include <algorithm>
#include <utility>

#include "skein/layer/reasoning/team/onboard/task_needs.h"

namespace skein::reasoning {

DelegatedMission::DelegatedMission(std::string name, std::vector<DelegatedTask> tasks,
                                   std::shared_ptr<TeamDesk> desk)
    : name_(std::move(name)), tasks_(std::move(tasks)), desk_(std::move(desk)) {
  std::ranges::stable_sort(tasks_, {}, &DelegatedTask::after);
}

void DelegatedMission::step(const AgentInput& in, AgentOutput& out) {
  if (!begun_) begun_ = in.now;
  hand_in(in.now);
  desk_->step(in, out);
}

void DelegatedMission::hand_in(Time now) {
  std::vector<WantedTask> due;
  while (handed_in_ < tasks_.size() && now - *begun_ >= tasks_[handed_in_].after)
    due.push_back(tasks_[handed_in_++].task);
  if (due.empty()) return;
  const auto numbers = desk_->hand_in(name_, due, now);
  numbers_.insert(numbers_.end(), numbers.begin(), numbers.end());
}

MissionDemand DelegatedMission::demand() const {
  MissionDemand demand{0, 0, std::nullopt};
  if (!tasks_.empty()) demand.place = needs_of(tasks_.front().task.what).begin;
  return demand;
}

bool DelegatedMission::done() const {
  return handed_in_ == tasks_.size() &&
         std::ranges::all_of(numbers_, [&](auto task) { return desk_->is_done(task); });
}

}  // namespace skein::reasoning
