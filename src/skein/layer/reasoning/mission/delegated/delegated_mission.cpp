// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/mission/delegated/delegated_mission.h"

#include <algorithm>
#include <utility>

#include "skein/layer/reasoning/team/onboard/task_needs.h"

namespace skein::reasoning {

DelegatedMission::DelegatedMission(std::string name, std::vector<DelegatedTask> tasks,
                                   std::shared_ptr<TeamServer> desk)
    : name_(std::move(name)), tasks_(std::move(tasks)), desk_(std::move(desk)) {}

void DelegatedMission::step(const AgentInput& in, AgentOutput& out) {
  if (!begun_) begun_ = in.now;
  desk_->open(name_);
  hand_in(in.now);
  desk_->step(in, out);
}

void DelegatedMission::hand_in(Time now) {
  while (handed_in_ < tasks_.size() && now - *begun_ >= tasks_[handed_in_].at) {
    DelegatedTask& next = tasks_[handed_in_++];
    for (const std::size_t before : next.after)
      next.task.after.push_back(numbers_[before]);
    numbers_.push_back(desk_->hand_in(name_, {&next.task, 1}, now).front());
  }
}

MissionDemand DelegatedMission::demand() const {
  MissionDemand demand{0, 0, std::nullopt};
  if (!tasks_.empty()) demand.place = needs_of(tasks_.front().task.what).begin;
  return demand;
}

bool DelegatedMission::done() const {
  return handed_in_ == tasks_.size() && desk_->is_all_added_done() &&
         std::ranges::all_of(numbers_, [&](auto task) { return desk_->is_done(task); });
}

}  // namespace skein::reasoning
