#include "skein/link/autopilot_client/clock_alignment.h"

#include <algorithm>

namespace skein::autopilot_client {
namespace {

constexpr double kDrift = 100e-6;             // of two quartz clocks, with a margin
const Time kMemory = Time::from_seconds(30);  // of the shortest round trip
const Time kMaxRoundTrip = Time::from_seconds(10);
const Time kMaxClock = Time::from_seconds(4e9);  // 127 years; what is more is no clock

}  // namespace

void ClockAlignment::hear(Time boot, Time now) {
  const Time offset = now - boot;
  if (offset_) {
    const Time drifted =
        *offset_ + Time::from_seconds(kDrift * (now - offset_at_).seconds());
    if (offset >= drifted) return;
  }
  offset_ = offset;
  offset_at_ = now;
}

void ClockAlignment::round_trip(Time sent, Time boot, Time now) {
  if (sent > now || sent < now - kMaxRoundTrip) return;
  if (boot > kMaxClock || kMaxClock + boot < Time()) return;
  const Time took = now - sent;
  const Time centred = Time::from_ns((sent.ns() + now.ns()) / 2) - boot;
  // Another clock than that of its telemetry, such as the time of day.
  if (offset_ &&
      (centred > *offset_ + kMaxRoundTrip || *offset_ > centred + kMaxRoundTrip))
    return;
  if (shortest_ && took > *shortest_ && now - shortest_at_ < kMemory) return;
  shortest_ = took;
  shortest_at_ = now;
  centred_ = centred;
}

Time ClockAlignment::to_here(Time boot, Time now) const {
  Time offset = now - boot;
  if (offset_) offset = std::min(offset, *offset_);
  if (centred_) offset = std::min(offset, *centred_);
  return std::min(boot + offset, now);
}

}  // namespace skein::autopilot_client
