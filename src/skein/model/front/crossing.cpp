// SPDX-License-Identifier: Apache-2.0
#include "skein/model/front/crossing.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "skein/base/math.h"

namespace skein::model {
namespace {

constexpr int kReach = 8;  // joints of one local loop at most
// A loop turns by more than half a turn in its joints (the crossing does the rest of the
// full turn), so at least one of kReach joints turns by over pi / kReach.
const double kSharpCos2 = math::squared(math::cos(geo::kPi / kReach));

bool sharp(const Vec2& in, const Vec2& out) {
  const double dot = in.dot(out);
  return dot <= 0 || dot * dot < kSharpCos2 * in.squaredNorm() * out.squaredNorm();
}

Vec2 crossing_point(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double u = geo::cross(c - a, d - c) / geo::cross(b - a, d - c);
  return a + std::clamp(u, 0.0, 1.0) * (b - a);
}

struct Loop {
  int first = 0, last = -1;  // crossing edges; first may be negative (before ring[0])
};

// The first small loop around joint m.
Loop loop_at(const geo::Ring& ring, int m, double min_area) {
  const int n = static_cast<int>(ring.size());
  const auto at = [&](int i) -> const Vec2& {
    return ring[static_cast<std::size_t>(((i % n) + n) % n)];
  };
  for (int b = m; b < m + kReach; ++b) {
    for (int a = std::min(m - 1, b - 2); a >= b - kReach; --a) {
      if (!segments_cross(at(a), at(a + 1), at(b), at(b + 1))) continue;
      const Vec2 x = crossing_point(at(a), at(a + 1), at(b), at(b + 1));
      double twice = 0;
      for (int i = a + 1; i < b; ++i) twice += geo::cross(at(i) - x, at(i + 1) - x);
      if (std::abs(twice) <= 2 * min_area) return {a, b};
    }
  }
  return {};
}

// Replaces the markers of a loop by the crossing point.
void cut(geo::Ring& ring, const Loop& loop) {
  const int n = static_cast<int>(ring.size());
  const auto at = [&](int i) -> const Vec2& {
    return ring[static_cast<std::size_t>(((i % n) + n) % n)];
  };
  const Vec2 x = crossing_point(at(loop.first), at(loop.first + 1), at(loop.last),
                                at(loop.last + 1));
  geo::Ring rest;
  rest.reserve(ring.size());
  rest.push_back(x);
  for (int i = loop.last + 1; i <= loop.first + n; ++i) rest.push_back(at(i));
  ring = std::move(rest);
}

}  // namespace

bool segments_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const Vec2 ab = b - a, cd = d - c;
  return (geo::cross(ab, c - a) > 0) != (geo::cross(ab, d - a) > 0) &&
         (geo::cross(cd, a - c) > 0) != (geo::cross(cd, b - c) > 0);
}

void cut_loops(geo::Ring& ring, double min_area) {
  for (std::size_t m = 0; m < ring.size();) {
    if (static_cast<int>(ring.size()) < 2 * kReach) return;
    const Vec2& p = ring[m];
    const Vec2& before = ring[m > 0 ? m - 1 : ring.size() - 1];
    const Vec2& after = ring[m + 1 < ring.size() ? m + 1 : 0];
    Loop loop;
    if (sharp(p - before, after - p)) loop = loop_at(ring, static_cast<int>(m), min_area);
    if (loop.last < 0) {
      ++m;
    } else {
      cut(ring, loop);
      m = 0;
    }
  }
}

bool CrossingSearch::any(const geo::Region& region, double cell) {
  std::size_t edges = 0;
  for (const geo::Ring& ring : region) edges += ring.size();
  heads_.assign(std::bit_ceil(4 * edges + 16), -1);
  entries_.clear();
  const double scale = 1 / cell;
  const auto mask = static_cast<std::uint64_t>(heads_.size() - 1);

  for (std::size_t r = 0; r < region.size(); ++r) {
    const geo::Ring& ring = region[r];
    const auto n = static_cast<std::int32_t>(ring.size());
    for (std::int32_t e = 0; e < n; ++e) {
      Entry entry{ring[static_cast<std::size_t>(e)],
                  ring[static_cast<std::size_t>(e + 1 < n ? e + 1 : 0)],
                  0,
                  static_cast<std::int32_t>(r),
                  e,
                  n - 1,
                  -1};
      const Vec2 low = entry.a.cwiseMin(entry.b) * scale,
                 high = entry.a.cwiseMax(entry.b) * scale;
      const auto x1 = static_cast<std::int64_t>(std::floor(high.x()));
      const auto y1 = static_cast<std::int64_t>(std::floor(high.y()));
      const auto y0 = static_cast<std::int64_t>(std::floor(low.y()));
      for (auto x = static_cast<std::int64_t>(std::floor(low.x())); x <= x1; ++x) {
        for (auto y = y0; y <= y1; ++y) {
          const auto mixed = static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15u ^
                             static_cast<std::uint64_t>(y) * 0xC2B2AE3D27D4EB4Fu;
          std::int32_t& head = heads_[(mixed ^ (mixed >> 29)) & mask];
          entry.cell = x * (std::int64_t{1} << 32) + y;
          for (std::int32_t k = head; k >= 0;) {
            const Entry& other = entries_[static_cast<std::size_t>(k)];
            k = other.next;
            if (other.cell != entry.cell) continue;
            if (other.ring == entry.ring) {
              const std::int32_t apart = e - other.edge;
              if (apart <= 1 || apart == entry.last_edge) continue;  // neighbours
            }
            if (segments_cross(other.a, other.b, entry.a, entry.b)) return true;
          }
          entry.next = head;
          head = static_cast<std::int32_t>(entries_.size());
          entries_.push_back(entry);
        }
      }
    }
  }
  return false;
}

}  // namespace skein::model
