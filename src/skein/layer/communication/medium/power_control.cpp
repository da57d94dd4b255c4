// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/medium/power_control.h"

#include <algorithm>

#include "skein/base/math.h"

namespace skein::communication {
namespace {

constexpr double kFallPerRise = 0.1;  // steps that a success takes back

}  // namespace

PowerControl::PowerControl(const RadioProfile& profile, const Links& links)
    : links_(links),
      target_(watts(profile.phy.decode_threshold_dbm + profile.mac.power_margin_db)),
      least_(watts(profile.mac.min_power_dbm)),
      up_(math::pow(10, profile.mac.power_step_db / 10)),
      down_(math::pow(10, -profile.mac.power_step_db / 10 * kFallPerRise)),
      neighbours_(links.size()) {}

std::vector<PowerControl::Neighbour>::iterator PowerControl::place(NodeIndex node,
                                                                   NodeIndex other) {
  auto& known = neighbours_[node];
  return std::lower_bound(
      known.begin(), known.end(), other,
      [](const Neighbour& each, NodeIndex wanted) { return each.node < wanted; });
}

const PowerControl::Neighbour* PowerControl::find(NodeIndex node, NodeIndex other) const {
  const auto& known = neighbours_[node];
  const auto at = std::lower_bound(
      known.begin(), known.end(), other,
      [](const Neighbour& each, NodeIndex wanted) { return each.node < wanted; });
  return at != known.end() && at->node == other ? &*at : nullptr;
}

void PowerControl::heard(NodeIndex node, NodeIndex from, double power, double share) {
  auto at = place(node, from);
  if (at == neighbours_[node].end() || at->node != from)
    at = neighbours_[node].insert(at, {from, 1, 1});
  // What arrives there with the full power of `node`.
  const double full = power / share * links_.full_power(node) / links_.full_power(from);
  at->needed = target_ / full;
}

double PowerControl::share(NodeIndex node, NodeIndex to) const {
  const Neighbour* known = find(node, to);
  if (!known) return 1;
  return std::min(
      1.0, std::max(least_ / links_.full_power(node), known->needed * known->raise));
}

void PowerControl::succeeded(NodeIndex node, NodeIndex to) {
  const auto at = place(node, to);
  if (at != neighbours_[node].end() && at->node == to)
    at->raise = std::max(1.0, at->raise * down_);
}

void PowerControl::failed(NodeIndex node, NodeIndex to) {
  const auto at = place(node, to);
  // No further than to full power: what is more would have to be taken back.
  if (at != neighbours_[node].end() && at->node == to && at->needed * at->raise < 1)
    at->raise *= up_;
}

}  // namespace skein::communication
