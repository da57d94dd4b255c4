// SPDX-License-Identifier: Apache-2.0
#include "skein/base/outages.h"

#include <algorithm>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein {
namespace {

constexpr double kNever = 1e9;  // [s]: longer than any run

double exponential(RandomStream& random, double mean) {
  return std::min(-mean * math::log(1 - random.uniform()), kNever);
}

}  // namespace

Outages::Outages(const OutageOptions& options, const RandomStream& random)
    : per_hour_(options.per_hour),
      mean_duration_(options.mean_duration),
      random_(random) {
  SKEIN_CHECK(per_hour_ >= 0 && mean_duration_ >= 0, per_hour_, mean_duration_);
  for (const OutageSpan& span : options.spans)
    spans_.push_back({Time::from_seconds(span.from), Time::from_seconds(span.until)});
  std::sort(spans_.begin(), spans_.end(),
            [](const Span& a, const Span& b) { return a.from < b.from; });
  // Merge what overlaps.
  std::size_t kept = 0;
  for (const Span& span : spans_) {
    if (kept > 0 && span.from <= spans_[kept - 1].until)
      spans_[kept - 1].until = std::max(spans_[kept - 1].until, span.until);
    else
      spans_[kept++] = span;
  }
  spans_.resize(kept);
  if (per_hour_ > 0) draw();
}

void Outages::draw() {
  drawn_.from = drawn_.until + Time::from_seconds(exponential(random_, 3600 / per_hour_));
  drawn_.until = drawn_.from + Time::from_seconds(exponential(random_, mean_duration_));
}

std::optional<Time> Outages::until(Time now) {
  while (next_ < spans_.size() && spans_[next_].until <= now) ++next_;
  if (per_hour_ > 0)
    while (drawn_.until <= now) draw();
  std::optional<Time> end;
  if (next_ < spans_.size() && spans_[next_].from <= now) end = spans_[next_].until;
  if (per_hour_ > 0 && drawn_.from <= now)
    end = end ? std::max(*end, drawn_.until) : drawn_.until;
  return end;
}

}  // namespace skein
