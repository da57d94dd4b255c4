// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/intruders/intruder_avoidance.h"

#include <gtest/gtest.h>

#include "skein/base/random.h"
#include "skein/geo/rotation.h"
#include "skein/layer/reasoning/avoidance/encounter/test/straight_flight.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/repair.h"

namespace skein::reasoning::intruder_avoidance_test {
namespace {

using Action = IntruderAvoidance::Action;

// One that comes near before anything can be planned.
AvoidedIntruder near_by(RandomStream& random) {
  AvoidedIntruder intruder;
  const double bearing = random.uniform(-1.5, 1.5);
  const Vec2 from = random.uniform(650, 1100) * geo::unit(bearing);
  intruder.p_N = Vec3(from.x(), from.y(), -100);
  const Vec2 v = random.uniform(15, 45) *
                 geo::unit(geo::wrap_pi(bearing + geo::kPi + random.uniform(-0.6, 0.6)));
  intruder.v_N = Vec3(v.x(), v.y(), 0);
  intruder.horizontal_sd = 60;
  intruder.horizontal_speed_sd = 2;
  intruder.vertical_sd = 20;
  return intruder;
}

// Who flies by headings goes back to a plan only where that keeps all that plans around
// intruders keep: one that keeps less would be left again a second later.
TEST(IntruderAvoidance, APlanInsteadOfAHeadingKeepsAllThatIsToBeKept) {
  RandomStream random(7, 1, Purpose::kTest);
  int headings = 0, plans = 0;
  for (int k = 0; k < 60; ++k) {
    AvoidedIntruder intruder = near_by(random);
    const PathQuery query;
    IntruderAvoidance avoidance(2);
    FlightPlan plan = straight({0, 0, -100}, 0);
    Vec3 p_N = plan.front().p_N, v_N(20, 0, 0);
    bool turns = false;
    for (double now = 0; now < 40; ++now) {
      intruder.time = now;
      const AvoidedIntruder seen[] = {intruder};
      const Action action = avoidance.step(
          {now, p_N, v_N, plan, model::end_time_of(plan), seen, query, {}, {}});
      if (action == Action::kPlan) {
        FlightPlan flown = solve::part_of(plan, now, avoidance.begin());
        if (turns) {
          flown.clear();
          ++plans;
          EXPECT_FALSE(predicted_intersection(avoidance.flight(), intruder, now))
              << "case " << k << ", " << now << " s";
        }
        flown.insert(flown.end(), avoidance.flight().begin(), avoidance.flight().end());
        plan = flown;
      } else if (turns && action == Action::kNone) {
        break;  // what is wanted is planned anew
      }
      turns = action == Action::kTrack;
      headings += turns ? 1 : 0;
      if (turns) {
        const Vec2 v = 20 * geo::unit(avoidance.track());
        v_N = Vec3(v.x(), v.y(), 0);
        p_N += v_N;
      } else {
        const model::FlightMoment next = model::moment_at(plan, now + 1);
        p_N = next.p_N;
        v_N = next.v_N;
      }
      intruder.p_N += intruder.v_N;
    }
  }
  EXPECT_GT(headings, 20);
  EXPECT_GT(plans, 5);
}

}  // namespace
}  // namespace skein::reasoning::intruder_avoidance_test
