// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/hold_planner.h"

#include <gtest/gtest.h>

#include <cmath>

#include "skein/base/random.h"
#include "skein/layer/reasoning/agent/expected_flight.h"
#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/trajectory/test/test_flight.h"
#include "skein/model/path/flight_code.h"

namespace skein::reasoning::hold_planner_test {
namespace {

constexpr EntityId kOther{1}, kOwn{2};

NavEstimate flying(const Vec2& place, double heading, const Vec2& wind) {
  NavEstimate nav;
  nav.p_N = Vec3(place.x(), place.y(), -250);
  nav.heading = heading;
  nav.wind_N = wind;
  nav.v_N.head<2>() = 15 * geo::unit(heading) + wind;
  return nav;
}

// One that circles, heard of by another one that has to find a place to hold.
struct Situation {
  explicit Situation(const Vec2& wind_N) : wind(wind_N) { query.wind = wind; }

  FlightPlan circle_of(const Circling& circling, const NavEstimate& from) const {
    return expected_flight({0, circling}, 0, from, context, 0, 150).plan;
  }
  void hear(const FlightPlan& plan) {
    PlanReport report;
    report.number = 1;
    report.flight = *model::coded_flight(plan);
    const std::vector<Message> inbox{{kOther, kEveryone, 0, Time(), report}};
    separator.listen(Time(), inbox);
  }
  Circling place(const Vec2& centre, const NavEstimate& from) {
    FlightCheck check(query, zones);
    return place_to_hold({centre, {}}, from, 0, {Time(), context, separator}, check);
  }

  Vec2 wind;
  test::FlatGround ground;
  FlightContext context{kOwn, FlightLimits{15, 60, 3, 3, 11, 20}, &ground, nullptr, 150};
  PathQuery query;
  std::vector<Zone> zones;
  Separator separator{kOwn, SeparationOptions()};
};

TEST(HoldPlanner, WhereNobodyIsItIsWhereItIsAskedFor) {
  Situation alone(Vec2(3, 2));
  const Circling place = alone.place({100, 50}, flying({0, 0}, 0, alone.wind));
  EXPECT_EQ(place.centre, Vec2(100, 50));
  EXPECT_FALSE(place.altitude_msl);
}

// Two whose tasks end beside each other, anywhere and in any wind.
TEST(HoldPlanner, CirclesOfTwoAreApartWhateverTheirGeometry) {
  RandomStream random(11, kOwn.value, Purpose::kTest);
  const auto within = [&](double most) { return most * (2 * random.uniform() - 1); };
  int moved = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec2 wind(within(4), within(4));
    Situation situation(wind);
    const Vec2 theirs(within(500), within(500));
    const NavEstimate other = flying(theirs, within(geo::kPi), wind);
    const FlightPlan held = situation.circle_of({theirs, {}}, other);
    situation.hear(held);
    const double beside = 80 + 40 * (k % 5);
    const Vec2 own = theirs + beside * geo::unit(within(geo::kPi));
    const NavEstimate nav = flying(own, within(geo::kPi), wind);
    const Circling place = situation.place(own, nav);
    const FlightPlan flown = situation.circle_of(place, nav);
    const auto a = circle_at_end(held), b = circle_at_end(flown);
    ASSERT_TRUE(a && b) << k;
    EXPECT_TRUE(are_apart(*a, *b, Separation{})) << k;
    // Nearer than that both may head for each other, with no time left.
    if (beside >= 200) {
      EXPECT_FALSE(first_encounter(held, flown, Separation{}, 0, 1e9)) << k;
    }
    moved += (place.centre - own).norm() > 1 || place.altitude_msl ? 1 : 0;
  }
  EXPECT_GT(moved, 100) << "or nothing was tested";
}

}  // namespace
}  // namespace skein::reasoning::hold_planner_test
