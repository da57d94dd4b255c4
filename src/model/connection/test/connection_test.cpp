#include "model/connection/connection.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "model/path/flight_plan.h"

namespace skein::model {
namespace {

double end_error(const ConnectionQuery& q, const Connection& c) {
  const FlightPlan plan = to_flight_plan(c, q.from, q.air);
  if (plan.empty()) return (q.to.position - q.from.position).norm() / q.air.turn_radius;
  const FlightMoment end = end_of(plan.back());
  return std::max((geo::horizontal(end.p_N) - q.to.position).norm() / q.air.turn_radius,
                  std::abs(geo::wrap_pi(end.heading - q.to.course)));
}

TEST(Connection, EndsAtTheGoal) {
  RandomStream random(1, 0, Purpose::kTest);
  for (int i = 0; i < 100'000; ++i) {
    ConnectionQuery q;
    const double box = i % 2 == 0 ? 4 : 20;
    q.air = {20, 50, 20 * 0.95 * random.uniform() * geo::unit(7 * random.uniform())};
    q.from = {50 * box * Vec2(random.uniform(), random.uniform()), 7 * random.uniform()};
    q.to = {50 * box * Vec2(random.uniform(), random.uniform()), 7 * random.uniform()};
    const Connection c = connect(q.from, q.to, q.air);
    ASSERT_EQ(c.status, ConnectionStatus::kFound);
    ASSERT_LT(end_error(q, c), 1e-9) << i << " " << name_of(c.word);
  }
}

}  // namespace
}  // namespace skein::model
