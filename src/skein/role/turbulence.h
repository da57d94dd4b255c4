// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/base/time.h"
#include "skein/data/vehicle/air.h"
#include "skein/data/vehicle/vehicle.h"

namespace skein {

/// Where a vehicle meets the gusts.
struct TurbulenceView {
  Time now;
  const VehicleState& vehicle;
  double height_agl = 0;       ///< [m]
  Vec3 wind_N = Vec3::Zero();  ///< mean wind there [m/s]
};

/// The gusts that one vehicle meets on its path: its own, so that vehicles move in
/// parallel.
class Turbulence {
 public:
  virtual ~Turbulence() = default;

  /// The gust felt from `view.now` on for `dt` [s].
  virtual Gust advance(const TurbulenceView& view, double dt) = 0;
};

}  // namespace skein
