// SPDX-License-Identifier: Apache-2.0
#include "skein/link/autopilot_client/clock_alignment.h"

#include <algorithm>
#include <utility>

namespace skein::autopilot_client {
namespace {

const Time kMemory = Time::from_seconds(30);  // of round trips, and of each window
const Time kMaxRoundTrip = Time::from_seconds(10);
const Time kMaxClock = Time::from_seconds(4e9);  // 127 years; what is more is no clock
const Time kClockMargin = Time::from_seconds(1);
const Time kMinJump = Time::from_seconds(10);  // less may be a queue that has emptied

}  // namespace

std::optional<Time> ClockAlignment::fastest() const {
  if (current_ && previous_) return std::min(*current_, *previous_);
  return current_ ? current_ : previous_;
}

Time ClockAlignment::hear(Time boot, Time now) {
  const Time offset = now - boot;
  Time ahead;
  if (const auto known = fastest(); known && offset < *known - kMinJump) {
    ahead = *known - offset;
    forget();
  }
  if (now >= window_end_) {
    if (current_) previous_ = std::exchange(current_, std::nullopt);
    window_end_ = now + kMemory;
  }
  current_ = current_ ? std::min(*current_, offset) : offset;
  newest_ = offset;
  return ahead;
}

ClockAlignment::Answer ClockAlignment::round_trip(Time sent, Time boot, Time now) {
  if (sent > now || sent < now - kMaxRoundTrip) return Answer::kImpossible;
  if (boot > kMaxClock || kMaxClock + boot < Time()) return Answer::kImpossible;
  if (!newest_) return Answer::kTooEarly;
  const Time took = now - sent, half = Time::from_ns(took.ns() / 2);
  const Time centred = now - half - boot;
  if (centred > *newest_ + half + kClockMargin ||
      centred < *newest_ - took - kClockMargin)
    return Answer::kOtherClock;
  if (const auto known = fastest(); known && centred > *known + half + kClockMargin) {
    const Time newest = *newest_;
    forget();
    hear(now - newest, now);
  }
  if (shortest_ && took > *shortest_ && now - shortest_at_ < kMemory)
    return Answer::kTaken;
  shortest_ = took;
  shortest_at_ = now;
  centred_ = centred;
  return Answer::kTaken;
}

Time ClockAlignment::to_here(Time boot, Time now) const {
  Time offset = now - boot;
  if (const auto known = fastest()) offset = std::min(offset, *known);
  if (centred_) offset = std::min(offset, *centred_);
  return std::min(boot + offset, now);
}

}  // namespace skein::autopilot_client
