#include "layer/reasoning/monitoring/strategy/sweep.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "layer/reasoning/monitoring/strategy/orders.h"
#include "layer/reasoning/monitoring/strategy/time_to_go.h"

namespace skein::monitoring {

SweepStrategy::SweepStrategy(const SweepOptions& options) : options_(options) {}

namespace {

// Visits the points from `start` on, up to `window_m` along the line.
template <class Visit>
void walk(const BoundaryLine& line, std::size_t start, bool clockwise, double window_m,
          const Visit& visit) {
  double gone = 0;
  std::size_t i = start;
  do {
    visit(i, gone);
    gone += line.spacing(clockwise ? i : line.next(i, false));
    i = line.next(i, clockwise);
  } while (gone < window_m && i != start);
}

}  // namespace

double SweepStrategy::gain(const BoundaryLine& line, std::size_t start, bool clockwise,
                           double t_go, const Shares& shares) const {
  double sum = 0;
  walk(line, start, clockwise, shares.window_m, [&](std::size_t i, double gone) {
    const double sigma = carried_on(line[i], t_go + gone / options_.follow_speed).sigma;
    sum += shares.left[i] * sigma * line.spacing(i);
  });
  return sum / (t_go + shares.window_m / options_.follow_speed);
}

SweepStrategy::Shares SweepStrategy::left_by_others(
    const BoundaryLine& line, std::span<const AircraftStatus> aircraft, EntityId own,
    Time now) const {
  Shares shares;
  shares.window_m = std::min(options_.window * options_.follow_speed,
                             line.length() / static_cast<double>(aircraft.size()));
  shares.left.assign(line.size(), 1);
  for (const AircraftStatus& other : aircraft) {
    const auto sweep = sweeps_.find(other.id);
    if (other.id == own || sweep == sweeps_.end()) continue;
    walk(line, place_of(line, other, sweep->second, now), sweep->second.clockwise,
         shares.window_m,
         [&](std::size_t i, double) { shares.left[i] *= options_.seen_again; });
  }
  return shares;
}

std::size_t SweepStrategy::place_of(const BoundaryLine& line,
                                    const AircraftStatus& aircraft, const Sweep& sweep,
                                    Time now) {
  return line.nearest(now < sweep.arrived_after ? sweep.start
                                                : geo::horizontal(aircraft.nav.p_N));
}

SweepStrategy::Arc SweepStrategy::best_arc(const BoundaryLine& line,
                                           const AircraftStatus& aircraft,
                                           std::span<const Zone> zones,
                                           const Shares& shares) const {
  constexpr std::size_t kMostStarts = 48;  // starts to look at: enough, and bounded work
  const std::size_t stride = std::max<std::size_t>(1, line.size() / kMostStarts);
  Arc best;
  for (std::size_t i = 0; i < line.size(); i += stride) {
    if (in_zone(zones, line[i].position)) continue;
    const double t_go = meet(aircraft, line[i]).t_go;
    if (!std::isfinite(t_go)) continue;  // the wind keeps it away
    for (const bool clockwise : {true, false}) {
      const double value = gain(line, i, clockwise, t_go, shares);
      if (value > best.value) best = {i, clockwise, t_go, value};
    }
  }
  return best;
}

std::vector<Assignment> SweepStrategy::assign(const MonitoringSituation& situation) {
  std::vector<Assignment> assignments;
  const BoundaryLine line(*situation.boundary);
  if (line.empty()) return assignments;
  std::erase_if(sweeps_, [&](const auto& entry) {
    return std::none_of(situation.aircraft.begin(), situation.aircraft.end(),
                        [&](const AircraftStatus& a) { return a.id == entry.first; });
  });
  const Time now = situation.now;
  for (const AircraftStatus& aircraft : situation.aircraft) {
    const auto found = sweeps_.find(aircraft.id);
    const bool fresh = found == sweeps_.end();
    if (!fresh && ((now - found->second.decided).seconds() < options_.decide_period ||
                   (now - found->second.begun).seconds() < options_.commit))
      continue;
    const Shares shares = left_by_others(line, situation.aircraft, aircraft.id, now);
    const Arc best = best_arc(line, aircraft, situation.zones, shares);
    if (!fresh) {
      Sweep& sweep = found->second;
      sweep.decided = now;
      const double stay =
          gain(line, place_of(line, aircraft, sweep, now), sweep.clockwise, 0, shares);
      if (best.value <= options_.leave_ratio * stay) continue;
    }
    sweeps_[aircraft.id] = {best.clockwise, now, now, now + Time::from_seconds(best.t_go),
                            line[best.start].position};
    assignments.push_back(
        {aircraft.id,
         FollowEdge{best.clockwise, meet(aircraft, line[best.start]).point.position,
                    line.tangent(best.start), options_.edge_angle}});
  }
  return assignments;
}

}  // namespace skein::monitoring
