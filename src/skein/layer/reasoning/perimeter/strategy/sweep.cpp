// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/strategy/sweep.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "skein/base/math.h"
#include "skein/layer/reasoning/perimeter/strategy/orders.h"
#include "skein/layer/reasoning/perimeter/strategy/time_to_go.h"

namespace skein::perimeter {

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
                           double t_go, const Seen& seen) const {
  double sum = 0;
  walk(line, start, clockwise, seen.window_m, [&](std::size_t i, double gone) {
    const double time = t_go + gone / options_.follow_speed;
    const double sigma = line[i].sigma + time * line[i].sigma_growth;
    sum += worth_[static_cast<std::size_t>(seen.by[i])] * sigma * line.spacing(i);
  });
  return sum / (t_go + seen.window_m / options_.follow_speed);
}

// What gain() is at most from a time to go on: as a function of it that is
// (a + b t) / (t + c), which goes from its first value to b, up or down.
double SweepStrategy::max_gain(const BoundaryLine& line, std::size_t start,
                               bool clockwise, double min_t_go, const Seen& seen) const {
  constexpr double kRounding = 1e-9;  // of the sums, by far
  double now = 0, growth = 0;
  walk(line, start, clockwise, seen.window_m, [&](std::size_t i, double gone) {
    const double worth = worth_[static_cast<std::size_t>(seen.by[i])] * line.spacing(i);
    const double sigma_growth = line[i].sigma_growth;
    now += worth * (line[i].sigma + gone / options_.follow_speed * sigma_growth);
    growth += worth * sigma_growth;
  });
  const double time = min_t_go + seen.window_m / options_.follow_speed;
  if (!(time > 0)) return math::kInfinity;
  return std::max((now + growth * min_t_go) / time, growth) +
         kRounding * (std::abs(now) / time + std::abs(growth));
}

void SweepStrategy::count_seen(const BoundaryLine& line, const AircraftStatus& aircraft,
                               Time now, int change, Seen& seen) const {
  const auto sweep = sweeps_.find(aircraft.id);
  if (sweep == sweeps_.end()) return;
  const std::size_t place = place_of(line, aircraft, sweep->second, now);
  seen.at[place] += change;
  walk(line, place, sweep->second.clockwise, seen.window_m,
       [&](std::size_t i, double) { seen.by[i] += change; });
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
                                           const Seen& seen) const {
  // Starts to look at: enough, bounded work, and one for each aircraft if there are so
  // many points.
  const std::size_t starts = std::max<std::size_t>(48, seen.aircraft);
  const std::size_t stride = std::max<std::size_t>(1, line.size() / starts);
  std::vector<Start> unseen, shared;  // where nobody is yet; where somebody is, too
  for (std::size_t i = 0; i < line.size(); i += stride) {
    const double t_go = min_time_to_meet(aircraft, line[i]);
    const double bound = std::max(max_gain(line, i, true, t_go, seen),
                                  max_gain(line, i, false, t_go, seen));
    (seen.at[i] > 0 ? shared : unseen).push_back({i, bound});
  }
  const Arc best = best_arc_from(unseen, line, aircraft, zones, seen);
  return best.value > 0 ? best : best_arc_from(shared, line, aircraft, zones, seen);
}

// The most promising starts first, until no other one can be worth more; of equal ones
// the first along the line.
SweepStrategy::Arc SweepStrategy::best_arc_from(std::vector<Start>& starts,
                                                const BoundaryLine& line,
                                                const AircraftStatus& aircraft,
                                                std::span<const Zone> zones,
                                                const Seen& seen) const {
  std::ranges::sort(starts, std::ranges::greater{}, &Start::bound);
  Arc best;
  for (const auto& [point, bound] : starts) {
    if (bound < best.value) break;
    if (in_zone(zones, line[point].position)) continue;
    const double t_go = meet(aircraft, line[point]).t_go;
    if (!std::isfinite(t_go)) continue;  // the wind keeps it away
    for (const bool clockwise : {true, false}) {
      const double value = gain(line, point, clockwise, t_go, seen);
      if (value > best.value || (value == best.value && point < best.start))
        best = {point, clockwise, t_go, value};
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
  Seen seen;
  seen.aircraft = situation.aircraft.size();
  seen.window_m = std::min(options_.window * options_.follow_speed,
                           line.length() / static_cast<double>(seen.aircraft));
  while (worth_.size() <= seen.aircraft)
    worth_.push_back(math::pow(options_.seen_again, static_cast<double>(worth_.size())));
  seen.by.assign(line.size(), 0);
  seen.at.assign(line.size(), 0);
  for (const AircraftStatus& aircraft : situation.aircraft)
    count_seen(line, aircraft, now, 1, seen);
  for (const AircraftStatus& aircraft : situation.aircraft) {
    const auto found = sweeps_.find(aircraft.id);
    const bool fresh = found == sweeps_.end();
    if (!fresh && ((now - found->second.decided).seconds() < options_.decide_period ||
                   (now - found->second.begun).seconds() < options_.commit))
      continue;
    count_seen(line, aircraft, now, -1, seen);  // by the others
    const Arc best = best_arc(line, aircraft, situation.zones, seen);
    bool leaves = best.value > 0;  // else no place is worth a flight, or allowed
    // Both are uncertainty seen, times length, per second of flight.
    std::vector<NamedValue> why{{"gain_there_m2_s", best.value},
                                {"time_to_go_s", best.t_go}};
    if (!fresh) {
      Sweep& sweep = found->second;
      sweep.decided = now;
      const double stay =
          gain(line, place_of(line, aircraft, sweep, now), sweep.clockwise, 0, seen);
      leaves = best.value > options_.leave_ratio * stay;
      why.push_back({"gain_here_m2_s", stay});
    }
    if (!leaves) {
      count_seen(line, aircraft, now, 1, seen);
      continue;
    }
    sweeps_[aircraft.id] = {best.clockwise, now, now, now + Time::from_seconds(best.t_go),
                            line[best.start].position};
    count_seen(line, aircraft, now, 1, seen);
    assignments.push_back(
        {aircraft.id,
         FollowEdge{best.clockwise, meet(aircraft, line[best.start]).point.position,
                    line.tangent(best.start), options_.edge_angle},
         std::move(why)});
  }
  return assignments;
}

}  // namespace skein::perimeter
