#pragma once

#include <map>
#include <optional>
#include <vector>

#include "data/fire.h"
#include "geo/polygon.h"

namespace skein::record {

/// How long ago each part of the boundary was last crossed by an aircraft.
///
/// Every crossing leaves a marker. Markers are carried along with the true boundary
/// (each is moved to its nearest point whenever the ages are asked for), because the
/// place of an old crossing has long burnt: what stays is the part of the front it told
/// about. The age of a believed point is that of the newest marker within 100 m of its
/// nearest true boundary point; never crossed parts count from the start of the run.
class ReadingAges {
 public:
  /// Takes one reading; returns the crossing when it differs from the aircraft's last.
  std::optional<Crossing> add(const FireReading& reading);

  struct Ages {
    double mean = 0;  ///< over the believed points [s]
    double max = 0;   ///< [s]
  };

  /// The ages at `now`; absent when the truth or the belief has no boundary.
  /// Cost: believed points times markers, of which there are at most one per 20 m.
  std::optional<Ages> ages(Time now, const geo::BoundaryIndex& truth,
                           const BoundaryEstimate& belief);

 private:
  struct Marker {
    Time time;
    Vec2 point;
  };

  std::map<EntityId, FireReading> last_;
  std::vector<Marker> markers_;  // oldest first
};

}  // namespace skein::record
