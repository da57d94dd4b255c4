// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/strategy/partition.h"

#include <algorithm>
#include <cmath>

#include "skein/layer/reasoning/perimeter/strategy/time_to_go.h"
#include "skein/layer/reasoning/perimeter/strategy/tracking.h"

namespace skein::perimeter {

PartitionStrategy::PartitionStrategy(const GusOptions& options)
    : options_(options), orders_(options.patience) {}

std::vector<Assignment> PartitionStrategy::assign(const MonitoringSituation& situation) {
  orders_.keep_only(situation.aircraft);
  std::vector<Assignment> assignments;
  const BoundaryLine line(*situation.boundary);
  if (line.empty() || situation.aircraft.empty()) return assignments;
  const std::vector<std::size_t> centres = even_starts(line, situation.aircraft);
  const double half =
      line.length() / (2 * static_cast<double>(situation.aircraft.size()));
  for (std::size_t k = 0; k < situation.aircraft.size(); ++k) {
    const AircraftStatus& aircraft = situation.aircraft[k];
    if (!orders_.open(aircraft, situation.now)) continue;
    std::optional<Meeting> best;
    double best_value = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const double away =
          std::remainder(line.arc(i) - line.arc(centres[k]), line.length());
      if (std::abs(away) > half) continue;
      const Meeting meeting = meet(aircraft, line[i]);
      if (!std::isfinite(meeting.t_go) ||
          in_zone(situation.zones, meeting.point.position))
        continue;
      const double value = target_value(meeting, options_.settle_time);
      if (!best || value > best_value) {
        best = meeting;
        best_value = value;
      }
    }
    if (!best) continue;
    orders_.give(aircraft.id, best->point.position, situation.now);
    assignments.push_back({aircraft.id, order_across(aircraft, *best, options_),
                           reasons(*best, options_.settle_time)});
  }
  return assignments;
}

}  // namespace skein::perimeter
