// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/wind/gridded_wind.h"

#include <algorithm>

namespace skein::environment {
namespace {

// Where a value lies among growing knots: between `low` and the next, `part` of the
// interval.
struct Bracket {
  std::size_t low;
  double part;
};

template <class T, class ToNumber>
Bracket bracket(const std::vector<T>& knots, T value, ToNumber&& number) {
  if (knots.size() == 1 || value <= knots.front()) return {0, 0};
  if (value >= knots.back()) return {knots.size() - 2, 1};
  const auto after = std::upper_bound(knots.begin(), knots.end(), value);
  const auto low = static_cast<std::size_t>(after - knots.begin()) - 1;
  return {low, number(value - knots[low]) / number(knots[low + 1] - knots[low])};
}

template <class T>
void check_growing(const std::vector<T>& knots) {
  SKEIN_CHECK(!knots.empty());
  for (std::size_t i = 1; i < knots.size(); ++i) SKEIN_CHECK(knots[i - 1] < knots[i], i);
}

}  // namespace

GriddedWind::GriddedWind(std::vector<Time> times, std::vector<double> heights,
                         std::vector<Slice> slices)
    : times_(std::move(times)), heights_(std::move(heights)), slices_(std::move(slices)) {
  check_growing(times_);
  check_growing(heights_);
  SKEIN_CHECK(slices_.size() == times_.size() * heights_.size(), slices_.size());
}

Vec3 GriddedWind::wind(const Vec3& p_N, Time time) const {
  const Vec2 p = geo::horizontal(p_N);
  const Bracket t = bracket(times_, time, [](Time span) { return span.seconds(); });
  const Bracket h = bracket(heights_, -p_N.z(), [](double span) { return span; });
  const auto slice = [&](std::size_t i, std::size_t j) {
    const Slice& s = slices_[i * heights_.size() + j];
    return Vec2(s.north.at(p), s.east.at(p));
  };
  const auto level = [&](std::size_t i) -> Vec2 {
    Vec2 below = slice(i, h.low);
    if (h.part <= 0) return below;
    return below + h.part * (slice(i, h.low + 1) - below);
  };
  Vec3 result = Vec3::Zero();
  result.head<2>() = level(t.low);
  if (t.part > 0) result.head<2>() += t.part * (level(t.low + 1) - result.head<2>());
  return result;
}

}  // namespace skein::environment
