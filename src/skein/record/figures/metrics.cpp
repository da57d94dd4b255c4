// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "skein/base/math.h"
#include "skein/geo/clip.h"

namespace skein::record {
namespace {

constexpr double kSampleSpacing = 25;   // [m]
constexpr double kMinSamples = 200;     // over all rings
constexpr double kMaxSamples = 20'000;  // coarser for a belief that has run away
constexpr double kBand95 = 1.959963984540054;
// A deviation below this says "exactly here": no ratio to it means anything. [m]
constexpr double kMinSigma = 1e-6;

constexpr std::array kFields = {
    MetricField{"perf", "_m", &PerimeterMetrics::perf},
    MetricField{"rmse", "_m", &PerimeterMetrics::rmse},
    MetricField{"sigma", "_m", &PerimeterMetrics::sigma},
    MetricField{"boundary_rms", "_m", &PerimeterMetrics::boundary_rms},
    MetricField{"boundary_hausdorff", "_m", &PerimeterMetrics::boundary_hausdorff},
    MetricField{"iou", "", &PerimeterMetrics::iou},
    MetricField{"coverage_95", "", &PerimeterMetrics::coverage_95},
    MetricField{"nees", "", &PerimeterMetrics::nees},
    MetricField{"crps", "_m", &PerimeterMetrics::crps},
    MetricField{"latency_mean", "_s", &PerimeterMetrics::latency_mean},
    MetricField{"latency_max", "_s", &PerimeterMetrics::latency_max},
    MetricField{"truth_area", "_m2", &PerimeterMetrics::truth_area},
    MetricField{"area_error", "_m2", &PerimeterMetrics::area_error},
};

// CRPS of N(0, sigma^2) when err is found: sigma [z erf(z/sqrt2) + 2 phi(z) - 1/sqrt pi].
// Reference: [Gneiting07] Eq. (21), with the sign turned so that small is good.
double gaussian_crps(double err, double sigma) {
  if (sigma < kMinSigma) return std::abs(err);
  const double z = err / sigma;
  const double density = math::exp(-z * z / 2) / std::sqrt(2 * geo::kPi);
  return sigma * (z * math::erf(z / std::numbers::sqrt2) + 2 * density -
                  std::numbers::inv_sqrtpi);
}

void compare_points(const TrueBoundary& truth, const BoundaryEstimate& belief,
                    PerimeterMetrics& out) {
  double n = 0, n_sigma = 0, err2 = 0, sigma2 = 0, covered = 0, nees = 0, crps = 0;
  for (const auto& ring : belief.rings)
    for (const BoundaryPoint& point : ring) {
      const double err = truth.index().nearest(point.position).distance;
      const double sigma = std::max(0.0, point.sigma);
      n += 1;
      err2 += err * err;
      sigma2 += sigma * sigma;
      covered += err <= kBand95 * sigma ? 1 : 0;
      crps += gaussian_crps(err, sigma);
      if (sigma >= kMinSigma) {
        n_sigma += 1;
        nees += err * err / (sigma * sigma);
      }
    }
  if (n == 0) return;
  out.perf = std::sqrt((err2 + sigma2) / n);
  out.rmse = std::sqrt(err2 / n);
  out.sigma = std::sqrt(sigma2 / n);
  out.coverage_95 = covered / n;
  out.crps = crps / n;
  if (n_sigma > 0) out.nees = nees / n_sigma;
}

struct Spread {
  double mean_square = 0;
  double largest = 0;
};

Spread distances(std::span<const Vec2> points, const geo::BoundaryIndex& to) {
  Spread spread;
  for (const Vec2& p : points) {
    const double d = to.nearest(p).distance;
    spread.mean_square += d * d / static_cast<double>(points.size());
    spread.largest = std::max(spread.largest, d);
  }
  return spread;
}

}  // namespace

std::span<const MetricField> metric_fields() {
  return kFields;
}

geo::Ring boundary_samples(const geo::Region& region) {
  double total = 0;
  for (const geo::Ring& ring : region)
    if (ring.size() >= 3) total += geo::length(ring);
  geo::Ring samples;
  if (total <= 0) return samples;
  const double spacing =
      std::clamp(kSampleSpacing, total / kMaxSamples, total / kMinSamples);
  for (const geo::Ring& ring : region) {
    if (ring.size() < 3) continue;
    const geo::Ring points = geo::resample_by_spacing(ring, spacing);
    samples.insert(samples.end(), points.begin(), points.end());
  }
  return samples;
}

// A belief that ran away, as far as areas can still be computed: clipping has its limits,
// and a fire larger than the Earth is wrong enough.
geo::Region within_earth(geo::Region rings) {
  constexpr double kFarthest = 3.9e7;  // [m]; geo/clip.h allows 4e7
  for (geo::Ring& ring : rings)
    for (Vec2& point : ring) point = point.cwiseMin(kFarthest).cwiseMax(-kFarthest);
  return rings;
}

TrueBoundary::TrueBoundary(geo::Region region)
    : region_(std::move(region)), index_(region_), samples_(boundary_samples(region_)) {}

PerimeterMetrics perimeter_metrics(const TrueBoundary& truth,
                                   const BoundaryEstimate& belief) {
  PerimeterMetrics out;
  const geo::Region rings = rings_of(belief);
  const geo::Region near = within_earth(rings);
  // A belief may cross itself; the truth never does.
  const double believed = geo::shared_area(near, near, geo::FillRule::kPositive);
  const double real = geo::area(truth.region());
  const double both = geo::shared_area(truth.region(), near, geo::FillRule::kPositive);
  const double either = believed + real - both;
  // Clipping rounds to 0.1 mm.
  out.iou = either > 0 ? std::min(1.0, both / either) : 1.0;
  out.truth_area = real;
  out.area_error = believed - real;
  if (truth.index().empty()) return out;
  compare_points(truth, belief, out);

  const geo::Ring samples = boundary_samples(rings);
  if (samples.empty() || truth.samples().empty()) return out;
  const Spread outward = distances(samples, truth.index());
  const Spread inward = distances(truth.samples(), geo::BoundaryIndex(rings));
  out.boundary_rms = std::sqrt((outward.mean_square + inward.mean_square) / 2);
  out.boundary_hausdorff = std::max(outward.largest, inward.largest);
  return out;
}

PerimeterMetrics perimeter_metrics(const geo::Region& truth,
                                   const BoundaryEstimate& belief) {
  return perimeter_metrics(TrueBoundary(truth), belief);
}

}  // namespace skein::record
