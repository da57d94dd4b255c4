// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/group/joint_search.h"

#include <gtest/gtest.h>

#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/avoidance/group/test/circle_of_flights.h"

namespace skein::reasoning::joint_search_test {
namespace {

constexpr std::size_t kEnough = 30000;

std::size_t encounters_of(const JointSolution& solution) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < solution.choices.size(); ++i)
    for (std::size_t j = i + 1; j < solution.choices.size(); ++j)
      if (first_encounter(solution.choices[i].flight, solution.choices[j].flight,
                          {50, 20}, 5, 300))
        ++count;
  return count;
}

TEST(JointSearch, PartsAllOfACircle) {
  for (const int count : {2, 3, 5, 8, 12}) {
    const JointSolution solution =
        solve_jointly(joint_problem(circle_of_flights(count)), kEnough);
    EXPECT_EQ(solution.conflicts, 0U) << count;
    EXPECT_EQ(encounters_of(solution), 0U) << count;
    // In the middle of twelve each is some seconds later.
    EXPECT_LT(solution.cost, 4.0 * count) << count;
  }
}

TEST(JointSearch, NobodyChangesWhereAllAreApart) {
  auto plans = circle_of_flights(4);
  for (std::size_t k = 0; k < plans.size(); ++k)
    plans[k].front().p_N.z() = -150.0 - 25.0 * static_cast<double>(k);
  const JointSolution solution = solve_jointly(joint_problem(plans), kEnough);
  EXPECT_EQ(solution.conflicts, 0U);
  EXPECT_EQ(solution.cost, 0);
  for (const JointChoice& each : solution.choices)
    EXPECT_EQ(each.manoeuvre.kind, ManoeuvreKind::kGoOn);
}

// Who is not in the group goes on, and the others do not fly into its way: that which
// comes at the same time from the other side is solved without a new conflict with it.
TEST(JointSearch, KeepsApartFromOthers) {
  auto plans = circle_of_flights(2);
  for (const double beside : {100.0, -100.0}) {
    FlightPlan third = plans[0];  // beside the first, at its height
    third.front().p_N.head<2>() +=
        beside * geo::turned_right(geo::unit(third.front().heading));
    JointProblem problem = joint_problem(plans);
    for (auto& member : problem.members) member.others = {{&third, {50, 20}}};
    const JointSolution solution = solve_jointly(problem, kEnough);
    EXPECT_EQ(solution.conflicts, 0U);
    EXPECT_FALSE(first_encounter(solution.choices[0].flight, third, {50, 20}, 5, 300));
  }
}

TEST(JointSearch, TakesNothingThatIsNotFree) {
  JointProblem problem = joint_problem(circle_of_flights(3));
  problem.is_free = [](const FlightPlan&) { return false; };
  const JointSolution solution = solve_jointly(problem, kEnough);
  EXPECT_EQ(solution.conflicts, 3U);
  for (const JointChoice& each : solution.choices)
    EXPECT_EQ(each.manoeuvre.kind, ManoeuvreKind::kGoOn);
}

TEST(JointSearch, StopsWhereItMayLookNoFurther) {
  const JointProblem problem = joint_problem(circle_of_flights(12));
  const JointSolution none = solve_jointly(problem, 0);
  EXPECT_EQ(none.conflicts, 66U);
  const JointSolution some = solve_jointly(problem, 2000);
  EXPECT_LT(some.conflicts, none.conflicts);
}

}  // namespace
}  // namespace skein::reasoning::joint_search_test
