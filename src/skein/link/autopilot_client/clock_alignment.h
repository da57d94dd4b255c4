#pragma once

#include <cstdint>
#include <optional>

#include "skein/base/time.h"

namespace skein::autopilot_client {

/// Brings a vehicle's clock, which counts from its boot, onto the clock of this end.
///
/// What arrives was sent before, so the offset here - there is at most what any message
/// says: the smallest counts, made larger by `kDrift` per second, as clocks run apart.
/// Where round trips are measured (TIMESYNC), half of the shortest one is taken for the
/// way here:
///
///   offset = (sent + received) / 2 - there,   off by at most half the round trip
class ClockAlignment {
 public:
  /// A message with time `boot` of the vehicle's clock came in.
  void hear(Time boot, Time now);

  /// The vehicle has answered a question that went out at `sent` with its time `boot`.
  /// Ignored when that cannot be, or is no time of the clock that its messages go by.
  void round_trip(Time sent, Time boot, Time now);

  /// When something happened that the vehicle gives its time for; never in the future.
  Time to_here(Time boot, Time now) const;

  /// The shortest round trip of late [s]; 0: none was measured.
  double shortest_round_trip() const { return shortest_ ? shortest_->seconds() : 0; }

  /// The vehicle has begun anew.
  void forget() { *this = {}; }

 private:
  std::optional<Time> offset_;  // by the fastest message
  Time offset_at_;
  std::optional<Time> centred_;  // by the shortest round trip
  std::optional<Time> shortest_;
  Time shortest_at_;
};

}  // namespace skein::autopilot_client
