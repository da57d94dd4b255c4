// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/joint/outer_products.h"

#include <algorithm>
#include <cstring>

#include "skein/base/check.h"

// Compiled once more for 256-bit registers; which one runs is chosen when the program
// starts. There is no other difference: additions and multiplications are rounded the
// same, and nothing contracts them. The thread sanitizer is not ready so early.
#if defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_THREAD__)
#define SKEIN_WIDE [[gnu::target_clones("avx2", "default")]]
#else
#define SKEIN_WIDE
#endif

namespace skein::perimeter {
namespace {

using Lanes [[gnu::vector_size(32)]] = double;
constexpr Eigen::Index kLanes = 4;

struct Scaled {
  const double* x;
  double factor;
};

// to[i] += factor x[i] of one vector.
SKEIN_WIDE void add_one(double* P, Eigen::Index size, Eigen::Index full, Scaled a) {
  for (Eigen::Index j = 0; j < size; ++j) {
    double* column = P + j * size;
    const double ga = a.factor * a.x[j];
    Eigen::Index i = std::min(j, full);
    for (; i + kLanes <= size; i += kLanes) {
      Lanes p, xa;
      std::memcpy(&p, column + i, sizeof p);
      std::memcpy(&xa, a.x + i, sizeof xa);
      p += ga * xa;
      std::memcpy(column + i, &p, sizeof p);
    }
    for (; i < size; ++i) column[i] += ga * a.x[i];
  }
}

// The same of two vectors, one after the other.
SKEIN_WIDE void add_two(double* P, Eigen::Index size, Eigen::Index full, Scaled a,
                        Scaled b) {
  for (Eigen::Index j = 0; j < size; ++j) {
    double* column = P + j * size;
    const double ga = a.factor * a.x[j], gb = b.factor * b.x[j];
    Eigen::Index i = std::min(j, full);
    for (; i + kLanes <= size; i += kLanes) {
      Lanes p, xa, xb;
      std::memcpy(&p, column + i, sizeof p);
      std::memcpy(&xa, a.x + i, sizeof xa);
      std::memcpy(&xb, b.x + i, sizeof xb);
      p += ga * xa;
      p += gb * xb;
      std::memcpy(column + i, &p, sizeof p);
    }
    for (; i < size; ++i) {
      column[i] += ga * a.x[i];
      column[i] += gb * b.x[i];
    }
  }
}

}  // namespace

void add_outer_product(Eigen::MatrixXd& P, Eigen::Index full,
                       const OuterProduct& product) {
  SKEIN_CHECK(P.rows() == P.cols() && product.x.size() == P.rows());
  add_one(P.data(), P.rows(), full, {product.x.data(), product.gain});
}

void add_outer_products(Eigen::MatrixXd& P, Eigen::Index full, const OuterProduct& first,
                        const OuterProduct& second) {
  SKEIN_CHECK(P.rows() == P.cols() && first.x.size() == P.rows() &&
              second.x.size() == P.rows());
  add_two(P.data(), P.rows(), full, {first.x.data(), first.gain},
          {second.x.data(), second.gain});
}

}  // namespace skein::perimeter
