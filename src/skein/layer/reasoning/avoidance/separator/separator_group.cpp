// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/layer/reasoning/avoidance/manoeuvre/flight_check.h"
#include "skein/layer/reasoning/avoidance/separator/separator.h"
#include "skein/layer/reasoning/avoidance/separator/separator_common.h"
#include "skein/model/path/flight_plan.h"

// How the separator solves conflicts of several at once: who coordinates, who takes part,
// and what comes of it.

namespace skein::reasoning {
namespace {

constexpr std::size_t kMaxMembers = 12;
constexpr std::size_t kMaxEncounters = 30000;  // pairs of flights looked at by a group
constexpr double kRoundTrips = 4;    // invitation, joining, plan, acceptance; and again
constexpr double kGroupLookOn = 60;  // beyond the horizon, for encounters that count [s]
constexpr double kBeforeConflict = 1;  // what is agreed on begins [s]
constexpr double kGathering =
    2;  // until plans of all that have changed theirs are here [s]
constexpr std::size_t kMaxInvited = 64;

bool is_plausible(const GroupInvitation& invitation, double now, double horizon) {
  return std::isfinite(invitation.begin) && std::isfinite(invitation.apart) &&
         invitation.begin > now && invitation.begin < now + horizon &&
         invitation.apart > invitation.begin && invitation.apart < now + 10 * horizon &&
         invitation.members.size() <= kMaxInvited;
}

}  // namespace

void Separator::hear_of_groups(const SeparationStep& step, const Message& message) {
  const EntityId from = message.from;
  const auto is_ours = [&](EntityId coordinator, std::uint32_t number) {
    return group_ && group_->name() == NegotiationName{coordinator, number};
  };
  if (const auto* invitation = std::get_if<GroupInvitation>(&message.content)) {
    answer(step, from, *invitation);
  } else if (const auto* joining = std::get_if<GroupJoining>(&message.content)) {
    if (is_ours(self_, joining->group)) group_->take(from, *joining);
  } else if (const auto* plan = std::get_if<GroupPlan>(&message.content)) {
    if (is_ours(from, plan->group)) group_->take(from, *plan);
  } else if (const auto* acceptance = std::get_if<GroupAcceptance>(&message.content)) {
    if (is_ours(acceptance->coordinator, acceptance->group))
      group_->take(from, *acceptance);
  }
}

bool Separator::can_join(const SeparationStep& step,
                         const GroupInvitation& invitation) const {
  return !negotiation_ && !group_ && flies_plan() &&
         is_plausible(invitation, step.now.seconds(), options_.horizon) &&
         invitation.begin < model::end_time_of(own_.plan) && !keeps_on_ &&
         !flies_on(priority_) &&
         (options_.method == SeparationMethod::kAuto ||
          options_.method == SeparationMethod::kGroup);
}

void Separator::answer(const SeparationStep& step, EntityId from,
                       const GroupInvitation& invitation) {
  const auto own = std::ranges::find(invitation.members, self_, &GroupMember::who);
  if (own == invitation.members.end()) return;
  const NegotiationName name{from, invitation.group};
  if (group_ && group_->name() == name) return;
  // Of two that invite each other the lower one coordinates.
  if (group_ && group_->name().opener == self_ && from < self_ && !group_->is_solved())
    leave_group();
  const bool same_plan = own->plan == own_.number;
  plan_is_new_ = plan_is_new_ || !same_plan;  // the sender does not know it yet
  if (!same_plan || name == last_group_ || !can_join(step, invitation)) {
    answers_.push_back(
        {self_, from, 0, Time(), GroupAcceptance{from, invitation.group, false}});
    return;
  }
  group_.emplace(self_, name, invitation,
                 NegotiatingFlight{own_.plan, rejoins(invitation.apart + kRejoinsAfter),
                                   step.query.limits},
                 delay_to(from), step.now);
}

// Invites to a group where that is up to this aircraft: the lowest of the group, or after
// some time any other of it.
void Separator::open_group(const SeparationStep& step) {
  if (!flies_plan() || negotiation_ || group_ || keeps_on_) return;
  const auto first = std::ranges::find_if(conflicts_, [&](const Conflict& conflict) {
    return method_for(conflict, step.now) == SeparationMethod::kGroup;
  });
  const double now = step.now.seconds();
  if (first == conflicts_.end() || now < group_again_) return;
  const ConflictGroup found = groups_.find(step.now, conflicts_, team_.flights(),
                                           now + options_.horizon, kMaxMembers);
  if (found.others.empty()) return;
  if (group_plan_ != own_.number) {
    group_plan_ = own_.number;
    group_since_ = now;
  }
  const bool lowest = self_ < found.others.front();
  if (now < group_since_ + (lowest ? kGathering : kAskAnyway)) return;
  double delay = 0;
  for (const EntityId who : found.others) delay = std::max(delay, delay_to(who));
  GroupInvitation invitation;
  invitation.begin = static_cast<float>(now + options_.reaction +
                                        kRoundTrips * (2 * delay + kAgentStep));
  invitation.apart = static_cast<float>(found.apart);
  if (invitation.begin + kBeforeConflict > first->encounter.begin ||
      invitation.begin >= model::end_time_of(own_.plan) ||
      invitation.apart <= invitation.begin)
    return;
  for (const EntityId who : found.others)
    if (const TeamFlight* flight = team_.find(who);
        flight && invitation.begin < model::end_time_of(flight->plan))
      invitation.members.push_back({who, flight->number});
  if (invitation.members.empty()) return;
  invitation.group = ++opened_;
  group_.emplace(self_, NegotiationName{self_, invitation.group}, invitation,
                 NegotiatingFlight{own_.plan, rejoins(found.apart + kRejoinsAfter),
                                   step.query.limits},
                 delay, step.now);
}

// What comes out for those who take part, the own aircraft among them.
std::optional<std::vector<GroupManoeuvre>> Separator::solve_group(
    const SeparationStep& step, std::span<const JoinedMember> members) const {
  JointProblem problem;
  problem.begin = group_->begin();
  problem.look_until = problem.begin + options_.horizon + kGroupLookOn;
  const std::size_t n = members.size();
  std::vector<const TeamFlight*> known;  // null: the own flight
  for (const JoinedMember& each : members) {
    const TeamFlight* flight = each.who == self_ ? nullptr : team_.find(each.who);
    if (!flight && each.who != self_) return std::nullopt;
    known.push_back(flight);
    problem.members.push_back(
        {{flight ? flight->plan : own_.plan, each.rejoins, each.limits}, {}});
  }
  const auto kept = [&](const TeamFlight* a, const TeamFlight* b) {
    if (a && b) return separation_between(*a, *b);
    return separation_of(own_, a ? *a : *b);
  };
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j)
      problem.kept.push_back(i == j ? Separation() : kept(known[i], known[j]));
    for (const TeamFlight& third : team_.flights())
      if (third.conforms(step.now) &&
          std::ranges::find(members, third.who, &JoinedMember::who) == members.end())
        problem.members[i].others.push_back({&third.plan, kept(known[i], &third)});
  }
  FlightCheck check(step.query, step.zones);
  problem.is_free = [&](const FlightPlan& flight) { return check.is_free(flight); };
  const JointSolution solution = solve_jointly(problem, kMaxEncounters);
  std::vector<GroupManoeuvre> manoeuvres;
  for (std::size_t i = 0; i < n; ++i) {
    const JointChoice& choice = solution.choices[i];
    if (choice.manoeuvre.kind == ManoeuvreKind::kGoOn) continue;
    manoeuvres.push_back({members[i].who,
                          static_cast<std::uint8_t>(choice.manoeuvre.kind),
                          static_cast<float>(choice.manoeuvre.amount),
                          static_cast<float>(choice.manoeuvre.lead),
                          static_cast<float>(choice.conflict.meets),
                          static_cast<float>(choice.conflict.closest),
                          static_cast<float>(choice.conflict.apart),
                          static_cast<float>(choice.conflict.separation.horizontal),
                          static_cast<float>(choice.conflict.separation.vertical)});
  }
  if (manoeuvres.empty()) return std::nullopt;
  return manoeuvres;
}

void Separator::negotiate_group(const SeparationStep& step) {
  if (!group_) return;
  for (const EntityId who : group_->partners())
    if (const TeamFlight* other = team_.find(who);
        other && other->agreed == code_of(group_->name()))
      group_->other_flies_it();
  FlightCheck check(step.query, step.zones);
  const GroupNegotiation::View view{
      [&](std::span<const JoinedMember> members) { return solve_group(step, members); },
      [&](const FlightPlan& flight) { return check.is_free(flight); }};
  group_->step(step.now, view, answers_);
  if (group_->state() == GroupNegotiation::State::kOpen) return;
  const GroupNegotiation over = *std::move(group_);
  group_.reset();
  last_group_ = over.name();
  if (over.state() == GroupNegotiation::State::kAgreed)
    fly_with_group(over, step.now);
  else
    group_again_ = step.now.seconds() + kOpenAgain;
}

void Separator::fly_with_group(const GroupNegotiation& agreed, Time now) {
  const std::string_view what = name_of(agreed.kind());
  if (agreed.flight()) {
    adopt(*agreed.flight(),
          {agreed.begin(),
           agreed.rejoins(),
           agreed.apart(),
           SeparationMethod::kGroup,
           {},
           code_of(agreed.name()),
           what},
          now);
  } else {
    agreed_ = code_of(agreed.name());
    plan_is_new_ = true;
  }
  for (const EntityId who : agreed.partners())
    log_.solved(who, now, SeparationMethod::kGroup, what);
}

void Separator::leave_group() {
  if (!group_) return;
  last_group_ = group_->name();
  group_->leave(answers_);
  group_.reset();
}

}  // namespace skein::reasoning
