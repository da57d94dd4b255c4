// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/model/well_clear/configuration.h"
#include "skein/model/well_clear/manoeuvre.h"

namespace skein::model {

/// A range of values and what they lead to.
struct BandPiece {
  double lo = 0, hi = 0;  ///< [rad, m/s or m]
  AlertRegion region = AlertRegion::kNone;

  bool operator==(const BandPiece&) const = default;
};

/// How well clear is regained when all values lead into conflict.
struct BandRecovery {
  enum class Outcome {
    kNotNeeded,  ///< some values are without conflict
    kFound,      ///< pieces of kRecovery regain it
    kNoneFound,  ///< none keeps more than the distances of a near mid-air collision
    kNotKept     ///< none even keeps these
  };
  Outcome outcome = Outcome::kNotNeeded;
  double time = 0;                      ///< until well clear again [s]; if found
  double horizontal = 0, vertical = 0;  ///< distances kept meanwhile [m]; if found
  int shrunk = 0;                       ///< how often they were, before
};

/// The bands of one kind of manoeuvre.
struct ManoeuvreBands {
  ManoeuvreKind kind = ManoeuvreKind::kTrack;
  /// The whole range, ascending, neighbours of different regions. Track: [0, 2 pi],
  /// clockwise from north. Speed over ground, vertical speed up, altitude above mean sea
  /// level.
  std::vector<BandPiece> pieces;
  BandRecovery recovery;
  double own = 0;  ///< the own value

  /// What a value leads to; where pieces meet, to the better of both. Values out of range
  /// count as its ends, tracks of whole turns more or less as the same.
  AlertRegion region(double value) const;
};

/// Whether a region asks to be left: the corrective one and those that are worse.
inline bool is_corrective(AlertRegion region, AlertRegion corrective) {
  return region >= corrective && region != AlertRegion::kRecovery;
}

/// The nearest values that need not be left, from the own value on.
struct ManoeuvreResolution {
  bool needed = false;             ///< the own value is to be left
  std::optional<double> up, down;  ///< to the right, faster, up; the other way
  bool prefer_up = false;          ///< it is there and no further off than the other
};

/// The resolution of one kind of manoeuvre; tracks within half a turn each way, not
/// wrapped, so that `up` is above the own value and `down` below.
ManoeuvreResolution resolution(const ManoeuvreBands& bands, AlertRegion corrective);

}  // namespace skein::model
