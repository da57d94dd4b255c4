// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace skein::perimeter {

/// How the level-set ensemble works. Lengths in cells follow the grid when it coarsens.
struct EnsembleOptions {
  int members = 40;             ///< size of the ensemble, 8 to 200
  double cell = 10;             ///< finest spacing of the grid [m]
  int max_nodes = 80000;        ///< beyond, the grid's spacing doubles; 10,000 or more
  double step = 20;             ///< longest step of the fronts [s]
  double control_spacing = 50;  ///< longest distance between boundary points [m]
  double min_area = 5000;       ///< smaller parts and holes are not reported [m^2]
  double reach_cells = 30;      ///< an observation changes nothing farther [cells]
  int rate_spacing_cells = 12;  ///< nodes of the local rate [cells], even
  int noise_spacing_cells = 4;  ///< nodes of the boundary's noise [cells]
  double rate_memory = 1200;    ///< in which a local rate is forgotten [s]
  double roughness = 0.25;      ///< of the boundary's noise, against its rate's [-]
  double false_rate = 0.001;    ///< probability of a wrong in/out reading, at first
  double sure = 0.98;           ///< readings expected with more than this are skipped
  double repeat_distance = 60;  ///< within this of the last used reading of the same
  double repeat_time = 20;      ///< aircraft and side, and this [s], it is the same one
  double sigma_floor_cells = 0.3;  ///< of the grid's own error [cells]
  std::uint64_t seed = 1;          ///< of the members
};

}  // namespace skein::perimeter
