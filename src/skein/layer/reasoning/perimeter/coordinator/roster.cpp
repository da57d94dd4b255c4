// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/coordinator/roster.h"

namespace skein::perimeter {

Roster::Roster(std::span<const EntityId> members, double lost_after)
    : lost_after_(lost_after) {
  for (const EntityId id : members) {
    Member member;
    member.status.id = id;
    members_.push_back(member);
  }
}

Member* Roster::find(EntityId id) {
  for (Member& member : members_)
    if (member.status.id == id) return &member;
  return nullptr;
}

bool Roster::take(const AircraftReport& report, EntityId from, Time now) {
  Member* member = find(from);
  if (!member) return false;
  if (member->heard && report.nav.time < member->status.nav.time)
    return true;  // overtaken
  if (report.limits) {
    member->status.limits = *report.limits;
    member->has_limits = true;
  }
  const bool available = report.obeys && member->has_limits;
  if (!member->available && available)
    member->deployed = now;  // (re)joins: its clocks start anew
  if (member->available && !available) member->forced = false;
  member->heard = true;
  member->available = available;
  member->last_report = now;
  member->status.nav = report.nav;
  member->silence_allowed = silence_allowed(report, lost_after_);
  member->reported_task = report.task_number;
  member->status.task_done = report.task_state == TaskState::kDone &&
                             report.task_number == member->status.task.number;
  return true;
}

std::vector<EntityId> Roster::update(Time now) {
  std::vector<EntityId> silent;
  for (Member& member : members_) {
    if (!member.available ||
        (now - member.last_report).seconds() <= member.silence_allowed)
      continue;
    member.available = false;
    member.forced = false;
    silent.push_back(member.status.id);
  }
  return silent;
}

}  // namespace skein::perimeter
