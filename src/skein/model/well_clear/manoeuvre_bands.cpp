// SPDX-License-Identifier: Apache-2.0
#include "skein/model/well_clear/manoeuvre_bands.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "skein/base/check.h"

namespace skein::model {
namespace {

constexpr double kWholeTurn = 2 * std::numbers::pi;
constexpr double kHalfTurn = std::numbers::pi - 1e-6;  // turning back is to neither side

// The lower or upper end nearest to `own`, beyond it, of pieces that need not be left.
std::optional<double> nearest(const ManoeuvreBands& bands, AlertRegion corrective,
                              bool up) {
  const bool track = bands.kind == ManoeuvreKind::kTrack;
  std::optional<double> found;
  for (const double shift : {-kWholeTurn, 0.0, kWholeTurn}) {
    if (!track && shift != 0) continue;
    for (const BandPiece& piece : bands.pieces) {
      if (is_corrective(piece.region, corrective)) continue;
      const double end = (up ? piece.lo : piece.hi) + shift;
      const double off = up ? end - bands.own : bands.own - end;
      if (off < 0 || (track && off > kHalfTurn)) continue;
      if (!found || off < std::abs(*found - bands.own)) found = end;
    }
  }
  return found;
}

}  // namespace

AlertRegion ManoeuvreBands::region(double value) const {
  SKEIN_CHECK(!pieces.empty(), "bands without pieces");
  const double v = kind == ManoeuvreKind::kTrack
                       ? value - kWholeTurn * std::floor(value / kWholeTurn)
                       : std::clamp(value, pieces.front().lo, pieces.back().hi);
  std::size_t i = 0;
  while (i + 1 < pieces.size() && v > pieces[i].hi) ++i;
  const AlertRegion here = pieces[i].region;
  if (v < pieces[i].hi || i + 1 == pieces.size()) return here;
  // Recovery is better than any region that asks to be left, none better than all.
  const AlertRegion next = pieces[i + 1].region;
  if (here == AlertRegion::kNone || next == AlertRegion::kNone) return AlertRegion::kNone;
  if (here == AlertRegion::kRecovery || next == AlertRegion::kRecovery)
    return AlertRegion::kRecovery;
  return std::min(here, next);
}

ManoeuvreResolution resolution(const ManoeuvreBands& bands, AlertRegion corrective) {
  ManoeuvreResolution result;
  result.needed = is_corrective(bands.region(bands.own), corrective);
  if (!result.needed) return result;
  result.up = nearest(bands, corrective, true);
  result.down = nearest(bands, corrective, false);
  result.prefer_up =
      result.up && (!result.down || *result.up - bands.own <= bands.own - *result.down);
  return result;
}

}  // namespace skein::model
