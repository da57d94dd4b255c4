// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "skein/data/traffic/separation.h"
#include "skein/data/vehicle/flight_plan.h"

namespace skein::reasoning {

/// The room that some flights need over time: a tree of boxes, each of a part of the
/// time.
///
/// To find out which of many flights may meet any of a few: one that cannot is ruled out
/// at once, without a look at each of the few.
class FlightEnvelope {
 public:
  /// Of no flights yet.
  /// @param from, until  the time that counts, finite [s].
  FlightEnvelope(double from, double until);

  /// The part of a flight that is within the time counts.
  /// Cost: linear in the elements, and in the boxes (128 at most).
  void add(const FlightPlan& flight);

  /// Whether another flight may come nearer than the separation to one of those added.
  ///
  /// False only where first_encounter() within the time finds none for any of them; true
  /// says nothing.
  /// Cost: mostly that of one to three boxes around the other flight.
  bool may_meet(const FlightPlan& other, const Separation& separation) const;

 private:
  struct Box {
    Vec3 low, high;
    Box();
    bool is_empty() const { return low.x() > high.x(); }
    void include(const Box& other);
  };
  static Box box_of(const FlightPlan& flight, double from, double until);
  bool may_meet(std::size_t node, double from, double until, const FlightPlan& other,
                const Separation& separation) const;

  double from_, until_;
  std::size_t leaves_;      // a power of two
  std::vector<Box> boxes_;  // of node k: those of 2 k and 2 k + 1 together; 1 is the root
};

}  // namespace skein::reasoning
