// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/strategy/tracking.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "skein/layer/reasoning/perimeter/strategy/time_to_go.h"

namespace skein::perimeter {

std::vector<std::size_t> even_starts(const BoundaryLine& line,
                                     std::span<const AircraftStatus> aircraft) {
  // Places offset + k L / n; aircraft take them in their order around the line; the
  // offset is the circular mean of what each aircraft would choose.
  const std::size_t n = aircraft.size();
  std::vector<double> own(n);
  for (std::size_t k = 0; k < n; ++k)
    own[k] = line.arc(line.nearest(geo::horizontal(aircraft[k].nav.p_N)));
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return own[a] < own[b]; });
  const double share = line.length() / static_cast<double>(n);
  Vec2 mean = Vec2::Zero();
  for (std::size_t k = 0; k < n; ++k)
    mean += geo::unit(2 * geo::kPi * (own[order[k]] - static_cast<double>(k) * share) /
                      line.length());
  const double offset =
      geo::wrap_2pi(geo::bearing(mean)) / (2 * geo::kPi) * line.length();
  std::vector<std::size_t> starts(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double place =
        std::fmod(offset + static_cast<double>(k) * share, line.length());
    std::size_t best = 0;
    for (std::size_t i = 0; i < line.size(); ++i)
      if (std::abs(line.arc(i) - place) < std::abs(line.arc(best) - place)) best = i;
    starts[order[k]] = best;
  }
  return starts;
}

TrackingStrategy::TrackingStrategy(const TrackingOptions& options) : options_(options) {}

namespace {

// The line from `start` on along the believed boundary.
FollowLine line_ahead(const BoundaryLine& line, std::size_t start, bool forward,
                      double length) {
  FollowLine order;
  double gone = 0;
  std::size_t i = start;
  do {
    order.points.push_back(line[i].position);
    gone += line.spacing(forward ? i : line.next(i, false));
    i = line.next(i, forward);
  } while (gone < length && i != start);
  return order;
}

}  // namespace

std::vector<Assignment> TrackingStrategy::assign(const MonitoringSituation& situation) {
  std::vector<Assignment> assignments;
  const BoundaryLine line(*situation.boundary);
  if (line.empty()) return assignments;
  std::erase_if(given_, [&](const auto& entry) {
    return std::none_of(situation.aircraft.begin(), situation.aircraft.end(),
                        [&](const AircraftStatus& a) { return a.id == entry.first; });
  });
  std::vector<std::size_t> starts;  // computed when the first new aircraft needs it
  for (std::size_t k = 0; k < situation.aircraft.size(); ++k) {
    const AircraftStatus& aircraft = situation.aircraft[k];
    const auto given = given_.find(aircraft.id);
    const bool fresh = given == given_.end();
    if (!fresh && !options_.predicted)
      continue;  // follows the real edge until a new order
    if (!fresh && !aircraft.task_done &&
        (situation.now - given->second).seconds() < options_.renew_period)
      continue;
    if (fresh && starts.empty()) starts = even_starts(line, situation.aircraft);
    given_[aircraft.id] = situation.now;
    if (options_.predicted) {
      const std::size_t from =
          fresh ? starts[k] : line.nearest(geo::horizontal(aircraft.nav.p_N));
      assignments.push_back(
          {aircraft.id, line_ahead(line, from, options_.clockwise, options_.look_ahead)});
    } else {
      const Meeting meeting = meet(aircraft, line[starts[k]]);
      assignments.push_back({aircraft.id,
                             FollowEdge{options_.clockwise, meeting.point.position,
                                        line.tangent(starts[k]), options_.edge_angle},
                             {{"time_to_go_s", meeting.t_go}}});
    }
  }
  return assignments;
}

}  // namespace skein::perimeter
