// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/right_of_way/right_of_way.h"

#include <algorithm>

namespace skein::reasoning {
namespace {

constexpr double kSwappedFor = 30;  // after the conflict [s]
constexpr double kMinRepeat = 0.3;  // [s]
constexpr int kMaxTimes = 1 + 3;    // that a request is said

double swapped_until(const YieldRequest& request) {
  return static_cast<double>(request.apart) + kSwappedFor;
}

bool are_same(const YieldRequest& a, const YieldRequest& b) {
  return a.request == b.request && a.own_plan == b.own_plan &&
         a.other_plan == b.other_plan;
}

}  // namespace

void RightOfWay::ask(Time now, EntityId whom, const YieldRequest& about,
                     double round_trip) {
  if (is_asking()) return;
  const bool again = asked_ && asked_->whom == whom &&
                     asked_->request.own_plan == about.own_plan &&
                     asked_->request.other_plan == about.other_plan;
  if (again) return;
  asked_.emplace();
  asked_->whom = whom;
  asked_->request = about;
  asked_->request.request = ++requests_;
  asked_->repeat = std::max(kMinRepeat, round_trip);
  asked_->said = now - Time::from_seconds(asked_->repeat);
}

void RightOfWay::take(Time now, EntityId from, const YieldAnswer& answer) {
  // One that comes after the request was given up is as good as any.
  if (!asked_ || asked_->whom != from || asked_->request.request != answer.request ||
      asked_->answered)
    return;
  asked_->answered = true;
  if (answer.granted && now.seconds() < swapped_until(asked_->request))
    yielded_[from] = swapped_until(asked_->request);
}

void RightOfWay::step(Time now, std::vector<Message>& out) {
  std::erase_if(yielded_, [&](const auto& each) { return now.seconds() >= each.second; });
  std::erase_if(decided_, [&](const auto& each) {
    return now.seconds() >= swapped_until(each.second.request);
  });
  if (!is_asking() || (now - asked_->said).seconds() < asked_->repeat) return;
  if (asked_->times == kMaxTimes) {
    asked_->given_up = true;
    return;
  }
  ++asked_->times;
  asked_->said = now;
  out.push_back({self_, asked_->whom, 0, Time(), asked_->request});
}

std::optional<bool> RightOfWay::answer_to(Time now, EntityId from,
                                          const YieldRequest& request) const {
  const auto found = decided_.find(from);
  if (found == decided_.end()) return std::nullopt;
  if (are_same(found->second.request, request)) return found->second.granted;
  if (yields_to(from, now)) return false;
  return std::nullopt;
}

void RightOfWay::decide(EntityId from, const YieldRequest& request, bool granted) {
  decided_[from] = {request, granted};
}

bool RightOfWay::other_yields(EntityId other, Time now) const {
  const auto found = yielded_.find(other);
  return found != yielded_.end() && now.seconds() < found->second;
}

bool RightOfWay::yields_to(EntityId other, Time now) const {
  const auto found = decided_.find(other);
  return found != decided_.end() && found->second.granted &&
         now.seconds() < swapped_until(found->second.request);
}

}  // namespace skein::reasoning
