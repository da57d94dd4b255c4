// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/joint/outer_products.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "skein/base/random.h"

namespace skein::perimeter::outer_products_test {
namespace {

TEST(OuterProducts, AreThoseOfAPlainLoopToTheLastBit) {
  RandomStream random(4, 0, Purpose::kTest);
  for (int size = 1; size < 24; ++size) {
    const Eigen::Index full = size / 2;
    const auto draw = [&](Eigen::Index rows, Eigen::Index columns) -> Eigen::MatrixXd {
      return Eigen::MatrixXd::NullaryExpr(rows, columns,
                                          [&] { return random.uniform(-1, 1); });
    };
    const Eigen::VectorXd x = draw(size, 1), y = draw(size, 1);
    Eigen::MatrixXd P = draw(size, size), plain = P;
    add_outer_product(P, full, {x, 0.7});
    add_outer_products(P, full, {x, -0.3}, {y, 1.1});
    for (int j = 0; j < size; ++j)
      for (Eigen::Index i = std::min<Eigen::Index>(j, full); i < size; ++i) {
        plain(i, j) += (0.7 * x[j]) * x[i];
        plain(i, j) += (-0.3 * x[j]) * x[i];
        plain(i, j) += (1.1 * y[j]) * y[i];
      }
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i)
        EXPECT_EQ(std::bit_cast<std::uint64_t>(P(i, j)),
                  std::bit_cast<std::uint64_t>(plain(i, j)))
            << size << ": " << i << ", " << j;
  }
}

}  // namespace
}  // namespace skein::perimeter::outer_products_test
