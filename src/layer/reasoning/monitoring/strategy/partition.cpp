#include "layer/reasoning/monitoring/strategy/partition.h"

#include <algorithm>
#include <cmath>

#include "layer/reasoning/monitoring/strategy/time_to_go.h"
#include "layer/reasoning/monitoring/strategy/tracking.h"

namespace skein::monitoring {

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
    const Vec2 from = geo::horizontal(aircraft.nav.p_N);
    std::optional<std::size_t> best;
    double best_value = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const double away =
          std::remainder(line.arc(i) - line.arc(centres[k]), line.length());
      if (std::abs(away) > half || in_zone(situation.zones, line[i].position)) continue;
      const double t_go = time_to_go(
          aircraft, crossing_aim(line[i], from, options_.aim_sigmas * line[i].sigma));
      if (!std::isfinite(t_go)) continue;  // the wind keeps it away
      const double j = expected_sigma(line[i], t_go);
      const double value = j * j / (t_go + options_.settle_time);
      if (!best || value > best_value) {
        best = i;
        best_value = value;
      }
    }
    if (!best) continue;
    const double reach =
        std::max(options_.aim_sigmas * line[*best].sigma, options_.least_reach);
    orders_.give(aircraft.id, line[*best].position, situation.now);
    assignments.push_back({aircraft.id, FlyTo{crossing_aim(line[*best], from, reach)}});
  }
  return assignments;
}

}  // namespace skein::monitoring
