// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace skein::perimeter {

/// What a reading says about one number z: how likely the reading is when z lies below
/// `low`, between `low` and `high`, or above `high`. A half-space has low == high.
struct StepLikelihood {
  double low = 0;
  double high = 0;
  double below = 0;
  double between = 0;
  double above = 0;
};

/// Moments of a normal z after a reading.
struct StepMoments {
  double evidence = 0;  ///< probability of the reading before it was made
  double mean = 0;
  double variance = 0;
};

/// Exact first and second moments of z ~ N(mean, variance), seen through additive noise
/// of the same kind (already in `variance`), after a reading.
///
///   evidence = sum over the three zones of likelihood x P(zone)
///
/// An all but impossible reading (evidence 0 in doubles) leaves the nearest edge of the
/// most likely zone.
/// Reference: spec of the truncated normal, [Rabinovich18] Eq. (2.25)-(2.27) corrected.
StepMoments condition(double mean, double variance, const StepLikelihood& reading);

}  // namespace skein::perimeter
