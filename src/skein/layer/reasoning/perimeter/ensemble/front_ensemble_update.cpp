// SPDX-License-Identifier: Apache-2.0
// What an observation of one place teaches: FrontEnsemble's regressions.
#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/layer/reasoning/perimeter/ensemble/front_ensemble.h"
#include "skein/layer/reasoning/perimeter/ensemble/localisation.h"

namespace skein::perimeter {
namespace {

using FloatRow = Eigen::Map<Eigen::ArrayXf>;

FloatRow row_of(std::vector<float>& values, std::size_t start, int count) {
  return {values.data() + start, count};
}

}  // namespace

// Rows and columns [r0, r1) x [c0, c1) near a point, and their weights.
struct FrontEnsemble::Window {
  int r0 = 0, r1 = 0, c0 = 0, c1 = 0;
  std::vector<float> weight;
  int columns() const { return c1 - c0; }
  bool empty() const { return r1 <= r0 || c1 <= c0; }
};

FrontEnsemble::Window FrontEnsemble::window(const Vec2& p) const {
  const double reach = options_.reach_cells;
  const double row = (p.x() - grid_.low.x()) / grid_.cell;
  const double column = (p.y() - grid_.low.y()) / grid_.cell;
  Window w;
  w.r0 = std::max(1, static_cast<int>(std::ceil(row - reach)));
  w.r1 = std::min(grid_.rows - 1, static_cast<int>(std::floor(row + reach)) + 1);
  w.c0 = std::max(1, static_cast<int>(std::ceil(column - reach)));
  w.c1 = std::min(grid_.columns - 1, static_cast<int>(std::floor(column + reach)) + 1);
  if (w.empty()) return w;
  w.weight.reserve(static_cast<std::size_t>(w.r1 - w.r0) *
                   static_cast<std::size_t>(w.columns()));

  Vec2 normal = gradient(p);
  const double length = normal.norm();
  const bool use_normal = length > 0.1;
  if (use_normal) normal /= length;
  const auto stride = static_cast<std::size_t>(grid_.columns);
  const double inverse = 0.5 / grid_.cell;
  for (int r = w.r0; r < w.r1; ++r)
    for (int c = w.c0; c < w.c1; ++c) {
      double weight = gaspari_cohn(2 * math::hypot(r - row, c - column) / reach);
      if (use_normal && weight > 0) {
        const std::size_t i = grid_.index(r, c);
        const double gx = (mean_[i + stride] - mean_[i - stride]) * inverse;
        const double gy = (mean_[i + 1] - mean_[i - 1]) * inverse;
        const double alike = 0.5 * (1 + gx * normal.x() + gy * normal.y());
        weight *= std::clamp(alike * alike, 0.0, 1.0);
      }
      w.weight.push_back(static_cast<float>(weight));
    }
  return w;
}

void FrontEnsemble::teach_common(const MemberValues& at_p,
                                 const Eigen::VectorXd& change) {
  for (int k = 0; k < 3; ++k) {
    double mean = 0, square = 0, product = 0;
    for (const Member& m : members_) mean += m.common[k] / size();
    for (int j = 0; j < size(); ++j) {
      const double d = members_[static_cast<std::size_t>(j)].common[k] - mean;
      square += d * d;
      product += d * at_p.deviation[j];
    }
    if (!(square > 0)) continue;
    // How much of a correlation among so few members is to be believed.
    const double share = product * product / (square * (size() - 1) * at_p.variance);
    const double trust = share > 0 ? 1 - (1 - share) / (share * (size() - 2)) : 0.0;
    if (trust <= 0) continue;
    const double gain = trust * product / ((size() - 1) * at_p.variance);
    for (int j = 0; j < size(); ++j)
      members_[static_cast<std::size_t>(j)].common[k] += gain * change[j];
  }
}

void FrontEnsemble::regress(const Vec2& p, const MemberValues& at_p, double shift,
                            double scale) {
  if (!(at_p.variance > 0)) return;
  const double inverse = 1 / ((size() - 1) * at_p.variance);
  const Eigen::VectorXd change = (shift + (scale - 1) * at_p.deviation.array()).matrix();
  const auto member = [&](int j) -> Member& {
    return members_[static_cast<std::size_t>(j)];
  };

  teach_common(at_p, change);
  // The local rates, by distance only.
  const model::Grid nodes = members_[0].rate.coefficients.grid;
  const double rate_reach = 1.5 * reach();
  for (int r = 0; r < nodes.rows; ++r)
    for (int c = 0; c < nodes.columns; ++c) {
      const double weight = gaspari_cohn(2 * (nodes.node(r, c) - p).norm() / rate_reach);
      if (weight <= 0) continue;
      double covariance = 0;
      for (int j = 0; j < size(); ++j)
        covariance +=
            at_p.deviation[j] * static_cast<double>(member(j).rate.coefficients.at(r, c));
      const double gain = weight * covariance * inverse;
      for (int j = 0; j < size(); ++j)
        member(j).rate.coefficients.at(r, c) += static_cast<float>(gain * change[j]);
    }

  const Window w = window(p);
  if (w.empty()) return;
  const int n = w.columns();
  Eigen::ArrayXf gain(n);
  for (int r = w.r0; r < w.r1; ++r) {
    const std::size_t start = grid_.index(r, w.c0);
    gain.setZero();
    for (int j = 0; j < size(); ++j)
      gain +=
          static_cast<float>(at_p.deviation[j]) * row_of(member(j).phi.values, start, n);
    const Eigen::Map<const Eigen::ArrayXf> weight(
        w.weight.data() + static_cast<std::size_t>((r - w.r0) * n), n);
    gain = (gain * static_cast<float>(inverse)).max(-0.5F).min(1.5F) * weight;
    for (int j = 0; j < size(); ++j)
      row_of(member(j).phi.values, start, n) += static_cast<float>(change[j]) * gain;
    Eigen::Map<Eigen::ArrayXd>(mean_.data() + start, n) += shift * gain.cast<double>();
  }
}

void FrontEnsemble::displace(const Vec2& p, const Eigen::VectorXd& change) {
  const Window w = window(p);
  if (w.empty()) return;
  const int n = w.columns();
  for (int r = w.r0; r < w.r1; ++r) {
    const std::size_t start = grid_.index(r, w.c0);
    const Eigen::Map<const Eigen::ArrayXf> weight(
        w.weight.data() + static_cast<std::size_t>((r - w.r0) * n), n);
    for (int j = 0; j < size(); ++j)
      row_of(members_[static_cast<std::size_t>(j)].phi.values, start, n) +=
          static_cast<float>(change[j]) * weight;
    Eigen::Map<Eigen::ArrayXd>(mean_.data() + start, n) +=
        change.mean() * weight.cast<double>();
  }
}

void FrontEnsemble::stamp(const Vec2& p, bool inside, const Eigen::VectorXd& radius) {
  const double margin = radius.maxCoeff() + kMarginCells * grid_.cell;
  grow(p - Vec2(margin, margin), p + Vec2(margin, margin));
  for (int j = 0; j < size(); ++j) {
    model::Field& phi = members_[static_cast<std::size_t>(j)].phi;
    for (int r = 0; r < grid_.rows; ++r)
      for (int c = 0; c < grid_.columns; ++c) {
        const auto d = static_cast<float>((grid_.node(r, c) - p).norm() - radius[j]);
        float& v = phi.at(r, c);
        v = inside ? std::min(v, d) : std::max(v, -d);
      }
  }
  update_mean();
}

}  // namespace skein::perimeter
