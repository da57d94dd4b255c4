// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/protocol/presence.h"

#include <algorithm>

namespace skein::reasoning {
namespace {

constexpr int kRepeatsInFull = 3;  // after a change
constexpr int kFullEvery = 5;      // query periods without a change

// But for where it is, how long it can fly and how far it is with its tasks.
bool is_same_but_for_flight(const TeamInform& a, const TeamInform& b) {
  const auto same_task = [](const TeamProgress& one, const TeamProgress& other) {
    return one.task == other.task && (one.share >= 1) == (other.share >= 1);
  };
  return a.mission == b.mission && a.master == b.master && a.leaving == b.leaving &&
         a.resources.able == b.resources.able &&
         a.resources.sensors == b.resources.sensors &&
         a.resources.speed == b.resources.speed &&
         a.resources.refused == b.resources.refused &&
         std::ranges::equal(a.tasks, b.tasks, same_task);
}

}  // namespace

void TeamPresence::say_in_full() {
  in_full_ = kRepeatsInFull;
}

void TeamPresence::send(MemberState& member) {
  TeamInform inform = member.inform();
  if (!is_same_but_for_flight(inform, informed_)) in_full_ = kRepeatsInFull;
  const bool may_shorten = member.follows() && in_full_ <= 0;
  if (inform.master != here_.master || inform.members_hash != here_.members_hash)
    regrouped_ = member.now;
  if (may_shorten) ++periods_since_full_;
  if (may_shorten && has_said_all(member, inform)) return;
  here_ = {inform.master, inform.query, inform.held, inform.members_hash,
           inform.state_number};
  said_here_ = member.now;
  if (may_shorten && periods_since_full_ < kFullEvery) {
    member.outbox.send_all(here_);
    return;
  }
  in_full_ = std::max(0, in_full_ - 1);
  periods_since_full_ = 0;
  informed_ = inform;
  member.outbox.send_all(std::move(inform));
}

// In a large team that has not changed of late, while it receives its leader: what it
// would say was sent not long ago.
bool TeamPresence::has_said_all(const MemberState& member,
                                const TeamInform& inform) const {
  const double query_period = member.times().query_period;
  const double period = follower_period(member.times(), member.status.members.size());
  return period > query_period && !member.loses_many() &&
         member.now - member.leader.evidence <= kSilentPeriods * query_period &&
         member.now - regrouped_ > member.exchange_time() &&
         inform.state_number == here_.state_number &&
         member.now - said_here_ < period - query_period / 2;
}

}  // namespace skein::reasoning
