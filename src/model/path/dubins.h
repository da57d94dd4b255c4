#pragma once

#include <array>

#include "data/path.h"
#include "model/path/pose.h"

namespace skein::model {

/// The six shapes of a shortest path of bounded curvature: left turn, right turn,
/// straight.
enum class DubinsWord { kLSL, kLSR, kRSL, kRSR, kLRL, kRLR };

inline constexpr std::array kDubinsWords = {DubinsWord::kLSL, DubinsWord::kLSR,
                                            DubinsWord::kRSL, DubinsWord::kRSR,
                                            DubinsWord::kLRL, DubinsWord::kRLR};

/// One path of turns and straights between two poses.
struct DubinsPath {
  DubinsWord word = DubinsWord::kLSL;
  /// The three parts in turn radii: turned angles [rad] and the straight's length.
  std::array<double, 3> parts{};
  double radius = 1;  ///< of the turns [m]

  double length() const { return radius * (parts[0] + parts[1] + parts[2]); }  ///< [m]
};

/// The path of one word; infinitely long when that word does not reach.
///
/// Of the two middle arcs of LRL and RLR the one over pi is taken, which is the one a
/// shortest path can have.
///
/// @param radius  of the turns [m], above 0.
DubinsPath dubins_word(DubinsWord word, const Pose& from, const Pose& to, double radius);

/// The shortest path between two poses with turns no tighter than `radius`.
///
/// Equal poses give length 0. A turn within 1e-9 rad of a full one counts as none, so
/// that rounding never adds a loop. Cost:      no allocation, about ten angle functions.
/// Reference: [Dubins57]; closed forms as derived in docs/aircraft.md.
DubinsPath dubins(const Pose& from, const Pose& to, double radius);

/// The elements of `dubins`, flown from `from`; parts without length are left out.
Path to_path(const DubinsPath& dubins, const Pose& from);

}  // namespace skein::model
