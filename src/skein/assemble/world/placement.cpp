// SPDX-License-Identifier: Apache-2.0
#include "skein/assemble/world/placement.h"

#include "skein/geo/vec.h"

namespace skein::assemble {

Place place_at_start(const scenario::Start& start, int index, int count) {
  using scenario::Placement;
  Place place;
  switch (start.placement) {
    case Placement::kOpposite:
    case Placement::kRing: {
      const double bearing = start.first_bearing + 2 * geo::kPi * index / count;
      place.position = start.centre + start.distance * geo::unit(bearing);
      place.heading =
          bearing + (start.placement == Placement::kRing ? geo::kPi / 2 : geo::kPi);
      break;
    }
    case Placement::kLine: {
      const double heading = start.heading.value_or(0);
      const double across = (index - (count - 1) / 2.0) * start.spacing;
      place.position = start.centre + across * geo::turned_right(geo::unit(heading));
      place.heading = heading;
      break;
    }
    case Placement::kList:
      place.position = start.positions[static_cast<std::size_t>(index)];
      place.heading = geo::bearing(start.centre - place.position);
      break;
  }
  if (start.heading) place.heading = *start.heading;
  place.heading = geo::wrap_pi(place.heading);
  return place;
}

}  // namespace skein::assemble
