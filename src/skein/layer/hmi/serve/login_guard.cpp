// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/hmi/serve/login_guard.h"

#include <algorithm>
#include <vector>

namespace skein::hmi {

int LoginGuard::left_of(const Tries& tries, Moment now) {
  const auto forgotten = (now - tries.last) / kForgetAfter;
  return forgotten >= tries.count ? 0 : tries.count - static_cast<int>(forgotten);
}

int LoginGuard::remembered(const std::string& group, Moment now) const {
  const auto found = tries_.find(group);
  return found == tries_.end() ? 0 : left_of(found->second, now);
}

LoginGuard::Duration LoginGuard::wrong(const std::string& group, Moment now) {
  ++count_;
  if (tries_.size() >= kMaxAddresses && !tries_.contains(group)) make_room(now);
  Tries& tries = tries_[group];
  constexpr int kMaxCount = 30;
  tries.count = std::min(left_of(tries, now) + 1, kMaxCount);
  tries.last = now;
  if (tries.count <= kFreeTries) return Duration(0);
  const int doublings = std::min(tries.count - kFreeTries - 1, 10);
  return std::min(kFirstWait * (1 << doublings), kMaxWait);
}

// Those that are forgotten go; if there are none, the older half, so that this is rare.
void LoginGuard::make_room(Moment now) {
  std::erase_if(tries_,
                [now](const auto& each) { return left_of(each.second, now) == 0; });
  if (tries_.size() < kMaxAddresses) return;
  std::vector<Moment> moments;
  for (const auto& [group, tries] : tries_) moments.push_back(tries.last);
  const auto middle = moments.begin() + static_cast<std::ptrdiff_t>(moments.size() / 2);
  std::nth_element(moments.begin(), middle, moments.end());
  std::erase_if(tries_,
                [at = *middle](const auto& each) { return each.second.last <= at; });
}

}  // namespace skein::hmi
