// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/layer/environment/recorded/perimeter.h"

namespace skein::environment {

/// What to do with a perimeter that those after it contradict.
enum class Outliers {
  kDrop,    ///< leave it out, with a warning
  kUnite,   ///< keep it: the fire then includes it for good
  kRefuse,  ///< an error
};

struct RepairOptions {
  std::vector<int>
      skip;  ///< numbers of perimeters to leave out, in order of time, from 0
  Outliers outliers = Outliers::kDrop;
  double outlier_share =
      0.25;             ///< of a perimeter's area that may be missing from the next
  double min_part = 1;  ///< parts and holes below this area are left out [m^2]
};

/// Projects a raw perimeter from degrees into the local plane.
/// Fails: kBadInput when a point is more than 500 km from the origin.
Result<RawPerimeter> projected(const RawPerimeter& degrees, const geo::LocalFrame& frame);

/// The area that a raw perimeter in the local plane encloses, as a clean region.
///
/// Rings that cross themselves enclose what they wind around at all; overlapping polygons
/// are united, holes cut out of their own polygon. Lines whose ends meet within 1 m are
/// joined, then closed by a straight piece; nested closed lines alternate between fire
/// and island. Parts without area are left out. Each repair adds a line to `warnings`.
geo::Region repaired(const RawPerimeter& raw, const RepairOptions& options,
                     std::vector<std::string>& warnings);

/// A growing series of regions from raw perimeters in the local plane: sorted by time,
/// those of one time united, empty ones and outliers left out, each united with all
/// before it.
///
/// A perimeter is an outlier when more than `outlier_share` of its area is missing from
/// the next one, and two witnesses agree against it: for an earlier one, the next two;
/// for a later one, its neighbours on both sides. A contradiction without a second
/// witness, and any smaller loss, is settled by uniting.
///
/// The first perimeter's time becomes 0 (its old time is added to `first_time`).
/// Fails: kBadInput when nothing burns in any, `skip` names what is not there, or an
///        outlier is to be refused.
Result<std::vector<Perimeter>> growing_series(std::vector<RawPerimeter> raw,
                                              const RepairOptions& options,
                                              const std::string& place,
                                              double& first_time,
                                              std::vector<std::string>& warnings);

}  // namespace skein::environment
