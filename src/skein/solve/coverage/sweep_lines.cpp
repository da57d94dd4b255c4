// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/coverage/sweep_lines.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace skein::solve {
namespace {

// Lengths below which two points count as one [m]; clean areas are rounded to 0.1 mm.
constexpr double kTiny = 1e-6;

// u runs along the bearing, v to the right of it.
struct Edge {
  double v0, u0, v1, u1;  // v0 < v1

  double u_at(double v) const { return u0 + (u1 - u0) * ((v - v0) / (v1 - v0)); }
};

struct Trapezoid {
  double v0, v1;
  Edge left, right;
  int cell = -1, part = -1;
};

struct Interval {
  double low, high;
  int cell;
};

std::vector<Edge> edges_of(const geo::Region& area, const Vec2& along,
                           const Vec2& across) {
  std::vector<Edge> edges;
  for (const geo::Ring& ring : area)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2& p = ring[i];
      const Vec2& q = ring[i + 1 == ring.size() ? 0 : i + 1];
      Edge e{across.dot(p), along.dot(p), across.dot(q), along.dot(q)};
      if (e.v0 > e.v1) e = {e.v1, e.u1, e.v0, e.u0};
      edges.push_back(e);
    }
  return edges;
}

std::vector<double> levels_of(const std::vector<Edge>& edges) {
  std::vector<double> levels;
  levels.reserve(2 * edges.size());
  for (const Edge& e : edges) {
    levels.push_back(e.v0);
    levels.push_back(e.v1);
  }
  std::sort(levels.begin(), levels.end());
  std::vector<double> distinct;
  for (const double v : levels)
    if (distinct.empty() || v - distinct.back() > kTiny) distinct.push_back(v);
  return distinct;
}

// Trapezoids between neighbouring levels, slab by slab; `begins` says where slabs begin.
std::vector<Trapezoid> trapezoids_of(const std::vector<Edge>& edges,
                                     const std::vector<double>& levels,
                                     std::vector<std::size_t>& begins) {
  std::vector<Trapezoid> all;
  std::vector<Edge> here;
  for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
    begins.push_back(all.size());
    const double middle = (levels[k] + levels[k + 1]) / 2;
    here.clear();
    for (const Edge& e : edges)
      if (e.v0 < middle && e.v1 > middle) here.push_back(e);
    std::sort(here.begin(), here.end(), [&](const Edge& a, const Edge& b) {
      return a.u_at(middle) < b.u_at(middle);
    });
    for (std::size_t i = 0; i + 1 < here.size(); i += 2)
      all.push_back({levels[k], levels[k + 1], here[i], here[i + 1]});
  }
  begins.push_back(all.size());
  return all;
}

bool touch(const Trapezoid& below, const Trapezoid& above) {
  const double v = below.v1;
  return std::min(below.right.u_at(v), above.right.u_at(v)) -
             std::max(below.left.u_at(v), above.left.u_at(v)) >
         kTiny;
}

double jump(const Trapezoid& below, const Trapezoid& above) {
  const double v = below.v1;
  return std::max(std::abs(below.left.u_at(v) - above.left.u_at(v)),
                  std::abs(below.right.u_at(v) - above.right.u_at(v)));
}

// Numbers the cells and the connected parts.
void number(std::vector<Trapezoid>& all, const std::vector<std::size_t>& begins,
            double largest_jump) {
  std::vector<int> parent(all.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[static_cast<std::size_t>(i)] != i)
      i = parent[static_cast<std::size_t>(i)];
    return i;
  };
  int cells = 0;
  std::vector<int> ups(all.size(), 0), downs(all.size(), 0), down(all.size(), -1);
  for (std::size_t k = 1; k + 1 < begins.size(); ++k)
    for (std::size_t i = begins[k]; i < begins[k + 1]; ++i)
      for (std::size_t j = begins[k - 1]; j < begins[k]; ++j) {
        if (!touch(all[j], all[i])) continue;
        ++ups[j];
        ++downs[i];
        down[i] = static_cast<int>(j);
        const int a = root(static_cast<int>(i)), b = root(static_cast<int>(j));
        parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
      }
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].part = root(static_cast<int>(i));
    const auto j = static_cast<std::size_t>(std::max(down[i], 0));
    const bool goes_on =
        downs[i] == 1 && ups[j] == 1 && jump(all[j], all[i]) <= largest_jump;
    all[i].cell = goes_on ? all[j].cell : cells++;
  }
}

// What a band sees of a trapezoid.
Interval seen(const Trapezoid& t, double v0, double v1) {
  const double low = std::max(v0, t.v0), high = std::min(v1, t.v1);
  return {std::min(t.left.u_at(low), t.left.u_at(high)),
          std::max(t.right.u_at(low), t.right.u_at(high)), t.cell};
}

// Joins what overlaps or lies no further apart than `gap`; the longest gives its cell.
std::vector<Interval> merged(std::vector<Interval> parts, double gap) {
  std::sort(parts.begin(), parts.end(),
            [](const Interval& a, const Interval& b) { return a.low < b.low; });
  std::vector<Interval> out;
  double longest = 0;
  for (const Interval& p : parts) {
    if (out.empty() || p.low > out.back().high + gap) {
      out.push_back(p);
      longest = p.high - p.low;
      continue;
    }
    out.back().high = std::max(out.back().high, p.high);
    if (p.high - p.low > longest) {
      longest = p.high - p.low;
      out.back().cell = p.cell;
    }
  }
  return out;
}

}  // namespace

double width_across(const geo::Region& area, double bearing) {
  const Vec2 across = geo::turned_right(geo::unit(bearing));
  double min = 1e300, max = -1e300;
  for (const geo::Ring& ring : area)
    for (const Vec2& p : ring) {
      min = std::min(min, across.dot(p));
      max = std::max(max, across.dot(p));
    }
  return std::max(0.0, max - min);
}

std::vector<SweepLine> sweep_lines(const geo::Region& area, double bearing,
                                   double spacing, CellRule rule, double joined) {
  const Vec2 along = geo::unit(bearing), across = geo::turned_right(along);
  const std::vector<Edge> edges = edges_of(area, along, across);
  std::vector<std::size_t> begins;
  std::vector<Trapezoid> all = trapezoids_of(edges, levels_of(edges), begins);
  number(all, begins, rule == CellRule::kSplitAtJumps ? spacing : 1e300);
  const auto group_of = [&](const Trapezoid& t) {
    return rule == CellRule::kCommonLines ? t.part : t.cell;
  };
  std::stable_sort(all.begin(), all.end(), [&](const Trapezoid& a, const Trapezoid& b) {
    return group_of(a) < group_of(b);
  });
  std::vector<SweepLine> lines;
  for (std::size_t from = 0; from < all.size();) {
    std::size_t to = from;
    double v0 = 1e300, v1 = -1e300;
    for (; to < all.size() && group_of(all[to]) == group_of(all[from]); ++to) {
      v0 = std::min(v0, all[to].v0);
      v1 = std::max(v1, all[to].v1);
    }
    const int bands =
        std::max(1, static_cast<int>(std::ceil((v1 - v0) / spacing - 1e-9)));
    const double width = (v1 - v0) / bands;
    for (int k = 0; k < bands; ++k) {
      const double low = v0 + k * width, high = low + width, v = low + width / 2;
      std::vector<Interval> parts;
      for (std::size_t i = from; i < to; ++i)
        if (all[i].v0 < high && all[i].v1 > low) parts.push_back(seen(all[i], low, high));
      for (const Interval& part : merged(std::move(parts), joined))
        lines.push_back(
            {part.low * along + v * across, part.high * along + v * across, part.cell});
    }
    from = to;
  }
  std::stable_sort(
      lines.begin(), lines.end(),
      [](const SweepLine& a, const SweepLine& b) { return a.cell < b.cell; });
  return lines;
}

}  // namespace skein::solve
