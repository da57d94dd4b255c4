// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/ensemble/mean_boundary.h"

#include <algorithm>
#include <cmath>

#include "skein/geo/contour.h"

namespace skein::perimeter {
namespace {

constexpr double kGrowthSpan = 60;  // over which sigma's growth is averaged [s]

BoundaryPoint describe(const FrontEnsemble& ensemble, const Vec2& p, double floor) {
  BoundaryPoint out;
  const Vec2 gradient = ensemble.gradient(p);
  const double slope = gradient.norm();
  out.normal = slope > 0 ? Vec2(gradient / slope) : Vec2(1, 0);
  const MemberValues speed = ensemble.speed(p);
  const MemberValues distance = ensemble.distance(p, speed);
  // Where members disagree the mean is flatter than a distance: sigma grows with it.
  const double stretch = 1 / std::clamp(slope, 0.5, 1.0);
  const double variance = distance.variance * stretch * stretch + floor * floor;
  const double together = distance.deviation.dot(speed.deviation) / (ensemble.size() - 1);
  const double later = variance + kGrowthSpan * (ensemble.diffusion() - 2 * together +
                                                 kGrowthSpan * speed.variance);
  out.sigma = std::sqrt(variance);
  out.sigma_growth = (std::sqrt(std::max(later, 0.0)) - out.sigma) / kGrowthSpan;
  out.rate = speed.mean;
  out.position = p + out.normal * speed.mean * ensemble.lag();
  return out;
}

}  // namespace

BoundaryEstimate mean_boundary(const FrontEnsemble& ensemble, Time time,
                               const EnsembleOptions& options) {
  const model::Grid& grid = ensemble.grid();
  const geo::Region region =
      geo::contour(ensemble.mean(), grid.rows, grid.columns, grid.low, grid.cell, 0);
  double largest = 0;
  for (const geo::Ring& ring : region)
    largest = std::max(largest, geo::signed_area(ring));

  BoundaryEstimate out;
  out.time = time;
  const double floor = options.sigma_floor_cells * grid.cell;
  // Much finer than the grid there is nothing to say.
  const double spacing = std::max(options.control_spacing, 0.1 * grid.cell);
  for (const geo::Ring& ring : region) {
    const double area = geo::signed_area(ring);
    if (std::abs(area) < options.min_area && area != largest) continue;
    std::vector<BoundaryPoint> points;
    for (const Vec2& p : geo::resample_by_spacing(ring, spacing, 8))
      points.push_back(describe(ensemble, p, floor));
    out.rings.push_back(std::move(points));
  }
  return out;
}

}  // namespace skein::perimeter
