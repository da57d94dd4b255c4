// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "skein/data/vehicle/vehicle.h"
#include "skein/model/path/flight_plan.h"

namespace skein::solve {

/// Expects elements that join in time, position and heading, with a bounded acceleration
/// of the climb in climb rate too, and turns no tighter than the aircraft's. Positions
/// may be 1e-6 m off: sums of connections of kilometres.
inline void expect_flyable(const FlightPlan& plan, const FlightLimits& limits,
                           const Vec2& wind) {
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const FlightElement& e = plan[i];
    ASSERT_TRUE(e.p_N.allFinite() && std::isfinite(e.heading));
    ASSERT_GE(e.duration, 0) << i;
    ASSERT_EQ(e.wind, wind) << i;
    ASSERT_LE(std::abs(e.turn_rate) * limits.turn_radius * e.airspeed,
              limits.airspeed * limits.airspeed * (1 + 1e-9))
        << "element " << i;
    ASSERT_LE(e.climb_rate, limits.climb_rate + 1e-9) << i;
    ASSERT_GE(e.climb_rate, -limits.sink_rate - 1e-9) << i;
    if (limits.climb_acceleration > 0) {
      ASSERT_LE(std::abs(e.climb_acceleration), limits.climb_acceleration * (1 + 1e-9));
      const double before = i == 0 ? 0 : -model::end_of(plan[i - 1]).v_N.z();
      ASSERT_NEAR(e.climb_rate, before, 1e-6) << "climb rate of element " << i;
    }
    if (i + 1 == plan.size()) break;
    const model::FlightMoment end = model::end_of(e);
    const FlightElement& next = plan[i + 1];
    ASSERT_NEAR(e.start + e.duration, next.start, 1e-7) << i;
    ASSERT_LT((end.p_N - next.p_N).norm(), 1e-6) << "element " << i;
    ASSERT_NEAR(geo::wrap_pi(end.heading - next.heading), 0, 1e-9) << "element " << i;
  }
}

}  // namespace skein::solve
