// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>

#include "skein/data/perimeter/fire.h"

namespace skein::perimeter {

/// Learns from past forecasts how wide the next ones must be, by what was believed when
/// their time had come; no truth is needed.
///
/// spread() multiplies stated deviations: the root mean square of distances from the
/// forecast to the later boundary, over the deviations, with fading memory and one
/// imagined forecast that was right; never below 1.
/// Reference: after [Gneiting05], who calibrate forecasts by regression on past ones.
class ForecastCalibration {
 public:
  /// A forecast for the time of `check`, with a spread of 1.
  void keep(BoundaryEstimate check) { check_ = std::move(check); }

  /// What is believed now. Judges the forecast that was kept, when its time has come.
  void compare(const BoundaryEstimate& now);

  double spread() const;

 private:
  std::optional<BoundaryEstimate> check_;
  double squares_ = 1, weight_ = 1;  // of distances over deviations, fading
};

}  // namespace skein::perimeter
