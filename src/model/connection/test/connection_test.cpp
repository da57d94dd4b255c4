#include "model/connection/connection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/connection/test/dense_search.h"

namespace skein::model {
namespace {

void expect_exact(const ConnectionQuery& q, std::uint32_t number) {
  const Connection c = connect(q.from, q.to, q.air);
  ASSERT_EQ(c.status, ConnectionStatus::kFound) << number;
  // Rounding of positions of a thousand radii is 1e-13 radii; near-tangent straights and
  // strong wind magnify it.
  ASSERT_LT(test::end_error(q, c), 1e-8) << number << " " << name_of(c.word);
  const double reference = test::dense_search(q, c.time, 300);
  ASSERT_LE(c.time * (1 - 1e-9), reference) << number << " " << name_of(c.word);
}

TEST(Connection, IsNeverLaterThanADenseSearchOnRandomCases) {
  for (std::uint32_t i = 0; i < 3000; ++i) expect_exact(test::random_case(i), i);
}

TEST(Connection, IsNeverLaterThanADenseSearchOnHardCases) {
  for (std::uint32_t i = 0; i < 3000; ++i) expect_exact(test::hard_case(i), i);
}

}  // namespace
}  // namespace skein::model
