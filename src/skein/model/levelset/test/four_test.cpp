// SPDX-License-Identifier: Apache-2.0
#include "skein/model/levelset/four.h"

#include <gtest/gtest.h>

#include "shapes.h"
#include "skein/base/random.h"
#include "skein/model/levelset/reinitialise.h"

namespace skein::model::four_test {
namespace {

std::uint32_t bits(float x) {
  return std::bit_cast<std::uint32_t>(x);
}

TEST(Four, EachLaneIsLikeASingleNumber) {
  RandomStream random(3, 0, Purpose::kTest);
  const auto draw = [&] {
    const auto x = static_cast<float>(random.uniform(-3, 3));
    return random.uniform() < 0.2 ? std::copysign(0.0F, x) : x;
  };
  for (int k = 0; k < 1000; ++k) {
    const Four a{draw(), draw(), draw(), draw()}, b{draw(), draw(), draw(), draw()};
    const Four least = minimum(a, b), most = maximum(a, b), size = absolute(a),
               root_of = root(size), signs = with_sign_of(a, b);
    for (std::size_t n = 0; n < kLanes; ++n) {
      const float x = a[n], y = b[n];
      EXPECT_EQ(bits(least[n]), bits(std::min(x, y)));
      EXPECT_EQ(bits(most[n]), bits(std::max(x, y)));
      EXPECT_EQ(bits(size[n]), bits(std::abs(x)));
      EXPECT_EQ(bits(root_of[n]), bits(std::sqrt(std::abs(x))));
      EXPECT_EQ(bits(signs[n]), bits(std::copysign(x, y)));
    }
  }
}

TEST(Four, AnyAndAllLookAtEveryLane) {
  const FourBits none{};
  EXPECT_FALSE(any(none));
  for (std::size_t n = 0; n < kLanes; ++n) {
    FourBits one{}, others = ~none;
    one[n] = -1;
    others[n] = 0;
    EXPECT_TRUE(any(one));
    EXPECT_FALSE(all(others));
  }
  EXPECT_TRUE(all(~none));
}

// What is swept four nodes at a time is the same wherever the fours begin.
TEST(Four, DistancesDoNotDependOnTheFirstColumn) {
  const auto shape = [](const Vec2& p) { return (p.norm() - 90) * (2 + p.x() / 100); };
  Field whole = field_of(200, 10, shape);
  reinitialise(whole);
  for (int left_out = 1; left_out < 4; ++left_out) {
    Field part = field_of(200, 10, shape);
    const Grid all = part.grid;
    part.grid.low.y() += left_out * all.cell;
    part.grid.columns -= left_out;
    part.values.clear();
    for (int row = 0; row < all.rows; ++row)
      for (int column = left_out; column < all.columns; ++column)
        part.values.push_back(static_cast<float>(shape(all.node(row, column))));
    reinitialise(part);
    for (int row = 0; row < all.rows; ++row)
      for (int column = left_out; column < all.columns; ++column)
        ASSERT_EQ(bits(part.at(row, column - left_out)), bits(whole.at(row, column)))
            << row << ", " << column;
  }
}

}  // namespace
}  // namespace skein::model::four_test
