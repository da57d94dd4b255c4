// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/own_tasks.h"

#include <algorithm>

#include "skein/layer/reasoning/team/protocol/allocation.h"
#include "skein/layer/reasoning/team/protocol/knowledge.h"

namespace skein::reasoning {

void OwnTasks::set_resources(const TeamResources& resources) {
  resources_ = resources;
  refused_as_given_ = resources.refused;
}

bool OwnTasks::execute(std::vector<std::uint32_t> tasks) {
  if (!resources_.able) tasks.clear();
  if (tasks == executing_) return false;
  executing_ = std::move(tasks);
  return true;
}

bool OwnTasks::executes(std::uint32_t task) const {
  return std::ranges::find(executing_, task) != executing_.end();
}

bool OwnTasks::has_done(std::uint32_t task) const {
  const auto share = progress_.find(task);
  return share != progress_.end() && share->second >= 1;
}

std::vector<std::uint32_t> OwnTasks::done() const {
  std::vector<std::uint32_t> all;
  for (const auto& [task, share] : progress_)
    if (share >= 1) all.push_back(task);
  return all;
}

std::vector<TeamProgress> OwnTasks::progress(const TeamKnowledge& knowledge) const {
  std::vector<TeamProgress> all;
  for (const std::uint32_t task : executing_) {
    const auto share = progress_.find(task);
    all.push_back({task, share == progress_.end() ? 0 : share->second});
  }
  for (const std::uint32_t task : done())
    if (!executes(task) && !knowledge.is_over(task)) all.push_back({task, 1});
  return all;
}

void OwnTasks::renew_refusals(
    const std::function<bool(std::uint32_t task, EntityId other)>& still_flies) {
  std::erase_if(yielded_,
                [&](const auto& each) { return !still_flies(each.first, each.second); });
  resources_.refused = refused_as_given_;
  for (const auto& [task, other] : yielded_)
    if (!refuses(resources_, task)) resources_.refused.push_back(task);
}

}  // namespace skein::reasoning
