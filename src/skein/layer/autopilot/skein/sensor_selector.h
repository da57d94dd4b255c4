// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "skein/base/time.h"
#include "skein/data/vehicle/autopilot.h"

namespace skein::autopilot {

/// Chooses among several sensors of one kind, and knows which kinds have fallen silent.
///
/// The first unit that is received is flown by. When it has been silent for some of its
/// own intervals and another one is received, that one is taken, and kept. A kind is lost
/// when none of its units has been received for longer than its patience, or five
/// intervals, if that is more.
class SensorSelector {
 public:
  enum class Use : std::uint8_t {
    kNo,    ///< another unit is flown by
    kYes,   ///< it counts
    kAnew,  ///< it counts, and is another unit than before, with errors of its own
  };

  /// @param fitted  bit k: FlightSensor k is missed from `start` on, received or not;
  ///                others from their first sample on.
  SensorSelector(Time start, std::uint8_t fitted);

  /// A sample of this unit has come.
  Use take(FlightSensor sensor, std::uint8_t unit, Time time);

  /// Bit k: FlightSensor k is lost.
  std::uint8_t lost(Time now) const;
  /// Of each kind, the unit flown by.
  std::array<std::uint8_t, kFlightSensors> units() const;

 private:
  struct Kind {
    Time last;            // received from the unit flown by
    double interval = 0;  // between its last two samples [s]
    std::uint8_t unit = 0;
    bool heard = false;
  };

  std::array<Kind, kFlightSensors> kinds_{};
  std::uint8_t watched_;
};

}  // namespace skein::autopilot
