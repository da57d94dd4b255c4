// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/layer/communication/propagation/obstacle.h"

namespace skein::communication {

/// How signals get weaker on their way: what the models need.
struct PropagationProfile {
  double received_power_dbm = -60;  ///< of FixedPower: whatever is sent
  // Of LogDistance.
  double exponent = 3;
  double reference_distance = 1;    ///< free space up to there [m]
  double shadowing_db = 0;          ///< standard deviation
  double shadowing_distance = 100;  ///< over which it is correlated [m]
  double antenna_height = 1;        ///< of TwoRay: above the place of a node [m]
  std::vector<Obstacle> obstacles;  ///< of all models
};

}  // namespace skein::communication
