// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/turbulence/transverse_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "skein/base/math.h"

namespace skein::environment {
namespace {

// y = kFirst x1 + kSecond x2
constexpr double kFirst = std::numbers::sqrt3 / std::numbers::sqrt2;
constexpr double kSecond = (1 - std::numbers::sqrt3) / std::numbers::sqrt2;

}  // namespace

void TransverseFilter::discretise(double distance, double length, double reach) {
  a_ = 1 / length;
  c_ = 1 / reach;
  // The closed form divides by c - a; a thousandth beside it is as good.
  if (std::abs(c_ - a_) < 1e-3 * a_) c_ = a_ * (1 + 1e-3);
  const double e = math::exp(-a_ * distance), f = math::exp(-c_ * distance);
  const double apart = c_ - a_;
  const double through = c_ * (e - f) / apart;  // of a decaying exp(-a s) to x3
  const double ramp =
      c_ * a_ * (distance * e - (e - f) / apart) / apart;  // of a s exp(-a s)
  const double a11 = e, a21 = a_ * distance * e;
  const double a31 = kFirst * through + kSecond * ramp, a32 = kSecond * through;
  transition_ = {a11, a21, a31, a32, f};

  const Triangle p = steady();
  // Q = P - A P A', by rows of B = A P (its upper right is not needed).
  const double b11 = a11 * p[0];
  const double b21 = a21 * p[0] + a11 * p[1], b22 = a21 * p[1] + a11 * p[2];
  const double b31 = a31 * p[0] + a32 * p[1] + f * p[3];
  const double b32 = a31 * p[1] + a32 * p[2] + f * p[4];
  const double b33 = a31 * p[3] + a32 * p[4] + f * p[5];
  noise_ = root({p[0] - b11 * a11, p[1] - b21 * a11, p[2] - b21 * a21 - b22 * a11,
                 p[3] - b31 * a11, p[4] - b31 * a21 - b32 * a11,
                 p[5] - b31 * a31 - b32 * a32 - b33 * f});
}

// From d/ds E[x x'] = 0, one element after the other.
TransverseFilter::Triangle TransverseFilter::steady() const {
  const double p13 = c_ * (kFirst + kSecond / 2) / (a_ + c_);
  const double p23 = (a_ * p13 + c_ * (kFirst + kSecond) / 2) / (a_ + c_);
  return {1, 0.5, 0.5, p13, p23, kFirst * p13 + kSecond * p23};
}

// Cholesky. A pivot that rounding has brought to 0 stands for a noise that is none.
TransverseFilter::Triangle TransverseFilter::root(const Triangle& m) {
  Triangle r{};
  r[0] = std::sqrt(std::max(m[0], 0.0));
  if (r[0] > 0) {
    r[1] = m[1] / r[0];
    r[3] = m[3] / r[0];
  }
  r[2] = std::sqrt(std::max(m[2] - r[1] * r[1], 0.0));
  if (r[2] > 0) r[4] = (m[4] - r[3] * r[1]) / r[2];
  r[5] = std::sqrt(std::max(m[5] - r[3] * r[3] - r[4] * r[4], 0.0));
  return r;
}

void TransverseFilter::start(const Normals& n) {
  const Triangle r = root(steady());
  x1_ = r[0] * n[0];
  x2_ = r[1] * n[0] + r[2] * n[1];
  x3_ = r[3] * n[0] + r[4] * n[1] + r[5] * n[2];
}

void TransverseFilter::step(const Normals& n) {
  const auto& [a11, a21, a31, a32, a33] = transition_;
  const double x1 = a11 * x1_ + noise_[0] * n[0];
  const double x2 = a21 * x1_ + a11 * x2_ + noise_[1] * n[0] + noise_[2] * n[1];
  x3_ = a31 * x1_ + a32 * x2_ + a33 * x3_ + noise_[3] * n[0] + noise_[4] * n[1] +
        noise_[5] * n[2];
  x1_ = x1;
  x2_ = x2;
}

double TransverseFilter::gust() const {
  return kFirst * x1_ + kSecond * x2_;
}

double TransverseFilter::gradient() const {
  return c_ * (gust() - x3_);
}

}  // namespace skein::environment
