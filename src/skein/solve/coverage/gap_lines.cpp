// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/gap_lines.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "skein/geo/boundary_index.h"
#include "skein/geo/clip.h"
#include "skein/solve/coverage/sweep_bearings.h"

namespace skein::solve {
namespace {

constexpr double kMinGap = 1e-2;  // that counts as one [m^2]
constexpr int kMaxGapRounds = 12;
constexpr double kMinShift = 1;  // that is worth a try [m]
constexpr double kApart = 0.1;   // of parts that are not one [m]

// Parts of a region that are at most `distance` apart, or a little more.
std::vector<geo::Region> groups_of(const geo::Region& region, double distance) {
  geo::Region hulls;
  for (const geo::Ring& ring : geo::grown(region, distance / 2, distance / 20))
    if (geo::signed_area(ring) > 0) hulls.push_back(ring);
  // The smallest one that surrounds a ring is its own.
  std::sort(hulls.begin(), hulls.end(), [](const geo::Ring& a, const geo::Ring& b) {
    return geo::signed_area(a) < geo::signed_area(b);
  });
  std::vector<geo::Region> groups(hulls.size());
  for (const geo::Ring& ring : region)
    for (std::size_t i = 0; i < hulls.size(); ++i)
      if (geo::contains(hulls[i], ring.front())) {
        groups[i].push_back(ring);
        break;
      }
  std::erase_if(groups, [](const geo::Region& g) { return geo::area(g) < kMinGap; });
  return groups;
}

double bearing_of_edge(const geo::Ring& ring, std::size_t i) {
  return half_turn(geo::bearing(ring[i + 1 == ring.size() ? 0 : i + 1] - ring[i]));
}

// Along the border of zones nearest to the group and slanted to it, along their long
// edges nearby, across the path into a corner, and across the lines that there are.
std::vector<double> bearings_for(const GapTask& task, const geo::BoundaryIndex& borders,
                                 const geo::Region& group) {
  constexpr std::size_t kBins = 24, kEdges = 3;
  Vec2 min = group[0][0], max = min, middle = Vec2::Zero();
  double points = 0;
  for (const geo::Ring& ring : group)
    for (const Vec2& p : ring) {
      min = min.cwiseMin(p);
      max = max.cwiseMax(p);
      middle += p;
      ++points;
    }
  middle /= points;
  const geo::NearestPoint near = borders.nearest(middle);
  const geo::Ring& nearest = task.zones.rings()[static_cast<std::size_t>(near.ring)];
  const double along = bearing_of_edge(nearest, static_cast<std::size_t>(near.edge));
  std::vector<double> bearings = {task.bearing + geo::kPi / 2, along,
                                  along + geo::kPi / 4, along - geo::kPi / 4};
  // Across the path into the nearest corner of what is to be seen; zones that overlap
  // have corners between them that are none of theirs.
  Vec2 corner = task.area[0][0];
  for (const geo::Ring& ring : task.area)
    for (const Vec2& p : ring)
      if ((p - middle).squaredNorm() < (corner - middle).squaredNorm()) corner = p;
  if ((corner - middle).norm() > 1e-3)
    bearings.push_back(geo::bearing(corner - middle) + geo::kPi / 2);
  struct Bin {
    double length = 0, longest = 0, bearing = 0;
  };
  std::array<Bin, kBins> bins;
  const Vec2 more = Vec2::Constant(task.spacing);
  for (const geo::Ring& ring : task.zones.rings())
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2& p = ring[i];
      const Vec2& q = ring[i + 1 == ring.size() ? 0 : i + 1];
      if ((p.cwiseMin(q).array() > (max + more).array()).any() ||
          (p.cwiseMax(q).array() < (min - more).array()).any())
        continue;
      const double b = bearing_of_edge(ring, i), length = (q - p).norm();
      Bin& bin =
          bins[std::min(kBins - 1, static_cast<std::size_t>(b / geo::kPi * kBins))];
      bin.length += length;
      if (length <= bin.longest) continue;
      bin.longest = length;
      bin.bearing = b;
    }
  std::stable_sort(bins.begin(), bins.end(),
                   [](const Bin& a, const Bin& b) { return a.length > b.length; });
  for (std::size_t i = 0; i < kEdges && bins[i].length > 0; ++i)
    bearings.push_back(bins[i].bearing);
  return bearings;
}

struct Choice {
  std::vector<SweepLine> lines;
  double worth = 0;  // newly seen for each metre flown [m]
};

// Those lines at a bearing that see enough of a group for what they cost.
// @param shift  of the lines to the right [m]
Choice choice_at(const GapTask& task, const geo::Region& group, double bearing,
                 double shift, double min_worth) {
  constexpr double kShare = 0.6;  // of what the best line is worth
  std::vector<SweepLine> lines =
      sweep_lines(group, bearing, task.spacing, CellRule::kSplit, task.turn_length / 2);
  for (SweepLine& line : lines) {
    const Vec2 along = geo::unit(bearing), aside = shift * geo::turned_right(along);
    line.a += aside - task.overshoot * along;
    line.b += aside + task.overshoot * along;
  }
  lines = clear_of(lines, task.zones, task.room);
  std::vector<double> seen, flown;
  double best = min_worth / kShare;
  for (const SweepLine& line : lines) {
    seen.push_back(geo::shared_area(group, beside({line}, task.spacing / 2),
                                    geo::FillRule::kNonZero));
    flown.push_back((line.b - line.a).norm() + task.turn_length);
    best = std::max(best, seen.back() / flown.back());
  }
  Choice choice;
  double all_seen = 0, all_flown = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (seen[i] < kMinGap / 4 || seen[i] / flown[i] < kShare * best) continue;
    choice.lines.push_back(lines[i]);
    all_seen += seen[i];
    all_flown += flown[i];
  }
  if (all_flown > 0) choice.worth = all_seen / all_flown;
  return choice;
}

std::vector<SweepLine> best_lines(const GapTask& task, const geo::BoundaryIndex& borders,
                                  const geo::Region& group, double min_worth) {
  Choice best;
  for (const double bearing : bearings_for(task, borders, group)) {
    if (task.stop && task.stop()) break;
    // What is narrower than a line sees may lie beside it: further from a corner there is
    // more room.
    const double slack = (task.spacing - width_across(group, bearing)) / 2;
    for (const double shift : {0.0, slack, -slack}) {
      if (shift != 0 && slack < kMinShift) break;
      Choice next = choice_at(task, group, bearing, shift, min_worth);
      if (next.worth > best.worth + 1e-9) best = std::move(next);
    }
  }
  return best.lines;
}

// The area without what is too near to zones for any line to see it.
geo::Region visible(const GapTask& task) {
  constexpr double kTolerance = 1;  // [m]
  const double hidden = task.room.distance - task.spacing / 2 - kTolerance;
  if (hidden <= 0) return task.area;
  return geo::subtract(task.area, geo::grown(task.zones.rings(), hidden, kTolerance / 2));
}

}  // namespace

geo::Region beside(const std::vector<SweepLine>& lines, double half) {
  constexpr double kMore = 1e-3;  // [m]
  geo::Region seen;
  for (const SweepLine& line : lines) {
    const Vec2 along = (line.b - line.a).normalized();
    const Vec2 right = (half + kMore) * geo::turned_right(along);
    const Vec2 a = line.a - kMore * along, b = line.b + kMore * along;
    seen.push_back({a - right, b - right, b + right, a + right});
  }
  return seen;
}

GapLines gap_lines(const GapTask& task, const std::vector<SweepLine>& lines) {
  GapLines gaps;
  if (task.zones.empty()) return gaps;
  const geo::BoundaryIndex borders(task.zones.rings());
  int cell = 0;
  for (const SweepLine& line : lines) cell = std::max(cell, line.cell + 1);
  const double half = task.spacing / 2;
  // Of a line that sees only what is new. Where a distance to zones hides what is near
  // them, no more lines come ever nearer to the limit.
  const double share = task.room.distance > half ? 0.05 : 0.001;
  const double min_worth = share * task.spacing;
  geo::Region left = geo::subtract(visible(task), beside(lines, half));
  for (int round = 0; round < kMaxGapRounds && !left.empty(); ++round) {
    std::vector<SweepLine> found;
    geo::Region rest;
    const auto take = [&](const geo::Region& group) {
      const auto best = best_lines(task, borders, group, min_worth);
      if (best.empty()) return false;
      found.insert(found.end(), best.begin(), best.end());
      rest.insert(rest.end(), group.begin(), group.end());
      return true;
    };
    for (const geo::Region& group : groups_of(left, task.spacing)) {
      if (take(group)) continue;
      // Not together, then one by one.
      for (const geo::Region& part : groups_of(group, kApart))
        if (!take(part)) gaps.unseen += geo::area(part);  // and will never be seen
    }
    left = geo::subtract(rest, beside(found, half));
    for (SweepLine& line : found) {
      line.cell = cell++;
      gaps.lines.push_back(line);
    }
  }
  gaps.unseen += geo::area(left);
  return gaps;
}

}  // namespace skein::solve
