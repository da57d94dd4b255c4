// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/presence.h"

#include <algorithm>

namespace skein::assemble {
namespace {

using simulation::ActiveSpan;

// `spans` without what lies in [from, until).
std::vector<ActiveSpan> without(const std::vector<ActiveSpan>& spans, Time from,
                                Time until) {
  std::vector<ActiveSpan> left;
  for (const ActiveSpan& span : spans) {
    if (span.from < std::min(span.until, from))
      left.push_back({span.from, std::min(span.until, from)});
    if (std::max(span.from, until) < span.until)
      left.push_back({std::max(span.from, until), span.until});
  }
  return left;
}

// Whether the whole aircraft is gone; other failures are of one part.
bool ends_flight(scenario::Failure::Kind kind) {
  return kind == scenario::Failure::Kind::kLost || kind == scenario::Failure::Kind::kLand;
}

}  // namespace

std::vector<ActiveSpan> presence(const scenario::AircraftGroup& group, int index,
                                 Time duration) {
  const Time end = duration + Time::from_ns(1);  // takes part in the last step too
  std::vector<ActiveSpan> spans = {{group.join, end}};
  if (group.leave) spans = without(spans, *group.leave, group.comeback.value_or(end));
  for (const scenario::Failure& failure : group.failures)
    if (failure.aircraft == index && ends_flight(failure.kind))
      spans = without(spans, failure.at, failure.until.value_or(end));
  std::erase_if(spans, [](const ActiveSpan& span) { return span.from >= span.until; });
  return spans;
}

}  // namespace skein::assemble
