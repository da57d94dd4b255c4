// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/member_state.h"

#include <algorithm>
#include <set>

namespace skein::reasoning {
namespace {

constexpr double kMinRepeatPeriods = 0.3;  // query periods
constexpr double kUnknownRoundTrip = 16;   // [s] that is taken for normal until measured
constexpr double kManyLost = 0.15;         // of messages: then nothing is left out
constexpr double kSameLoss = 0.05;         // by which members may measure it otherwise

}  // namespace

MemberState::MemberState(EntityId id, TeamConfig how)
    : self(id),
      config(std::move(how)),
      contacts(id, config.known),
      outbox(id),
      jitter(config.seed, id.value, Purpose::kTeam) {
  lost = time_until_lost(times(), contacts.loss());
  status.members = {self};
}

void MemberState::begin(Time time) {
  now = time.seconds();
  outbox.begin(time);
  if (next_query != 0 || next_inform != 0) return;
  // Not all at the same moment.
  next_query = now + times().query_period * jitter.uniform();
  next_inform = now + times().query_period * jitter.uniform();
}

// Without a diameter that is given: that of the box around all tasks.
void MemberState::measure_loss() {
  TeamTimes known = times();
  if (known.mission_diameter <= 0 && !knowledge.tasks.empty()) {
    Vec2 low = knowledge.tasks.begin()->second.place, high = low;
    for (const auto& [number, task] : knowledge.tasks) {
      low = low.cwiseMin(task.place);
      high = high.cwiseMax(task.place);
    }
    known.mission_diameter = (high - low).norm();
  }
  lost = time_until_lost(known, contacts.loss());
}

double MemberState::after(double last) {
  const double period = times().query_period;
  const double interval = period * (1 + times().jitter * (2 * jitter.uniform() - 1));
  return std::max(last, now - period) + interval;
}

double MemberState::repeat_after() const {
  return std::max(kMinRepeatPeriods * times().query_period, 2 * round_trip);
}

double MemberState::exchange_time() const {
  return lost + (round_trip > 0 ? round_trip : kUnknownRoundTrip);
}

// The longer from message to message, the longer it is asked by its orders before.
double MemberState::follower_lost_after() const {
  if (contacts.loss() > kManyLost + kSameLoss) return lost;
  const double period = follower_period(times(), status.members.size());
  return lost + 3 * (period - times().query_period);
}

bool MemberState::loses_many() const {
  return contacts.loss() > kManyLost;
}

bool MemberState::is_of_lineage(const std::optional<TeamMission>& other) const {
  return mission && other && mission->name == other->name && !is_sibling(other);
}

bool MemberState::is_sibling(const std::optional<TeamMission>& other) const {
  return mission && other && mission->name == other->name && mission->branch &&
         other->branch && mission->branch != other->branch;
}

void MemberState::execute(std::vector<std::uint32_t> tasks) {
  if (own.execute(std::move(tasks))) next_inform = std::min(next_inform, now);
}

void MemberState::finish_own() {
  for (const std::uint32_t task : own.done()) finish(task);
}

void MemberState::take_progress(const TeamInform& inform) {
  for (const TeamProgress& progress : inform.tasks)
    if (progress.share >= 1) finish(progress.task);
}

TeamWorker MemberState::own_worker() const {
  TeamInform said;
  said.resources = own.resources();
  said.tasks = own.progress(knowledge);
  return worker_of(self, said);
}

TeamInform MemberState::inform() const {
  TeamInform said;
  said.mission = mission;
  if (follows()) said.master = leader.id;
  if (leads()) said.master = self;
  if (const auto* contact = leader.id ? contacts.find(*leader.id) : nullptr;
      contact && follows() && contact->leads) {
    said.query = contact->query_number;
    said.held = static_cast<float>(std::max(0.0, now - contact->queried));
  }
  said.members_hash = hash_of_members(status.members);
  said.state_number = knowledge.number();
  said.leaving = leaves();
  said.resources = own.resources();
  said.tasks = own.progress(knowledge);
  return said;
}

void MemberState::set_status(TeamReason reason) {
  TeamStatus next{mission, std::nullopt, {self}, reason};
  if (leads() || role == TeamRole::kAlone) next.master = self;
  if (follows()) next.master = leader.id;
  if (role != TeamRole::kAlone) {
    std::set<EntityId> all(members.begin(), members.end());
    all.insert(self);
    next.members.assign(all.begin(), all.end());
  }
  if (reason == TeamReason::kMembers) next.reason = status.reason;
  status = std::move(next);
}

}  // namespace skein::reasoning
