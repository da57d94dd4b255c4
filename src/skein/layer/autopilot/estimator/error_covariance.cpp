// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/estimator/error_covariance.h"

#include <algorithm>

namespace skein::autopilot {
namespace {

constexpr std::size_t kDriven = error::kSize - error::kAttitude;  // attitude and on
constexpr std::size_t kDriving = 9;  // the inertial biases and scales
constexpr std::size_t kOthers = error::kAttitude;

static_assert(error::kGyroBias == 0 && error::kAccelBias == 3 && error::kGyroScale == 6 &&
              error::kVelocity == error::kAttitude + 3 &&
              error::kPosition == error::kAttitude + 6);

// Rows of a matrix: first the driving states, then the driven ones.
template <std::size_t kColumns>
struct Rows {
  alignas(16) double driving[kDriving][kColumns];
  alignas(16) double driven[kDriven][kColumns];
};

// The driven rows of F times the matrix.
template <std::size_t kColumns>
void advance(const Transition& f, Rows<kColumns>& m) {
  alignas(16) double before[3][kColumns];
  alignas(16) double mean[3][kColumns];
  for (std::size_t r = 0; r < 3; ++r) {
    const double a0 = f.A[r][0], a1 = f.A[r][1], a2 = f.A[r][2];
    const double c0 = f.C[r][0], c1 = f.C[r][1], c2 = f.C[r][2];
    for (std::size_t j = 0; j < kColumns; ++j) {
      const double turn =
          a0 * m.driving[0][j] + a1 * m.driving[1][j] + a2 * m.driving[2][j] +
          (c0 * m.driving[6][j] + c1 * m.driving[7][j] + c2 * m.driving[8][j]);
      const double theta = m.driven[r][j];
      mean[r][j] = theta - 0.5 * turn;
      m.driven[r][j] = theta - turn;
    }
  }
  for (std::size_t r = 0; r < 3; ++r) {
    const std::size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3;
    const double s1 = f.s[r1], s2 = f.s[r2];
    const double a0 = f.A[r][0], a1 = f.A[r][1], a2 = f.A[r][2];
    for (std::size_t j = 0; j < kColumns; ++j) {
      const double v = m.driven[3 + r][j];
      before[r][j] = v;
      m.driven[3 + r][j] =
          v - (s1 * mean[r2][j] - s2 * mean[r1][j]) -
          (a0 * m.driving[3][j] + a1 * m.driving[4][j] + a2 * m.driving[5][j]);
    }
  }
  const double half = 0.5 * f.dt;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t j = 0; j < kColumns; ++j)
      m.driven[6 + r][j] += half * (before[r][j] + m.driven[3 + r][j]);
}

}  // namespace

void ErrorCovariance::propagate(const Transition& step) {
  constexpr std::size_t kWide = error::kSize + error::kSize % 2;
  Rows<kWide> rows{};
  for (std::size_t j = 0; j < error::kSize; ++j)
    for (std::size_t i = 0; i < kDriving; ++i) rows.driving[i][j] = (*this)(i, j);
  for (std::size_t i = 0; i < kDriven; ++i) {
    const double* row = &p_[row_start(kOthers + i)];
    for (std::size_t j = 0; j < kOthers; ++j) rows.driven[i][j] = row[j];
    for (std::size_t j = 0; j <= i; ++j)
      rows.driven[i][kOthers + j] = rows.driven[j][kOthers + i] = row[kOthers + j];
  }
  advance(step, rows);

  // The same from the right, which gives the driven block.
  constexpr std::size_t kEven = kDriven + kDriven % 2;
  Rows<kEven> columns;
  for (std::size_t i = 0; i < kEven; ++i) {
    const std::size_t row = i < kDriven ? i : kDriven - 1;
    for (std::size_t k = 0; k < kDriving; ++k)
      columns.driving[k][i] = rows.driven[row][k];
    for (std::size_t k = 0; k < kDriven; ++k)
      columns.driven[k][i] = rows.driven[row][kOthers + k];
  }
  advance(step, columns);

  for (std::size_t i = 0; i < kOthers; ++i) {
    double* row = &p_[row_start(i)];
    const double d = step.decay[i];
    for (std::size_t j = 0; j < i; ++j) row[j] *= d * step.decay[j];
    row[i] = row[i] * d * d + step.noise[i];
  }
  for (std::size_t i = 0; i < kDriven; ++i) {
    double* row = &p_[row_start(kOthers + i)];
    for (std::size_t j = 0; j < kOthers; ++j) row[j] = rows.driven[i][j] * step.decay[j];
    for (std::size_t j = 0; j <= i; ++j) row[kOthers + j] = columns.driven[j][i];
    row[kOthers + i] += step.noise[kOthers + i];
  }
}

double ErrorCovariance::project(const SparseRow& h, ErrorVector& ph) const {
  ph.fill(0);
  for (std::size_t k = 0; k < h.size; ++k) {
    const std::size_t c = h.index[k];
    const double value = h.value[k];
    const double* row = &p_[row_start(c)];
    for (std::size_t j = 0; j <= c; ++j) ph[j] += value * row[j];
    const double* below = row + row_length(c) + c;
    for (std::size_t i = c + 1; i < error::kSize; ++i) {
      ph[i] += value * *below;
      below += row_length(i);
    }
  }
  return h.dot(ph);
}

void ErrorCovariance::reduce(const ErrorVector& ph, double s) {
  static_assert(error::kSize % 2 == 0);
  const double scale = 1 / s;
  double* __restrict row = p_.data();
  const double* __restrict x = ph.data();
  for (std::size_t k = 0; k < error::kSize; k += 2) {
    const double g0 = x[k] * scale, g1 = x[k + 1] * scale;
    const std::size_t length = k + 2;
    for (std::size_t j = 0; j < length; j += 2) {
      row[j] -= g0 * x[j];
      row[j + 1] -= g0 * x[j + 1];
      row[length + j] -= g1 * x[j];
      row[length + j + 1] -= g1 * x[j + 1];
    }
    row += 2 * length;
  }
}

void ErrorCovariance::turn(std::size_t at, const Mat3& R) {
  const auto turned = [&R](double x, double y, double z) {
    return std::array{R(0, 0) * x + R(0, 1) * y + R(0, 2) * z,
                      R(1, 0) * x + R(1, 1) * y + R(1, 2) * z,
                      R(2, 0) * x + R(2, 1) * y + R(2, 2) * z};
  };
  double* rows[3] = {&p_[row_start(at)], &p_[row_start(at + 1)], &p_[row_start(at + 2)]};
  for (std::size_t j = 0; j < at; ++j) {
    const auto x = turned(rows[0][j], rows[1][j], rows[2][j]);
    for (std::size_t k = 0; k < 3; ++k) rows[k][j] = x[k];
  }
  for (std::size_t i = at + 3; i < error::kSize; ++i) {
    double* row = &p_[row_start(i) + at];
    const auto x = turned(row[0], row[1], row[2]);
    for (std::size_t k = 0; k < 3; ++k) row[k] = x[k];
  }
  std::array<std::array<double, 3>, 3> half{};
  for (std::size_t j = 0; j < 3; ++j) {
    const auto x =
        turned((*this)(at, at + j), (*this)(at + 1, at + j), (*this)(at + 2, at + j));
    for (std::size_t k = 0; k < 3; ++k) half[k][j] = x[k];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const auto x = turned(half[k][0], half[k][1], half[k][2]);
    for (std::size_t j = 0; j <= k; ++j) rows[k][at + j] = x[j];
  }
}

void ErrorCovariance::restart(std::size_t i, double variance) {
  for (std::size_t j = 0; j < i; ++j) p_[row_start(i) + j] = 0;
  for (std::size_t j = i + 1; j < error::kSize; ++j) p_[row_start(j) + i] = 0;
  p_[row_start(i) + i] = variance;
}

}  // namespace skein::autopilot
