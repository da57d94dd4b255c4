// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "skein/base/time.h"
#include "skein/geo/vec.h"

namespace skein {

/// Where a node of a radio network is: on straight lines from place to place.
struct NodeTrack {
  struct Point {
    Time time;
    Vec3 place;  ///< [m] in N
  };
  std::vector<Point> points;                 ///< in order of time, at least one
  std::optional<double> transmit_power_dbm;  ///< none: that of its radio

  bool moves() const { return points.size() > 1; }
  /// At rest before the first point and after the last.
  Vec3 place(Time time) const;
};

/// As receiver: all that hear it.
inline constexpr std::uint32_t kAllNodesOfCase = 0xFFFFFFFFu;

/// A packet that is handed to a radio at a moment.
struct TrafficItem {
  std::uint64_t message = 0;  ///< its number in the table
  Time time;
  std::uint32_t from = 0, to = 0;  ///< places among the nodes; to: or kAllNodesOfCase
  std::uint32_t bytes = 0;
};

/// A node that always has something to send: `depth` packets wait or are in service, and
/// each that leaves, unless it was too long to be sent, is replaced at that instant.
struct SaturatedFlow {
  std::uint32_t from = 0, to = 0;
  std::uint32_t bytes = 0, depth = 1;
  Time start;
};

/// What a radio network does.
struct NetworkCase {
  std::vector<std::uint32_t> names;  ///< of the nodes in the table, rising
  std::vector<NodeTrack> nodes;
  std::vector<TrafficItem> traffic;  ///< in order of time
  std::vector<SaturatedFlow> flows;
  Time duration;
};

}  // namespace skein
