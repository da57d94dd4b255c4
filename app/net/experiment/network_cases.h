// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "skein/data/radio/network_case.h"

namespace skein::experiment {

/// What the nodes of a grid send.
struct GridTraffic {
  double spacing = 100;  ///< of the grid [m]
  double rate = 5;       ///< messages of each node [1/s]
  std::uint32_t bytes = 1000;
};

/// Nodes on a grid that send to their neighbours.
///
/// Row by row in ceil(sqrt(nodes)) columns. Message k of a node is created at
/// (k + u) / rate, u uniform in [0, 1), for one of those of its four neighbours that are
/// there, each equally likely. Messages of a node depend on the seed, the node and its
/// neighbours; a longer case begins with a shorter one.
///
/// @param nodes  at least 2
/// Reference: [Selecky18] 6.4.3.
NetworkCase grid_network(std::uint32_t nodes, Time duration, std::uint64_t seed,
                         const GridTraffic& traffic = {});

/// Stations at one place that always have something to send: 1000 bytes to the next one,
/// five messages wait or are in service. They begin within 10 ms, by the seed.
/// @param stations  at least 2
NetworkCase cell_network(std::uint32_t stations, Time duration, std::uint64_t seed);

/// Three nodes in a row, 100 m apart, the outer two of which always have something to
/// send to the middle one: as in cell_network().
NetworkCase hidden_network(Time duration, std::uint64_t seed);

}  // namespace skein::experiment
