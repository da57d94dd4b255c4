// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/separator/conflict_log.h"
#include "skein/layer/reasoning/avoidance/separator/separator_common.h"

#include <algorithm>
#include <utility>

namespace skein::reasoning {
namespace {

constexpr std::string_view kNotSolved = "not solved";
constexpr std::string_view kChanged = "flights have changed";

}  // namespace

void ConflictLog::see(Time now, std::span<const Conflict> conflicts) {
  for (const Conflict& conflict : conflicts) {
    const auto [at, first] = open_.try_emplace(conflict.other);
    Open& open = at->second;
    const Time closest = Time::from_seconds(conflict.encounter.closest_time);
    if (first) {
      open.report.other = conflict.other;
      open.report.seen = now;
      open.report.meets = Time::from_seconds(conflict.encounter.begin);
      open.report.outcome = kNotSolved;
      open.report.flown_ratio = 1e3;
      open.closest = closest;
    }
    if (open.report.outcome == kChanged) {
      open.report.outcome = kNotSolved;
      open.report.fixed_before = 0;
    }
    open.last_seen = now;
    open.closest = std::max(open.closest, closest);
    open.report.planned_ratio = conflict.encounter.min_ratio;
  }
  for (auto at = open_.begin(); at != open_.end();) {
    Open& open = at->second;
    if (open.last_seen != now) {
      open.report.planned_ratio = 1;
      // The other has given way, or a task has planned anew.
      if (open.report.outcome == kNotSolved && now < open.report.meets) {
        open.report.outcome = kChanged;
        open.report.fixed_before = (open.report.meets - now).seconds();
      }
    }
    const Time over = std::max(open.last_seen, open.closest);
    if ((now - over).seconds() < kClearTime) {
      ++at;
      continue;
    }
    over_.push_back(std::move(open.report));
    at = open_.erase(at);
  }
}

void ConflictLog::solved(EntityId other, Time now, SeparationMethod method,
                         std::string_view what) {
  const auto found = open_.find(other);
  if (found == open_.end()) return;
  ConflictReport& report = found->second.report;
  report.method = method;
  report.outcome = what;
  report.fixed_before = (report.meets - now).seconds();
}

void ConflictLog::sent(EntityId other, std::size_t bytes) {
  const auto found = open_.find(other);
  if (found == open_.end()) return;
  ++found->second.report.messages;
  found->second.report.bytes += static_cast<std::uint32_t>(bytes);
}

void ConflictLog::flown(EntityId other, double ratio) {
  const auto found = open_.find(other);
  if (found == open_.end()) return;
  double& least = found->second.report.flown_ratio;
  least = std::min(least, ratio);
}

std::vector<ConflictReport> ConflictLog::take() {
  return std::exchange(over_, {});
}

}  // namespace skein::reasoning
