// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/strategy/gus.h"

#include <algorithm>
#include <cmath>

#include "skein/layer/reasoning/perimeter/strategy/time_to_go.h"

namespace skein::perimeter {

double target_value(const Meeting& meeting, std::optional<double> settle_time) {
  const double j = meeting.point.sigma;  // sigma + sigma' t_go
  return settle_time ? j / (meeting.t_go + *settle_time) : j;
}

std::vector<NamedValue> reasons(const Meeting& meeting,
                                std::optional<double> settle_time) {
  std::vector<NamedValue> all{{"uncertainty_on_arrival_m", meeting.point.sigma},
                              {"time_to_go_s", meeting.t_go}};
  if (settle_time)
    all.push_back({"uncertainty_per_second_m_s", target_value(meeting, settle_time)});
  return all;
}

FlyTo order_across(const AircraftStatus& aircraft, const Meeting& meeting,
                   const GusOptions& options) {
  const double reach =
      std::max(options.aim_sigmas * meeting.point.sigma, options.min_reach);
  return FlyTo{crossing_aim(meeting.point, geo::horizontal(aircraft.nav.p_N), reach)};
}

GusStrategy::GusStrategy(const GusOptions& options, bool per_second)
    : options_(options), per_second_(per_second), orders_(options.patience) {}

std::optional<Meeting> GusStrategy::choose(const BoundaryLine& line,
                                           const AircraftStatus& aircraft,
                                           std::span<const Zone> zones) const {
  std::optional<Meeting> best;
  double best_value = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (orders_.taken(aircraft.id, line[i].position, options_.separation)) continue;
    const Meeting meeting = meet(aircraft, line[i]);
    if (!std::isfinite(meeting.t_go)) continue;  // out of reach
    const double value = target_value(
        meeting, per_second_ ? std::optional(options_.settle_time) : std::nullopt);
    if ((!best || value > best_value) && !in_zone(zones, meeting.point.position)) {
      best = meeting;
      best_value = value;
    }
  }
  return best;
}

std::vector<Assignment> GusStrategy::assign(const MonitoringSituation& situation) {
  orders_.keep_only(situation.aircraft);
  std::vector<Assignment> assignments;
  const BoundaryLine line(*situation.boundary);
  for (const AircraftStatus& aircraft : situation.aircraft) {
    if (!orders_.open(aircraft, situation.now)) continue;
    const auto target = choose(line, aircraft, situation.zones);
    if (!target) continue;  // every place is taken or forbidden: keeps its last order
    orders_.give(aircraft.id, target->point.position, situation.now);
    assignments.push_back(
        {aircraft.id, order_across(aircraft, *target, options_),
         reasons(*target,
                 per_second_ ? std::optional(options_.settle_time) : std::nullopt)});
  }
  return assignments;
}

}  // namespace skein::perimeter
