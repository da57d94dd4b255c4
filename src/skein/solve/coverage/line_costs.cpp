// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/line_costs.h"

#include <cmath>
#include <limits>

#include "skein/base/check.h"
#include "skein/model/path/wind_triangle.h"

namespace skein::solve {

LineCosts::LineCosts(std::vector<SweepLine> lines, const model::AirMotion& air,
                     std::vector<RouteEnds> ends, DetourTime detour, Stop stop)
    : lines_(std::move(lines)),
      air_(air),
      ends_(std::move(ends)),
      detour_(std::move(detour)),
      stop_(std::move(stop)),
      fastest_(air.airspeed + air.wind.norm()) {
  const auto visits = static_cast<std::size_t>(2 * lines_.size());
  for (const SweepLine& line : lines_)
    for (const bool back : {false, true}) {
      const Vec2 from = back ? line.b : line.a, to = back ? line.a : line.b;
      const Vec2 leg = to - from;
      const double course = geo::bearing(leg), length = leg.norm();
      const auto heading = model::heading_for_course(course, air.airspeed, air.wind);
      SKEIN_CHECK(heading.has_value(), air.airspeed, air.wind.norm());
      const double speed = (air.airspeed * geo::unit(*heading) + air.wind).norm();
      along_.push_back(length / speed);
      entries_.push_back({from, *heading});
      exits_.push_back({to, *heading});
    }
  for (const RouteEnds& e : ends_)
    for (const auto& pose : {e.start, e.end}) {
      along_.push_back(0);
      entries_.push_back(pose.value_or(model::Pose{}));
      exits_.push_back(pose.value_or(model::Pose{}));
    }
  memo_.assign((visits + ends_.size()) * (visits + ends_.size()),
               std::numeric_limits<double>::quiet_NaN());
}

bool LineCosts::open(int node) const {
  const int k = node - 2 * lines();
  if (k < 0) return false;
  const RouteEnds& e = ends(k / 2);
  return k % 2 == 0 ? !e.start : !e.end;
}

double LineCosts::cost(int from, int to) {
  if (open(from) || open(to)) return along(to);
  // Rows: visits, then starts. Columns: visits, then ends.
  const auto place = [&](int node) {
    const int past = node - 2 * lines();
    return static_cast<std::size_t>(past < 0 ? node : 2 * lines() + past / 2);
  };
  double& memo =
      memo_[place(from) * (static_cast<std::size_t>(2 * lines()) + ends_.size()) +
            place(to)];
  if (std::isnan(memo)) {
    const model::Connection c = model::connect(exit(from), entry(to), air_);
    memo = c.time + along(to);
    if (detour_) memo += detour_(exit(from), entry(to), c);
  }
  return memo;
}

double LineCosts::min_cost(int from, int to) const {
  if (open(from) || open(to)) return along(to);
  return (exit(from).position - entry(to).position).norm() / fastest_ + along(to);
}

model::Pose LineCosts::entry(int node) const {
  return entries_[static_cast<std::size_t>(node)];
}

model::Pose LineCosts::exit(int node) const {
  return exits_[static_cast<std::size_t>(node)];
}

}  // namespace skein::solve
