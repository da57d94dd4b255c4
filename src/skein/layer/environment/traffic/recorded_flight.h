// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "skein/role/traffic_aircraft.h"

namespace skein::environment {

/// One place of a recorded flight.
struct RecordedPlace {
  double time = 0;  ///< [s]
  Vec3 p_N = Vec3::Zero();
};

struct RecordedFlightOptions {
  double gap = 30;  ///< longer without a place: it is not there meanwhile [s]
};

/// What a recorded flight has that no aircraft flies.
struct RecordedFaults {
  int gaps = 0, jumps = 0;
};

/// Flies as was recorded, straight on between two places. It is not there before the
/// first and after the last of them, nor in gaps.
///
/// A place further away from the one before than
///
///   200 m + 2 max(50 m/s, median speed of the flight) (t_2 - t_1)
///
/// is a jump: until its time it stays on the course of before, then it is there at once.
class RecordedFlight final : public TrafficAircraft {
 public:
  /// @param places  in order of time, one at least.
  RecordedFlight(std::vector<RecordedPlace> places, const RecordedFlightOptions& options);

  void advance(const TrafficView& view) override;
  TrafficState state() const override { return state_; }

  RecordedFaults faults() const;

 private:
  enum class Leg : std::uint8_t { kFlown, kGap, kJump };
  Leg leg_to(std::size_t next) const;
  Vec3 velocity_to(std::size_t next) const;

  std::vector<RecordedPlace> places_;
  RecordedFlightOptions options_;
  double usual_speed_ = 0;  // [m/s]
  std::size_t next_ = 0;    // the first place after the last time
  TrafficState state_;
};

}  // namespace skein::environment
