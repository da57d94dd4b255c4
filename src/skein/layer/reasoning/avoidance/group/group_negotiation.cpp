// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/group/group_negotiation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/layer/reasoning/avoidance/manoeuvre/said_limits.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kAnswersWithin = 1;  // agents, at most [s]
constexpr double kBeforeBegin = 1;    // it is over [s]
constexpr std::size_t kMaxManoeuvres = 64;

bool is_flyable(const GroupManoeuvre& manoeuvre) {
  for (const float each :
       {manoeuvre.amount, manoeuvre.lead, manoeuvre.meets, manoeuvre.closest,
        manoeuvre.apart, manoeuvre.horizontal, manoeuvre.vertical})
    if (!std::isfinite(each)) return false;
  return manoeuvre.kind <= static_cast<std::uint8_t>(ManoeuvreKind::kSpeed) &&
         manoeuvre.meets <= manoeuvre.closest && manoeuvre.closest <= manoeuvre.apart &&
         manoeuvre.horizontal > 0 && manoeuvre.vertical > 0;
}

}  // namespace

std::optional<FlightPlan> flight_of(const GroupManoeuvre& manoeuvre,
                                    const NegotiatingFlight& flight, double begin) {
  if (!is_flyable(manoeuvre)) return std::nullopt;
  NegotiatedConflict conflict;
  conflict.begin = begin;
  conflict.meets = manoeuvre.meets;
  conflict.closest = manoeuvre.closest;
  conflict.apart = manoeuvre.apart;
  conflict.separation = {manoeuvre.horizontal, manoeuvre.vertical};
  return flight_with(
      {static_cast<ManoeuvreKind>(manoeuvre.kind), manoeuvre.amount, manoeuvre.lead},
      flight, conflict);
}

GroupNegotiation::GroupNegotiation(EntityId self, const NegotiationName& name,
                                   const GroupInvitation& invitation,
                                   NegotiatingFlight own, double delay, Time now)
    : self_(self), name_(name), invitation_(invitation), own_(std::move(own)) {
  own_.limits = limits_of(said_limits(own_.limits));
  own_.rejoins = static_cast<float>(own_.rejoins);
  repeat_ = 2 * delay + kAnswersWithin;
  deadline_ = invitation.begin - kBeforeBegin;
  // The other half of the time is for what comes out.
  joins_until_ = (now.seconds() + deadline_) / 2;
}

void GroupNegotiation::fail(std::string_view why) {
  if (state_ != State::kOpen) return;
  state_ = State::kFailed;
  why_ = why;
}

void GroupNegotiation::take(EntityId from, const GroupJoining& joining) {
  if (!coordinates() || plan_) {
    changed_ = true;  // it has not heard what comes out
    return;
  }
  if (!are_possible(joining.limits) || !std::isfinite(joining.rejoins)) return;
  if (std::ranges::find(invitation_.members, from, &GroupMember::who) ==
      invitation_.members.end())
    return;
  joined_[from] = {from, joining.rejoins, limits_of(joining.limits)};
}

void GroupNegotiation::take(EntityId from, const GroupPlan& plan) {
  if (coordinates() || from != name_.opener || plan_) return;
  if (plan.members.size() > kMaxManoeuvres || plan.manoeuvres.size() > kMaxManoeuvres)
    return fail("a plan that makes no sense");
  if (std::ranges::find(plan.members, self_) == plan.members.end())
    return fail("left out");
  plan_ = plan;
}

void GroupNegotiation::take(EntityId from, const GroupAcceptance& acceptance) {
  if (acceptance.accepted) {
    accepted_.insert(from);
  } else if (plan_ || from == name_.opener) {
    const bool counts = !plan_ || from == name_.opener ||
                        std::ranges::find(plan_->members, from) != plan_->members.end();
    if (counts) fail("not all take part");
  } else {
    absent_.insert(from);
    joined_.erase(from);
  }
}

std::vector<EntityId> GroupNegotiation::partners() const {
  std::vector<EntityId> all;
  if (plan_) all = plan_->members;
  if (!coordinates()) all.push_back(name_.opener);
  std::erase(all, self_);
  return all;
}

// Works out what comes out, once all have answered or it is time.
void GroupNegotiation::coordinate(Time now, const View& view) {
  if (!coordinates() || plan_) return;
  const bool complete = joined_.size() + absent_.size() >= invitation_.members.size();
  if (!complete && now.seconds() < joins_until_) return;
  if (joined_.empty()) return fail("nobody takes part");
  std::vector<JoinedMember> members;
  for (const auto& [who, member] : joined_) members.push_back(member);
  members.push_back({self_, own_.rejoins, own_.limits});
  std::ranges::sort(members, {}, &JoinedMember::who);
  auto manoeuvres = view.solve(members);
  if (!manoeuvres) return fail("nothing better is found");
  plan_.emplace();
  plan_->group = name_.number;
  for (const auto& [who, member] : joined_) plan_->members.push_back(who);
  plan_->manoeuvres = *std::move(manoeuvres);
}

// Whether the own part can be flown.
void GroupNegotiation::judge(const View& view) {
  if (!plan_ || own_answer_) return;
  changed_ = true;
  own_answer_ = true;
  const auto own = std::ranges::find(plan_->manoeuvres, self_, &GroupManoeuvre::who);
  if (own == plan_->manoeuvres.end()) return;
  kind_ = static_cast<ManoeuvreKind>(own->kind);
  flight_ = flight_of(*own, own_, invitation_.begin);
  own_answer_ = flight_ && (!view.is_free || view.is_free(*flight_));
}

void GroupNegotiation::send(EntityId to, decltype(Message::content) content,
                            std::vector<Message>& out) const {
  out.push_back({self_, to, 0, Time(), std::move(content)});
}

void GroupNegotiation::say(std::vector<Message>& out) const {
  if (!plan_) {
    if (coordinates())
      send(kEveryone, invitation_, out);
    else
      send(name_.opener,
           GroupJoining{name_.number, static_cast<float>(own_.rejoins),
                        said_limits(own_.limits)},
           out);
    return;
  }
  if (coordinates()) send(kEveryone, *plan_, out);
  send(kEveryone, GroupAcceptance{name_.opener, name_.number, *own_answer_}, out);
}

void GroupNegotiation::step(Time now, const View& view, std::vector<Message>& out) {
  if (state_ == State::kOpen && now.seconds() > deadline_) fail("no answer in time");
  if (state_ == State::kOpen) coordinate(now, view);
  if (state_ == State::kFailed) {
    if (coordinates()) leave(out);
    return;
  }
  judge(view);
  if (changed_ || (now - said_).seconds() >= repeat_) {
    say(out);
    said_ = now;
    changed_ = false;
  }
  if (!plan_ || state_ != State::kOpen) return;
  if (!*own_answer_) return fail("the own part cannot be flown");
  const std::vector<EntityId> others = partners();
  if (other_flies_ ||
      std::ranges::all_of(others, [&](EntityId who) { return accepted_.contains(who); }))
    state_ = State::kAgreed;
}

void GroupNegotiation::leave(std::vector<Message>& out) {
  fail("left");
  send(kEveryone, GroupAcceptance{name_.opener, name_.number, false}, out);
}

}  // namespace skein::reasoning
