// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/coordinator/deployment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/base/math.h"

namespace skein::perimeter {
namespace {

constexpr int kOffsets = 24;                  // of the first side that are tried
constexpr double kSureOutside = 2;            // standard deviations of the boundary
constexpr double kShorter = 0.01;             // of two ways, worth a swap [m]
constexpr double kBefore = 150;               // outside of these, to be on course [m]
constexpr double kSector = geo::radians(15);  // of the boundary that counts for a side

// How far out the boundary may reach towards a bearing [m].
double reach(const BoundaryEstimate& boundary, const Vec2& origin, double bearing) {
  double far = 0;
  for (const auto& ring : boundary.rings)
    for (const BoundaryPoint& point : ring) {
      const Vec2 out = point.position - origin;
      if (std::abs(geo::wrap_pi(geo::bearing(out) - bearing)) <= kSector)
        far = std::max(far, out.norm() + kSureOutside * point.sigma);
    }
  return far;
}

Entry entry_at(const BoundaryEstimate& boundary, const Vec2& origin, double bearing) {
  const double distance = reach(boundary, origin, bearing) + kBefore;
  return {origin + distance * geo::unit(bearing), geo::wrap_pi(bearing + geo::kPi)};
}

// Who goes to which side: ways by aircraft and side [m].
class Matching {
 public:
  explicit Matching(std::vector<std::vector<double>> ways)
      : ways_(std::move(ways)), sides_(ways_.size()) {}

  /// The sides of the aircraft: the longest way is as short as can be; then pairs swap
  /// while that makes their ways shorter together.
  std::vector<std::size_t> solve() {
    std::vector<double> all;
    for (const auto& of_one : ways_) all.insert(all.end(), of_one.begin(), of_one.end());
    std::sort(all.begin(), all.end());
    std::size_t low = 0, high = all.size() - 1;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (matches(all[middle]))
        high = middle;
      else
        low = middle + 1;
    }
    matches(all[low]);
    swap_pairs(all[low]);
    return sides_;
  }

  double longest() const {
    double most = 0;
    for (std::size_t a = 0; a < sides_.size(); ++a) most = std::max(most, way(a));
    return most;
  }
  double sum() const {
    double sum = 0;
    for (std::size_t a = 0; a < sides_.size(); ++a) sum += way(a);
    return sum;
  }

 private:
  double way(std::size_t a) const { return ways_[a][sides_[a]]; }

  // Whether each can have a side of its own within `limit`, by augmenting paths.
  bool matches(double limit) {
    const std::size_t n = ways_.size();
    taken_.assign(n, n);
    for (std::size_t a = 0; a < n; ++a) {
      seen_.assign(n, false);
      if (!place(a, limit)) return false;
    }
    for (std::size_t side = 0; side < n; ++side) sides_[taken_[side]] = side;
    return true;
  }

  bool place(std::size_t a, double limit) {
    for (std::size_t side = 0; side < taken_.size(); ++side) {
      if (ways_[a][side] > limit || seen_[side]) continue;
      seen_[side] = true;
      if (taken_[side] == taken_.size() || place(taken_[side], limit)) {
        taken_[side] = a;
        return true;
      }
    }
    return false;
  }

  void swap_pairs(double limit) {
    for (bool better = true; better;) {
      better = false;
      for (std::size_t a = 0; a < sides_.size(); ++a)
        for (std::size_t b = a + 1; b < sides_.size(); ++b) {
          const double of_a = ways_[a][sides_[b]], of_b = ways_[b][sides_[a]];
          if (std::max(of_a, of_b) > limit || of_a + of_b >= way(a) + way(b) - kShorter)
            continue;
          std::swap(sides_[a], sides_[b]);
          better = true;
        }
    }
  }

  std::vector<std::vector<double>> ways_;
  std::vector<std::size_t> sides_;  // of the aircraft
  std::vector<std::size_t> taken_;  // aircraft of the sides; their number: none
  std::vector<bool> seen_;
};

}  // namespace

std::vector<Entry> plan_entries(const BoundaryEstimate& boundary, const Vec2& origin,
                                std::span<const Vec2> aircraft) {
  const std::size_t n = aircraft.size();
  std::vector<Entry> best(n);
  std::pair<double, double> least{math::kInfinity, math::kInfinity};
  for (int k = 0; k < kOffsets && n > 0; ++k) {
    std::vector<Entry> sides;
    const double apart = 2 * geo::kPi / static_cast<double>(n);
    for (std::size_t side = 0; side < n; ++side)
      sides.push_back(entry_at(
          boundary, origin,
          apart * (static_cast<double>(k) / kOffsets + static_cast<double>(side))));
    std::vector<std::vector<double>> ways(n);
    for (std::size_t a = 0; a < n; ++a)
      for (const Entry& entry : sides)
        ways[a].push_back((entry.place - aircraft[a]).norm());
    Matching matching(std::move(ways));
    const std::vector<std::size_t> of = matching.solve();
    const std::pair<double, double> way{matching.longest(), matching.sum()};
    if (way >= least) continue;
    least = way;
    for (std::size_t a = 0; a < n; ++a) best[a] = sides[of[a]];
  }
  return best;
}

}  // namespace skein::perimeter
