// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/strategy/ellipse.h"

#include <algorithm>

#include "skein/layer/reasoning/perimeter/strategy/time_to_go.h"

namespace skein::perimeter {
namespace {

// Where only the uncertainty along the normal is known, that is the axis.
Vec2 major_axis(const BoundaryPoint& point) {
  return point.major_axis.squaredNorm() > 0 ? point.major_axis
                                            : point.sigma * point.normal;
}

// The tip on the far side, so that reaching it crosses the believed place.
Vec2 tip(const BoundaryPoint& point, const Vec2& from) {
  const Vec2 axis = major_axis(point);
  return (from - point.position).dot(axis) > 0 ? Vec2(point.position - axis)
                                               : Vec2(point.position + axis);
}

}  // namespace

EllipseStrategy::EllipseStrategy(const EllipseOptions& options)
    : options_(options), orders_(options.patience) {}

std::vector<Assignment> EllipseStrategy::assign(const MonitoringSituation& situation) {
  orders_.keep_only(situation.aircraft);
  std::vector<Assignment> assignments;
  const BoundaryLine line(*situation.boundary);
  if (line.empty()) return assignments;
  for (const AircraftStatus& aircraft : situation.aircraft) {
    std::optional<std::size_t> longest;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (longest && major_axis(line[i]).norm() <= major_axis(line[*longest]).norm())
        continue;
      if (orders_.taken(aircraft.id, line[i].position, options_.separation)) continue;
      if (!in_zone(situation.zones, line[i].position)) longest = i;
    }
    if (!longest) continue;
    if (!orders_.open(aircraft, situation.now)) {
      const auto place = orders_.place(aircraft.id);
      const double now_m = major_axis(line[line.nearest(*place)]).norm();
      if (major_axis(line[*longest]).norm() <= options_.switch_ratio * now_m) continue;
      if ((line[*longest].position - *place).norm() < options_.separation) continue;
    }
    orders_.give(aircraft.id, line[*longest].position, situation.now);
    const Meeting meeting = meet(aircraft, line[*longest]);
    assignments.push_back({aircraft.id,
                           FlyTo{tip(meeting.point, geo::horizontal(aircraft.nav.p_N))},
                           {{"major_axis_m", major_axis(line[*longest]).norm()},
                            {"time_to_go_s", meeting.t_go}}});
  }
  return assignments;
}

}  // namespace skein::perimeter
