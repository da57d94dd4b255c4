// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/vehicle/vehicle_report.h"
#include "skein/geo/local_frame.h"
#include "skein/link/flight_model/flight_state.h"

namespace skein::flight_model {

/// Makes reports of the states of a program, by the run's clock.
///
/// The program's clock is brought onto the run's by what lies between them when states
/// come in, smoothed over a second, so that the times of states are as far apart as the
/// program has them; the mean delay on the way stays in it. A difference of more than
/// 0.25 s, as after a pause, counts at once.
class StateFollower {
 public:
  explicit StateFollower(const geo::LocalFrame& frame) : frame_(frame) {}

  /// Takes in the newest state, and appends VehicleMotion with it: LinkChange::kRebooted
  /// before when the program's clock went back, or when the aircraft is further from
  /// where it was than it can have flown; VehicleCondition when it has changed. Nothing
  /// while the program's clock stands.
  /// @param came  when it came in, of the run's clock.
  void take(const FlightState& state, Time came, std::vector<VehicleReport>& out);

 private:
  struct Before {
    FlightState state;
    Vec3 p_N;
    Time came;
  };

  std::optional<std::string> jump(const FlightState& state, const Vec3& p_N) const;
  Time align(double time, Time came);

  geo::LocalFrame frame_;
  std::optional<Before> before_;
  std::optional<double> offset_;  // run's clock less the program's [s]
  std::optional<VehicleCondition> reported_;
};

}  // namespace skein::flight_model
