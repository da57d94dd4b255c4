// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/geo/vec.h"

namespace skein::communication {

/// In which directions an antenna sends and receives, in the frame of the body that
/// carries it: what the models need. Azimuths run from forward to the right, elevations
/// from the horizon of the body up [rad]. Gains come on top of those of PhyProfile.
struct AntennaProfile {
  // Of VerticalDipole.
  double min_gain_db = -30;  ///< along its rod
  // Of BodyShadow: airframe and motor as the antenna sees them.
  double shadow_azimuth = geo::kPi;
  double shadow_elevation = 0;
  double shadow_half_width = geo::radians(35);  ///< to the middle of its edge
  double shadow_edge = geo::radians(20);        ///< from no loss to all of it
  double shadow_depth_db = 20;
  // Of GainTable: a row of gains for each elevation, in it one for each azimuth.
  std::vector<double> azimuths;    ///< growing, in [0, 2 pi)
  std::vector<double> elevations;  ///< growing, in [-pi/2, pi/2]
  std::vector<std::vector<double>> gains_db;
};

}  // namespace skein::communication
