// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "skein/data/vehicle/path.h"
#include "skein/model/path/pose.h"

namespace skein::model {

/// The six shapes of a shortest path of bounded curvature: left turn, right turn,
/// straight.
enum class DubinsWord { kLSL, kLSR, kRSL, kRSR, kLRL, kRLR };

/// Turns of the three parts of a word: +1 right, -1 left, 0 straight.
std::array<int, 3> sides_of(DubinsWord word);

/// "LSL", ...
std::string_view name_of(DubinsWord word);

/// One path of turns and straights between two poses.
struct DubinsPath {
  DubinsWord word = DubinsWord::kLSL;
  /// The three parts in turn radii: turned angles [rad] and the straight's length.
  std::array<double, 3> parts{};
  double radius = 1;  ///< of the turns [m]

  double length() const { return radius * (parts[0] + parts[1] + parts[2]); }  ///< [m]
};

/// The shortest path between two poses with turns no tighter than `radius`.
///
/// Equal poses give length 0. A turn within 1e-11 rad of a full one counts as none, so
/// that rounding never adds a loop.
/// Cost:      no allocation, about five angle functions; figures in docs/connection.md.
/// Reference: [Dubins57]; docs/connection.md.
DubinsPath dubins(const Pose& from, const Pose& to, double radius);

/// The elements of `dubins`, flown from `from`; parts without length are left out.
Path to_path(const DubinsPath& dubins, const Pose& from);

}  // namespace skein::model
