// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/ensemble/member.h"

#include <gtest/gtest.h>

namespace skein::perimeter::member_test {
namespace {

// A front along the east axis that moves north, with rates that grow towards the east and
// are known up to it only.
Member straight_front() {
  model::Grid grid{Vec2(-480, -480), 10, 97, 97};
  Member m{{grid, std::vector<float>(grid.size())},
           {},
           Eigen::Vector3d::Zero(),
           RandomStream(1, 1, Purpose::kTest)};
  for (int r = 0; r < grid.rows; ++r)
    for (int c = 0; c < grid.columns; ++c)
      m.phi.at(r, c) = static_cast<float>(grid.node(r, c).x());
  const model::Grid nodes = spline_nodes(grid, 12);
  m.rate = {{nodes, std::vector<float>(nodes.size())}};
  for (int r = 0; r < nodes.rows; ++r)
    for (int c = 0; c < nodes.columns; ++c)
      if (nodes.node(r, c).x() <= 240)  // all that counts at the front
        m.rate.coefficients.at(r, c) =
            static_cast<float>(1 + nodes.node(r, c).y() / 1000);
  return m;
}

TEST(Member, AHeadCarriesItsRateWithIt) {
  Member m = straight_front();
  const auto rate_at = [&m](double north, double east) {
    return m.rate_at(model::spline_stencil(m.rate.coefficients.grid, Vec2(north, east)));
  };
  ASSERT_NEAR(rate_at(450, 300), 0, 0.01);
  carry_rate_ahead(m, 0);
  for (const double east : {-300.0, 0.0, 300.0}) {
    // Splines reproduce straight lines; coefficients beyond the grid's edge do not follow
    // them, which the rest allows for.
    EXPECT_NEAR(rate_at(0, east), 1 + east / 1000, 1e-3);
    EXPECT_NEAR(rate_at(450, east), 1 + east / 1000, 1e-3);
    EXPECT_NEAR(rate_at(-300, east), 1 + east / 1000, 1e-3);
  }
}

}  // namespace
}  // namespace skein::perimeter::member_test
