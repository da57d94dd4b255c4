// SPDX-License-Identifier: Apache-2.0
#include "skein/link/impairment/impairment_schedule.h"

#include <algorithm>
#include <utility>

#include "skein/base/check.h"

namespace skein::impairment {
namespace {

void apply_to(std::array<Impairment, 2>& both, Directions directions,
              const ImpairmentChange& change) {
  for (const Direction direction : kDirections)
    if (includes(directions, direction)) apply(change, both[index_of(direction)]);
}

}  // namespace

ImpairmentSchedule::ImpairmentSchedule(ImpairmentPlan plan)
    : planned_(plan.first), in_force_(plan.first), changes_(std::move(plan.changes)) {
  std::stable_sort(changes_.begin(), changes_.end(),
                   [](const auto& a, const auto& b) { return a.at < b.at; });
}

std::optional<Time> ImpairmentSchedule::next() const {
  if (next_ == changes_.size()) return std::nullopt;
  return changes_[next_].at;
}

void ImpairmentSchedule::step() {
  SKEIN_CHECK(next_ < changes_.size(), next_);
  const TimedChange& due = changes_[next_++];
  apply_to(planned_, due.directions, due.change);
  apply_to(in_force_, due.directions, due.change);
}

void ImpairmentSchedule::change(Directions directions, const ImpairmentChange& change) {
  apply_to(in_force_, directions, change);
}

}  // namespace skein::impairment
