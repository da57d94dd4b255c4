// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/ensemble/front_ensemble.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/model/levelset/advance.h"
#include "skein/model/levelset/reinitialise.h"

namespace skein::perimeter {
namespace {

constexpr double kBandCells = 6;
constexpr int kMinNodes = 10000;  // room for the margins around the smallest fire
// Minimum spread of the common rate and drift, against their first one.
const Eigen::Vector3d kCommonFloor(0.3, 0.05, 0.05);
// What is this near ahead of a front, of an observation's reach, was learned there.
constexpr double kOwnGround = 0.5;
// Looking ahead.
constexpr std::size_t kMinOutlookMembers = 14;
constexpr double kOutlookStep = 60;  // [s]
constexpr std::size_t kOutlookNodes = 6000;

}  // namespace

FrontEnsemble::FrontEnsemble(const PerimeterPrior& prior, const EnsembleOptions& options)
    : options_(options),
      rate_sd_(prior.rate_sd),
      common_sd_(std::sqrt(0.5) * prior.rate_sd, prior.wind_sd, prior.wind_sd) {
  SKEIN_CHECK(options.members >= 8 && options.members <= 200, options.members);
  SKEIN_CHECK(options.cell > 0 && options.step > 0, options.cell, options.step);
  SKEIN_CHECK(options.rate_spacing_cells % 2 == 0 && options.noise_spacing_cells > 0,
              options.rate_spacing_cells, options.noise_spacing_cells);
  options_.max_nodes = std::max(options.max_nodes, kMinNodes);
  initialise(prior);
}

void FrontEnsemble::initialise(const PerimeterPrior& prior) {
  const int block = options_.rate_spacing_cells;
  // As fine as leaves some room for the fire to grow before the grid coarsens.
  grid_.cell = options_.cell;
  int blocks = 0;
  double half = 0;
  for (;; grid_.cell *= 2) {
    half = prior.radius + 3 * prior.radius_sd + (kMarginCells + block) * grid_.cell;
    blocks = static_cast<int>(std::ceil(half / (block * grid_.cell)));
    grid_.rows = grid_.columns = 2 * blocks * block + 1;
    if (grid_.size() / 3 <= static_cast<std::size_t>(options_.max_nodes) / 4) break;
  }
  grid_.low = prior.origin - Vec2(1, 1) * blocks * block * grid_.cell;

  // The unknown shape: displacements of the boundary that are smooth over half a radius.
  model::Grid shape_nodes;
  shape_nodes.cell = std::max(0.6 * prior.radius, 4 * grid_.cell);
  const int reach = static_cast<int>(std::ceil(half / shape_nodes.cell)) + 2;
  shape_nodes.low = prior.origin - Vec2(1, 1) * reach * shape_nodes.cell;
  shape_nodes.rows = shape_nodes.columns = 2 * reach + 1;

  for (int j = 0; j < options_.members; ++j) {
    Member m{
        {grid_, std::vector<float>(grid_.size())},
        {},
        Eigen::Vector3d::Zero(),
        RandomStream(options_.seed, static_cast<std::uint32_t>(j), Purpose::kEnsemble)};
    for (int row = 0; row < grid_.rows; ++row)
      for (int column = 0; column < grid_.columns; ++column)
        m.phi.at(row, column) = static_cast<float>(
            (grid_.node(row, column) - prior.origin).norm() - prior.radius);
    noise_field(m.stream, shape_nodes, prior.radius_sd).add_to(m.phi, 1);
    // The common and the local part of the rate are unknown to equal parts.
    m.rate = noise_field(m.stream, spline_nodes(grid_, block), common_sd_[0]);
    m.common << prior.rate, prior.wind;
    for (int k = 0; k < 3; ++k) m.common[k] += common_sd_[k] * m.stream.normal();
    model::reinitialise(m.phi);
    members_.push_back(std::move(m));
  }
  update_mean();
}

void FrontEnsemble::look_ahead() {
  const std::size_t every =
      std::max<std::size_t>(1, members_.size() / kMinOutlookMembers);
  std::vector<Member> few;
  for (std::size_t k = 0; k < members_.size(); k += every)
    few.push_back(std::move(members_[k]));
  members_ = std::move(few);
  options_.step = std::max(options_.step, kOutlookStep);
  longest_untidy_ = 4 * options_.step;
  options_.roughness = 0;
  options_.max_nodes = kMinNodes;
  while (grid_.size() > kOutlookNodes) coarsen();
  update_mean();
}

double FrontEnsemble::diffusion() const {
  const double length = options_.noise_spacing_cells * grid_.cell;
  return noise_factor_ * options_.roughness * options_.roughness * rate_sd_ * length;
}

double FrontEnsemble::step_length() const {
  // Half a cell at the members' mean speed bounds the error of carrying values over the
  // lag by their local speed.
  double sum = 0;
  for (const Member& m : members_) sum += std::max(0.0, m.common[0]) + m.drift().norm();
  const double speed = std::max(sum / size(), 1e-3);
  return std::min(options_.step, 0.5 * grid_.cell / speed);
}

void FrontEnsemble::predict(double dt) {
  lag_ += dt;
  const double step = step_length();
  while (lag_ >= step) {
    move(step);
    lag_ -= step;
    since_noise_ += step;
    if (since_noise_ >= std::min(longest_untidy_, 4 * step)) {
      add_noise(since_noise_);
      since_noise_ = 0;
      tidy();
    }
    update_mean();
  }
}

void FrontEnsemble::move(double dt) {
  model::Field local{grid_, std::vector<float>(grid_.size())};
  for (Member& m : members_) {
    std::fill(local.values.begin(), local.values.end(), static_cast<float>(m.common[0]));
    m.rate.add_to(local, 1);
    model::advance(m.phi, {local.values, m.drift()}, dt, kBandCells * grid_.cell);
  }
}

void FrontEnsemble::add_noise(double dt) {
  const double keep = math::exp(-dt / options_.rate_memory);
  const double rate_noise = rate_sd_ * std::sqrt(0.5 * noise_factor_ * (1 - keep * keep));
  const double boundary_noise = std::sqrt(diffusion() * dt);
  const model::Grid boundary_nodes = spline_nodes(grid_, options_.noise_spacing_cells);

  for (Member& m : members_) {
    auto& rate = m.rate.coefficients;
    const model::SplineField fresh = noise_field(m.stream, rate.grid, rate_noise);
    for (std::size_t i = 0; i < rate.values.size(); ++i)
      rate.values[i] =
          static_cast<float>(keep) * rate.values[i] + fresh.coefficients.values[i];
    noise_field(m.stream, boundary_nodes, boundary_noise).add_to(m.phi, 1);
  }
  keep_common_spread();
}

// What holds everywhere is observed thousands of times; without a floor the members would
// agree on it, and on what is wrong with it, for ever.
void FrontEnsemble::keep_common_spread() {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero(), square = Eigen::Vector3d::Zero();
  for (const Member& m : members_) mean += m.common / size();
  for (const Member& m : members_) square += (m.common - mean).cwiseAbs2() / (size() - 1);
  for (int k = 0; k < 3; ++k) {
    const double sd = std::sqrt(square[k]), min = kCommonFloor[k] * common_sd_[k];
    if (sd >= min || sd <= 0) continue;
    for (Member& m : members_) m.common[k] = mean[k] + (m.common[k] - mean[k]) * min / sd;
  }
}

void FrontEnsemble::tidy() {
  draw_in(members_);
  update_mean();
  const std::vector<std::size_t> unseen = unseen_nodes(grid_, evidence_, mean_);
  for (Member& m : members_)
    for (const std::size_t i : unseen) {
      float& value = m.phi.values[i];
      value = mean_[i] < 0 ? std::abs(value) : -std::abs(value);
    }
  for (const std::size_t i : unseen) mean_[i] = -mean_[i];
  for (Member& m : members_) {
    drop_remnants(mean_, m.phi);
    model::reinitialise(m.phi);
    carry_rate_ahead(m, kOwnGround * reach());
  }
  // Where a front is near the edge of the grid.
  const double margin = kMarginCells * grid_.cell;
  Vec2 low = grid_.low, high = grid_.high();
  for (const Member& m : members_) {
    const auto near = [&](int row, int column) {
      return m.phi.at(row, column) < static_cast<float>(margin);
    };
    for (int c = 0; c < grid_.columns; ++c) {
      if (near(0, c)) low.x() = grid_.low.x() - margin;
      if (near(grid_.rows - 1, c)) high.x() = grid_.high().x() + margin;
    }
    for (int r = 0; r < grid_.rows; ++r) {
      if (near(r, 0)) low.y() = grid_.low.y() - margin;
      if (near(r, grid_.columns - 1)) high.y() = grid_.high().y() + margin;
    }
  }
  grow(low, high);
}

// What is missing for the grid to reach from `low` to `high`.
Growth FrontEnsemble::growth_to(const Vec2& low, const Vec2& high) const {
  const int unit = 2 * options_.rate_spacing_cells;
  const auto rows = [&](double missing) {
    return missing > 0 ? unit * static_cast<int>(std::ceil(missing / (unit * grid_.cell)))
                       : 0;
  };
  return {rows(grid_.low.x() - low.x()), rows(grid_.low.y() - low.y()),
          rows(high.x() - grid_.high().x()), rows(high.y() - grid_.high().y())};
}

void FrontEnsemble::coarsen() {
  for (Member& m : members_) coarsen_member(m, options_.rate_spacing_cells);
  grid_ = members_[0].phi.grid;
}

void FrontEnsemble::grow(const Vec2& low, const Vec2& high) {
  const auto max = static_cast<double>(options_.max_nodes);
  if (!growth_to(low, high).any()) return;
  // Far away: fine cells up to there would not fit into the memory.
  const auto nodes = [&] {
    const Vec2 size =
        (high.cwiseMax(grid_.high()) - low.cwiseMin(grid_.low)) / grid_.cell;
    return size.x() * size.y();
  };
  while (nodes() > 4 * max) coarsen();
  const double rate_sd = rate_sd_ * std::sqrt(0.5 * noise_factor_);
  const Growth growth = growth_to(low, high);
  for (Member& m : members_)
    extend_member(m, growth, options_.rate_spacing_cells, rate_sd);
  grid_ = members_[0].phi.grid;
  while (static_cast<double>(grid_.size()) > max) coarsen();
}

void FrontEnsemble::update_mean() {
  const auto n = static_cast<Eigen::Index>(grid_.size());
  Eigen::ArrayXf sum = Eigen::ArrayXf::Zero(n);
  for (Member& m : members_)
    sum += Eigen::Map<const Eigen::ArrayXf>(m.phi.values.data(), n);
  mean_.resize(grid_.size());
  Eigen::Map<Eigen::ArrayXd>(mean_.data(), n) = sum.cast<double>() / size();
}

MemberValues FrontEnsemble::summary(Eigen::VectorXd values) const {
  MemberValues out;
  out.mean = values.mean();
  out.deviation = values.array() - out.mean;
  out.variance = out.deviation.squaredNorm() / (size() - 1);
  return out;
}

MemberValues FrontEnsemble::speed(const Vec2& p) const {
  const Vec2 g = gradient(p);
  const double length = g.norm();
  const Vec2 normal = length > 0 ? Vec2(g / length) : Vec2(Vec2::Zero());
  const model::SplineStencil place =
      model::spline_stencil(members_[0].rate.coefficients.grid, p);
  Eigen::VectorXd values(size());
  for (int j = 0; j < size(); ++j) {
    const Member& m = members_[static_cast<std::size_t>(j)];
    values[j] = std::max(0.0, m.rate_at(place) + m.drift().dot(normal));
  }
  return summary(std::move(values));
}

MemberValues FrontEnsemble::distance(const Vec2& p) const {
  return distance(p, lag_ > 0 ? speed(p) : MemberValues());
}

MemberValues FrontEnsemble::distance(const Vec2& p, const MemberValues& v) const {
  const model::Stencil at = model::stencil(grid_, p);
  const double outside = (p - p.cwiseMax(grid_.low).cwiseMin(grid_.high())).norm();
  Eigen::VectorXd values(size());
  for (int j = 0; j < size(); ++j)
    values[j] = outside + at.value(members_[static_cast<std::size_t>(j)].phi.values);
  if (lag_ > 0) values.array() -= lag_ * (v.mean + v.deviation.array());
  return summary(std::move(values));
}

Vec2 FrontEnsemble::gradient(const Vec2& p) const {
  const auto value = [&](const Vec2& q) {
    const model::Stencil s = model::stencil(grid_, q);
    return static_cast<double>(s.w00) * mean_[s.corner] +
           static_cast<double>(s.w01) * mean_[s.corner + 1] +
           static_cast<double>(s.w10) * mean_[s.corner + s.stride] +
           static_cast<double>(s.w11) * mean_[s.corner + s.stride + 1];
  };
  const double h = grid_.cell;
  return {(value(p + Vec2(h, 0)) - value(p - Vec2(h, 0))) / (2 * h),
          (value(p + Vec2(0, h)) - value(p - Vec2(0, h))) / (2 * h)};
}

Eigen::VectorXd FrontEnsemble::draw() {
  Eigen::VectorXd values(size());
  for (int j = 0; j < size(); ++j)
    values[j] = members_[static_cast<std::size_t>(j)].stream.normal();
  return values;
}

}  // namespace skein::perimeter
