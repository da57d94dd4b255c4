// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/sweep_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/model/path/wind_triangle.h"
#include "skein/solve/coverage/gap_lines.h"
#include "skein/solve/coverage/sweep_bearings.h"

namespace skein::solve {
namespace {

constexpr std::array kRules = {CellRule::kCommonLines, CellRule::kSplit,
                               CellRule::kSplitAtJumps};

bool convex(const geo::Region& area) {
  if (area.size() != 1) return false;
  const geo::Ring& r = area[0];
  for (std::size_t i = 0; i < r.size(); ++i) {
    const Vec2& p = r[i];
    const Vec2& q = r[(i + 1) % r.size()];
    const Vec2& s = r[(i + 2) % r.size()];
    if (geo::cross(q - p, s - q) < -1e-6 * (q - p).norm()) return false;
  }
  return true;
}

// How wide turns are in lines, and one more.
int skip_of(const SweepTask& task) {
  const double wide = 2 * task.air.turn_radius / task.spacing;
  return std::clamp(static_cast<int>(std::ceil(wide)) + 1, 1, 8);
}

struct Candidate {
  double bearing;
  CellRule rule;
  double time;  // estimate [s]
  std::size_t lines;
};

// Into how many pieces lines are cut: none, or a few when there are few lines for each
// aircraft.
std::vector<int> pieces_for(const SweepTask& task, std::size_t lines) {
  constexpr std::size_t kFew = 6;  // lines for each aircraft
  const std::size_t aircraft = task.ends.size();
  if (aircraft == 1 || lines > kFew * aircraft) return {1};
  if (aircraft == 2) return {1, 2};
  return {1, 2, static_cast<int>(aircraft)};
}

// The quickest path from a line to one beside it, both ending at the same level [s].
double usual_turn(const SweepTask& task, double bearing) {
  double min = 1e300;
  const Vec2 across = geo::turned_right(geo::unit(bearing));
  for (const double course : {bearing, bearing + geo::kPi}) {
    const auto out = model::heading_for_course(course, task.air.airspeed, task.air.wind);
    const auto back =
        model::heading_for_course(course + geo::kPi, task.air.airspeed, task.air.wind);
    for (int skip = 1; skip <= skip_of(task); ++skip)
      for (const double side : {-1.0, 1.0}) {
        const model::Pose to{side * skip * task.spacing * across, *back};
        min = std::min(min, model::connect({{0, 0}, *out}, to, task.air).time);
      }
  }
  return min;
}

// Time on the lines, flown as often in one direction as in the other, and usual turns
// between [s].
double rough_time(const SweepTask& task, const std::vector<SweepLine>& lines,
                  double bearing, double turn) {
  double slowness = 0;  // of both directions together [s/m]
  for (const double course : {bearing, bearing + geo::kPi}) {
    const auto h = model::heading_for_course(course, task.air.airspeed, task.air.wind);
    slowness += 1 / (task.air.airspeed * geo::unit(*h) + task.air.wind).norm();
  }
  double length = 0;
  for (const SweepLine& line : lines) length += (line.b - line.a).norm();
  return length * slowness / 2 + static_cast<double>(lines.size()) * turn;
}

// Lines at a bearing and those that see what these leave before zones.
GapLines all_lines(const SweepTask& task, double bearing, CellRule rule, int pieces) {
  const std::vector<SweepLine> lines = lines_at(task, bearing, rule, pieces);
  const double turn = geo::kPi * task.room.turn_radius;
  GapLines all = gap_lines({task.area, task.zones, task.spacing, bearing, turn,
                            task.overshoot, task.room, task.watch.stop},
                           lines);
  all.lines.insert(all.lines.begin(), lines.begin(), lines.end());
  return all;
}

// What is unseen costs as much time as seeing it very often would.
double cost_of(const SweepTask& task, double unseen) {
  constexpr double kOften = 50;
  return kOften * unseen / (task.spacing * task.air.airspeed);
}

DetourTime detour_of(const SweepTask& task) {
  if (task.zones.empty()) return {};
  double around = 0;
  for (const geo::Ring& ring : task.zones.rings())
    around = std::max(around, geo::length(ring));
  const double slow = task.air.airspeed - task.air.wind.norm();
  // Half around the largest zone and a turn: rather long, as it shall be avoided.
  const double lost = (around / 2 + 2 * geo::kPi * task.air.turn_radius) / slow;
  return [&task, lost](const model::Pose& from, const model::Pose&,
                       const model::Connection& c) {
    return task.zones.entered_by(model::to_flight_plan(c, from, task.air)) ? lost : 0.0;
  };
}

Sweep swept_in_pieces(const SweepTask& task, double bearing, CellRule rule, int pieces,
                      const OrderBudget& budget) {
  Sweep sweep;
  sweep.bearing = bearing;
  GapLines all = all_lines(task, bearing, rule, pieces);
  sweep.lines = std::move(all.lines);
  sweep.unseen = all.unseen;
  sweep.too_many = sweep.lines.size() > kMaxLines;
  if (sweep.lines.empty() || sweep.too_many) return sweep;
  LineCosts costs(sweep.lines, task.air, task.ends, detour_of(task), task.watch.stop);
  sweep.routes = share_lines(costs, budget);
  sweep.longest = sweep.total = 0;
  for (int a = 0; a < costs.aircraft(); ++a) {
    const double time = route_time(costs, a, sweep.routes[static_cast<std::size_t>(a)]);
    sweep.longest = std::max(sweep.longest, time);
    sweep.total += time;
  }
  sweep.cost = sweep.longest + cost_of(task, sweep.unseen);
  return sweep;
}

// The best of whole lines and, when there are few for each aircraft, pieces of them.
Sweep swept(const SweepTask& task, double bearing, CellRule rule,
            const OrderBudget& budget) {
  Sweep best;
  for (const int k : pieces_for(task, lines_at(task, bearing, rule).size())) {
    Sweep next = swept_in_pieces(task, bearing, rule, k, budget);
    if (better(next, best) || best.lines.empty()) best = std::move(next);
  }
  return best;
}

std::size_t count_for(double work, const std::vector<Candidate>& candidates, double min,
                      double max) {
  const auto lines = static_cast<double>(candidates.front().lines);
  return static_cast<std::size_t>(std::clamp(work / lines, min, max));
}

void sort(std::vector<Candidate>& candidates) {
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return a.time < b.time; });
}

// A part of the work, as shares of the whole.
struct Part {
  double from, to;

  void report(const Watch& watch, std::size_t done, std::size_t all) const {
    watch.report(from +
                 (to - from) * static_cast<double>(done) / static_cast<double>(all));
  }
};

// About the shares of time they take.
constexpr Part kAllBearings{0, 0.05}, kSimply{0.05, 0.15}, kBetter{0.15, 0.45},
    kFully{0.45, 0.85}, kBeside{0.85, 1};

// In a simple order, without lines for what zones hide, and through zones: they cost too
// much for the many.
double simple_time(const SweepTask& task, const Candidate& c) {
  LineCosts costs(lines_at(task, c.bearing, c.rule), task.air, task.ends, {},
                  task.watch.stop);
  OrderBudget budget;
  budget.max_skip = skip_of(task);
  return rough_longest(costs, budget, false);
}

// In a better order. For several aircraft lines are shared as in the end, but in haste:
// where these start is not seen in one order of all lines.
double better_time(const SweepTask& task, const Candidate& c) {
  OrderBudget budget;
  budget.max_skip = skip_of(task);
  budget.kicks = 0;
  if (task.ends.size() > 1) return swept(task, c.bearing, c.rule, budget).cost;
  GapLines all = all_lines(task, c.bearing, c.rule, 1);
  if (all.lines.size() > kMaxLines) return 1e300;
  LineCosts costs(std::move(all.lines), task.air, task.ends, detour_of(task),
                  task.watch.stop);
  return rough_longest(costs, budget, true) + cost_of(task, all.unseen);
}

// The first `count` of the list with their times in a simple order, or in a better one,
// the quickest first.
std::vector<Candidate> in_order(const SweepTask& task, std::vector<Candidate> candidates,
                                std::size_t count, bool improve, const Part& part) {
  sort(candidates);
  if (candidates.size() > count) candidates.resize(count);
  std::size_t done = 0;
  for (Candidate& c : candidates) {
    // At least one has been looked at when there is no more time.
    if (done > 0 && task.watch.stopped()) break;
    part.report(task.watch, done++, candidates.size());
    c.time = improve ? better_time(task, c) : simple_time(task, c);
  }
  candidates.resize(done);
  sort(candidates);
  return candidates;
}

// Whether a list has one of the same rule within a step.
bool has_like(const std::vector<Candidate>& list, const Candidate& c) {
  return std::any_of(list.begin(), list.end(), [&](const Candidate& other) {
    return other.rule == c.rule &&
           std::abs(other.bearing - c.bearing) < 1.5 * kBearingStep;
  });
}

OrderBudget effort_for(const SweepTask& task, std::size_t lines) {
  OrderBudget budget;
  budget.max_skip = skip_of(task);
  budget.kicks = static_cast<int>(std::clamp<std::size_t>(1000 / lines, 2, 40));
  return budget;
}

Sweep best_of(const SweepTask& task, std::vector<Candidate> candidates) {
  sort(candidates);
  const std::size_t simply = count_for(12000, candidates, 24, 3000);
  // How several aircraft share lines is not seen in simple orders: more are tried out.
  const bool several = task.ends.size() > 1;
  const bool zones = !task.zones.empty();
  const std::size_t better_ordered = count_for(zones     ? 3000
                                               : several ? 12000
                                                         : 2400,
                                               candidates, 12, several ? 3000 : 300);
  const std::size_t count = zones     ? count_for(300, candidates, 4, 30)
                            : several ? count_for(500, candidates, 8, 60)
                                      : count_for(250, candidates, 4, 30);
  candidates = in_order(task, std::move(candidates), simply, false, kSimply);
  candidates = in_order(task, std::move(candidates), better_ordered, true, kBetter);
  std::vector<Candidate> tried;
  Sweep best;
  Candidate from = candidates.front();
  for (const Candidate& c : candidates) {
    if (tried.size() >= count || (!tried.empty() && task.watch.stopped())) break;
    if (has_like(tried, c)) continue;
    kFully.report(task.watch, tried.size(), count);
    tried.push_back(c);
    Sweep next = swept(task, c.bearing, c.rule, effort_for(task, c.lines));
    best.too_many = best.too_many || next.too_many;
    if (!better(next, best)) continue;
    best = std::move(next);
    from = c;
  }
  if (best.lines.empty()) return best;
  best.too_many = false;
  // Bearings beside the best one, ever closer.
  const double widest = several ? 4 * kBearingStep : kBearingStep;
  for (double step = widest; step > kBearingStep / 10; step /= 2)
    for (const double side : {-1.0, 1.0}) {
      if (task.watch.stopped()) return best;
      task.watch.report(kBeside.to - (kBeside.to - kBeside.from) * step / widest);
      Sweep next = swept(task, best.bearing + side * step, from.rule,
                         effort_for(task, from.lines));
      if (better(next, best)) best = std::move(next);
    }
  return best;
}

}  // namespace

bool better(const Sweep& a, const Sweep& b) {
  if (a.cost < b.cost - 1e-9) return true;
  return a.cost <= b.cost + 1e-9 && a.total < b.total - 1e-9;
}

std::vector<SweepLine> lines_at(const SweepTask& task, double bearing, CellRule rule,
                                int pieces) {
  std::vector<SweepLine> lines =
      sweep_lines(task.area, bearing, task.spacing, rule, task.joined);
  const Vec2 more = task.overshoot * geo::unit(bearing);
  std::vector<SweepLine> cut;
  cut.reserve(lines.size() * static_cast<std::size_t>(pieces));
  for (const SweepLine& line : lines)
    for (int k = 0; k < pieces; ++k) {
      const Vec2 part = (line.b - line.a) / pieces;
      cut.push_back(
          {line.a + k * part - more, line.a + (k + 1) * part + more, line.cell});
    }
  return clear_of(cut, task.zones, task.room);
}

Sweep sweep_at(const SweepTask& task, double bearing, const OrderBudget& budget) {
  Sweep best;
  for (const CellRule rule : kRules) {
    Sweep next = swept(task, bearing, rule, budget);
    if (better(next, best) || (next.too_many && best.lines.empty()))
      best = std::move(next);
    if (convex(task.area)) break;
  }
  return best;
}

Sweep best_sweep(const SweepTask& task) {
  std::vector<Candidate> candidates;
  const bool one_rule = convex(task.area);
  bool too_many = false;
  const std::vector<double> bearings =
      bearings_to_try(task.area, task.spacing, task.air.wind);
  std::size_t done = 0;
  for (const double bearing : bearings) {
    if (!candidates.empty() && task.watch.stopped()) break;
    kAllBearings.report(task.watch, done++, bearings.size());
    const double turn = usual_turn(task, bearing);
    for (const CellRule rule : kRules) {
      const auto lines = lines_at(task, bearing, rule);
      too_many = too_many || lines.size() > kMaxLines;
      if (lines.empty() || lines.size() > kMaxLines) continue;
      candidates.push_back(
          {bearing, rule, rough_time(task, lines, bearing, turn), lines.size()});
      if (one_rule) break;
    }
  }
  if (candidates.empty()) {
    Sweep none;
    none.too_many = too_many;
    return none;
  }
  return best_of(task, candidates);
}

}  // namespace skein::solve
