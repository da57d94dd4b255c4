// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "skein/base/time.h"

namespace skein::autopilot_client {

/// Brings a vehicle's clock, which counts from its boot, onto the clock of this end.
///
/// What arrives was sent before, so the offset here - there is at most what any message
/// says: the smallest of the last 30 to 60 s counts, so that a clock that drifts, or is
/// set back a little, is followed. Where round trips are measured (TIMESYNC), half of the
/// shortest one is taken for the way here:
///
///   offset = (sent + received) / 2 - there,   off by at most half the round trip
///
/// An answer counts only beside what the messages say: with the offset O of the newest
/// one, which took no longer than about a round trip T,
///
///   O - T - 1 s <= offset <= O + T / 2 + 1 s
///
/// What is outside is another clock than that of the telemetry, such as the time of day.
/// One that is beyond the fastest message in the same way shows that the clock has lost
/// time, as that of a simulator does which is too slow: it is aligned again at once.
class ClockAlignment {
 public:
  /// What became of the answer to a question for the time.
  enum class Answer : std::uint8_t {
    kTaken,       ///< it counts, or a shorter one of late does
    kImpossible,  ///< to no question of late, or no time
    kTooEarly,    ///< nothing is known yet of the clock of the messages
    kOtherClock,  ///< not the clock of the messages
  };

  /// A message with time `boot` of the vehicle's clock came in.
  /// @returns  how far the clock was set ahead; 0: it was not.
  Time hear(Time boot, Time now);

  /// The vehicle has answered a question that went out at `sent` with its time `boot`.
  Answer round_trip(Time sent, Time boot, Time now);

  /// When something happened that the vehicle gives its time for; never in the future.
  Time to_here(Time boot, Time now) const;

  /// The shortest round trip of late [s]; 0: none was measured.
  double shortest_round_trip() const { return shortest_ ? shortest_->seconds() : 0; }

  /// The vehicle has begun anew.
  void forget() { *this = {}; }

 private:
  std::optional<Time> fastest() const;

  std::optional<Time> current_, previous_;  // offsets by the fastest message of a window
  Time window_end_;
  std::optional<Time> newest_;   // the offset by the newest message
  std::optional<Time> centred_;  // by the shortest round trip
  std::optional<Time> shortest_;
  Time shortest_at_;
};

}  // namespace skein::autopilot_client
