#pragma once

#include <vector>

#include "skein/layer/communication/propagation/obstacle.h"

namespace skein::communication {

enum class PropagationModel { kFreeSpace, kFixed, kLogDistance, kTwoRay };

/// How signals get weaker on their way.
struct PropagationProfile {
  PropagationModel model = PropagationModel::kFreeSpace;
  double received_power_dbm = -60;  ///< of kFixed: whatever is sent
  // Of kLogDistance.
  double exponent = 3;
  double reference_distance = 1;    ///< free space up to there [m]
  double shadowing_db = 0;          ///< standard deviation
  double shadowing_distance = 100;  ///< over which it is correlated [m]
  double antenna_height = 1;        ///< of kTwoRay: above the place of a node [m]
  std::vector<Obstacle> obstacles;  ///< of all models
};

}  // namespace skein::communication
