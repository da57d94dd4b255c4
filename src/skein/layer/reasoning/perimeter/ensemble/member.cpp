// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/ensemble/member.h"

#include <cmath>

#include "skein/geo/vec.h"
#include "skein/model/levelset/reinitialise.h"

namespace skein::perimeter {
namespace {

constexpr double kMaxDeviation = 3;  // of a member from the mean [standard deviations]

}  // namespace

model::Grid spline_nodes(const model::Grid& grid, int spacing_cells) {
  model::Grid nodes;
  nodes.cell = spacing_cells * grid.cell;
  nodes.low = grid.low - Vec2(1, 1) * nodes.cell;
  nodes.rows = (grid.rows - 1) / spacing_cells + 4;
  nodes.columns = (grid.columns - 1) / spacing_cells + 4;
  return nodes;
}

model::SplineField noise_field(RandomStream& stream, const model::Grid& nodes,
                               double sd) {
  model::SplineField field{{nodes, std::vector<float>(nodes.size())}};
  const double scale = sd / model::SplineField::kWhiteSd;
  for (float& v : field.coefficients.values)
    v = static_cast<float>(scale * stream.normal());
  return field;
}

void extend_member(Member& member, const Growth& growth, int rate_spacing_cells,
                   double rate_sd) {
  member.phi =
      model::extended(member.phi, growth.south, growth.west, growth.north, growth.east);
  model::reinitialise(member.phi);
  const model::Field& old = member.rate.coefficients;
  model::SplineField rate = noise_field(
      member.stream, spline_nodes(member.phi.grid, rate_spacing_cells), rate_sd);
  const int dr = growth.south / rate_spacing_cells;
  const int dc = growth.west / rate_spacing_cells;
  for (int r = 0; r < old.grid.rows; ++r)
    for (int c = 0; c < old.grid.columns; ++c)
      rate.coefficients.at(r + dr, c + dc) = old.at(r, c);
  member.rate = std::move(rate);
}

void coarsen_member(Member& member, int rate_spacing_cells) {
  // The grid must stay a whole number of rate spacings after doubling.
  const int unit = 2 * rate_spacing_cells;
  const int north = (unit - (member.phi.grid.rows - 1) % unit) % unit;
  const int east = (unit - (member.phi.grid.columns - 1) % unit) % unit;
  member.phi = model::coarsened(model::extended(member.phi, 0, 0, north, east));
  model::reinitialise(member.phi);
  const model::Grid nodes = spline_nodes(member.phi.grid, rate_spacing_cells);
  model::SplineField rate{{nodes, std::vector<float>(nodes.size())}};
  for (int r = 0; r < nodes.rows; ++r)
    for (int c = 0; c < nodes.columns; ++c)
      rate.coefficients.at(r, c) =
          static_cast<float>(member.rate.sample(nodes.node(r, c)));
  member.rate = std::move(rate);
}

void carry_rate_ahead(Member& member, double beyond) {
  const model::Grid& nodes = member.rate.coefficients.grid;
  // Nodes beyond the grid, and its edge, where there is no gradient, as their nearest.
  const model::Grid& grid = member.phi.grid;
  const Vec2 edge(2 * grid.cell, 2 * grid.cell);
  const Vec2 low = grid.low + edge, high = grid.high() - edge;
  std::vector<float> carried = member.rate.coefficients.values;
  for (int r = 0; r < nodes.rows; ++r)
    for (int c = 0; c < nodes.columns; ++c) {
      const Vec2 p = nodes.node(r, c).cwiseMax(low).cwiseMin(high);
      const double ahead = model::sample(member.phi, p);
      const Vec2 gradient = model::gradient(member.phi, p);
      const double slope = gradient.norm();
      if (ahead <= beyond || slope <= 0) continue;
      carried[nodes.index(r, c)] =
          static_cast<float>(member.rate.sample(p - ahead / slope * gradient));
    }
  member.rate.coefficients.values = std::move(carried);
}

void draw_in(std::vector<Member>& members) {
  const auto n = static_cast<Eigen::Index>(members.at(0).phi.values.size());
  const auto count = static_cast<double>(members.size());
  Eigen::ArrayXf mean = Eigen::ArrayXf::Zero(n), spread = Eigen::ArrayXf::Zero(n);
  const auto values = [n](Member& m) {
    return Eigen::Map<Eigen::ArrayXf>(m.phi.values.data(), n);
  };
  for (Member& m : members) mean += values(m);
  mean /= static_cast<float>(count);
  for (Member& m : members) spread += (values(m) - mean).abs();
  // The mean absolute deviation of a Gaussian is sqrt(2/pi) of its standard deviation.
  spread *= static_cast<float>(kMaxDeviation * std::sqrt(geo::kPi / 2) / count);
  for (Member& m : members) {
    auto phi = values(m);
    phi = phi.max(mean - spread).min(mean + spread);
  }
}

}  // namespace skein::perimeter
