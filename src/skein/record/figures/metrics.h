// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "skein/data/perimeter/fire.h"
#include "skein/geo/boundary_index.h"

namespace skein::record {

/// How well a believed boundary agrees with the true one, at one time. What cannot be
/// said is absent, never NaN: without a true or a believed boundary everything but `iou`
/// and the areas is absent; `nees` is absent when no point states a deviation.
struct PerimeterMetrics {
  /// sqrt(mean(err^2 + sigma^2)) over the believed points [m].
  /// Reference: [Rabinovich18] Eq. (2.64), with 1/N.
  std::optional<double> perf;
  std::optional<double> rmse;          ///< sqrt(mean err^2) of the believed points [m]
  std::optional<double> sigma;         ///< sqrt(mean sigma^2) of the believed points [m]
  std::optional<double> boundary_rms;  ///< symmetric distance of the boundaries, RMS [m]
  std::optional<double>
      boundary_hausdorff;              ///< the largest distance, in both directions [m]
  std::optional<double> iou;           ///< intersection over union of the areas, 0..1
  std::optional<double> coverage_95;   ///< share of points with |err| <= 1.96 sigma
  std::optional<double> nees;          ///< mean(err^2 / sigma^2); 1 when consistent
  std::optional<double> crps;          ///< continuous ranked probability score [m]
  std::optional<double> latency_mean;  ///< age of what is known, mean over points [s]
  std::optional<double> latency_max;   ///< the same, of the oldest point [s]
  std::optional<double> truth_area;    ///< [m^2]
  std::optional<double> area_error;    ///< believed minus true area [m^2]
};

/// One number of PerimeterMetrics with its name in tables, plots and summaries.
struct MetricField {
  std::string_view name;  ///< without the unit: "perf"
  std::string_view unit;  ///< "_m", "_s", "_m2" or ""
  std::optional<double> PerimeterMetrics::*value;
};

/// All of them, in the order of the metrics table.
std::span<const MetricField> metric_fields();

/// The true boundary of one time, prepared for comparisons. Keeps a copy.
class TrueBoundary {
 public:
  explicit TrueBoundary(geo::Region region);

  const geo::Region& region() const { return region_; }
  const geo::BoundaryIndex& index() const { return index_; }
  /// Points along the boundary, equally spaced per ring: see boundary_samples().
  std::span<const Vec2> samples() const { return samples_; }

 private:
  geo::Region region_;
  geo::BoundaryIndex index_;
  geo::Ring samples_;
};

/// Points along all rings, at most 25 m apart and at least about 200 in all, equal arc
/// length within a ring. Rings of fewer than three points have no boundary.
geo::Ring boundary_samples(const geo::Region& region);

/// Compares a belief with the truth of the same time. `err` of a point is its signed
/// distance to the true boundary; all believed points count the same. The latencies are
/// left to ReadingAges.
/// Cost: about linear in the points of both; see bench/record_bench.cpp.
/// Reference: docs/records.md has every formula.
PerimeterMetrics perimeter_metrics(const TrueBoundary& truth,
                                   const BoundaryEstimate& belief);

/// The same for one comparison only.
PerimeterMetrics perimeter_metrics(const geo::Region& truth,
                                   const BoundaryEstimate& belief);

}  // namespace skein::record
