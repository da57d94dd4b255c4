#include "layer/reasoning/monitoring/strategy/sweep.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "layer/reasoning/monitoring/strategy/orders.h"
#include "layer/reasoning/monitoring/strategy/time_to_go.h"

namespace skein::monitoring {

SweepStrategy::SweepStrategy(const SweepOptions& options) : options_(options) {}

namespace {

// Visits the points from `start` on, as far as an aircraft follows the edge in
// `window_m`.
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
                           double t_go, const std::vector<char>& covered) const {
  double sum = 0;
  walk(line, start, clockwise, options_.window * options_.follow_speed,
       [&](std::size_t i, double gone) {
         if (covered[i]) return;
         const double sigma =

             carried_on(line[i], t_go + gone / options_.follow_speed).sigma;
         sum += sigma * line.spacing(i);
       });
  return sum / (t_go + options_.window);
}

void SweepStrategy::cover(const BoundaryLine& line, std::size_t start, bool clockwise,
                          std::vector<char>& covered) const {
  walk(line, start, clockwise, options_.window * options_.follow_speed,
       [&](std::size_t i, double) { covered[i] = 1; });
}

SweepStrategy::Arc SweepStrategy::best_arc(const BoundaryLine& line,
                                           const AircraftStatus& aircraft,
                                           std::span<const Zone> zones,
                                           const std::vector<char>& covered) const {
  constexpr std::size_t kMostStarts = 48;  // starts to look at: enough, and bounded work
  const std::size_t stride = std::max<std::size_t>(1, line.size() / kMostStarts);
  Arc best;
  for (std::size_t i = 0; i < line.size(); i += stride) {
    if (in_zone(zones, line[i].position)) continue;
    const double t_go = meet(aircraft, line[i]).t_go;
    if (!std::isfinite(t_go)) continue;  // the wind keeps it away
    for (const bool clockwise : {true, false}) {
      const double value = gain(line, i, clockwise, t_go, covered);
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
  const auto place_of = [&](const AircraftStatus& aircraft, const Sweep& sweep) {
    return line.nearest(now < sweep.arrived_after ? sweep.start
                                                  : geo::horizontal(aircraft.nav.p_N));
  };
  for (const AircraftStatus& aircraft : situation.aircraft) {
    const auto found = sweeps_.find(aircraft.id);
    const bool fresh = found == sweeps_.end();
    if (!fresh && ((now - found->second.decided).seconds() < options_.decide_period ||
                   (now - found->second.begun).seconds() < options_.commit))
      continue;
    std::vector<char> covered(line.size(), 0);
    for (const AircraftStatus& other : situation.aircraft)
      if (const auto theirs = sweeps_.find(other.id);
          other.id != aircraft.id && theirs != sweeps_.end())
        cover(line, place_of(other, theirs->second), theirs->second.clockwise, covered);
    const Arc best = best_arc(line, aircraft, situation.zones, covered);
    if (!fresh) {
      Sweep& sweep = found->second;
      sweep.decided = now;
      const double stay =
          gain(line, place_of(aircraft, sweep), sweep.clockwise, 0, covered);
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
