#include "layer/reasoning/monitoring/strategy/gus.h"

#include <algorithm>
#include <cmath>

#include "layer/reasoning/monitoring/strategy/time_to_go.h"

namespace skein::monitoring {

double expected_sigma(const BoundaryPoint& point, double t_go) {
  return point.sigma + point.sigma_growth * t_go;
}

GusStrategy::GusStrategy(const GusOptions& options, bool per_second)
    : options_(options), per_second_(per_second), orders_(options.patience) {}

std::optional<std::size_t> GusStrategy::choose(const BoundaryLine& line,
                                               const AircraftStatus& aircraft,
                                               std::span<const Zone> zones) const {
  std::optional<std::size_t> best;
  double best_value = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2& place = line[i].position;
    if (orders_.taken(aircraft.id, place, options_.separation)) continue;
    const Vec2 aim = crossing_aim(line[i], geo::horizontal(aircraft.nav.p_N),
                                  options_.aim_sigmas * line[i].sigma);
    const double t_go = time_to_go(aircraft, aim);
    if (!std::isfinite(t_go)) continue;  // the wind keeps it away
    const double j = expected_sigma(line[i], t_go);
    const double value = per_second_ ? j * j / (t_go + options_.settle_time) : j;
    if ((!best || value > best_value) && !in_zone(zones, place)) {
      best = i;
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
    const BoundaryPoint& point = line[*target];
    const double reach =
        std::max(options_.aim_sigmas * point.sigma, options_.least_reach);
    orders_.give(aircraft.id, point.position, situation.now);
    assignments.push_back(
        {aircraft.id,
         FlyTo{crossing_aim(point, geo::horizontal(aircraft.nav.p_N), reach)}});
  }
  return assignments;
}

}  // namespace skein::monitoring
