// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/levels.h"
#include "skein/role/terrain.h"

#include <algorithm>
#include <cmath>

namespace skein::solve {
namespace {

constexpr std::size_t kMax = 6;
constexpr double kMargin = 1;  // over and under [m]
constexpr double kLook = 20;   // between looks at the ground [m]
constexpr double kMaxLooks = 5000;

double ground_below(const PathQuery& q) {
  const Vec2 a = geo::horizontal(q.start.p_N), b = geo::horizontal(q.goal.p_N);
  const double looks = std::clamp(std::ceil((b - a).norm() / kLook), 1.0, kMaxLooks);
  double highest = q.terrain->elevation_msl(a);
  for (double i = 1; i <= looks; ++i)
    highest = std::max(highest, q.terrain->elevation_msl(a + i / looks * (b - a)));
  return highest;
}

}  // namespace

std::vector<double> levels_between(const AirspaceMap& map) {
  const PathQuery& q = map.query();
  std::vector<double> levels;
  if (q.airspace != nullptr)
    for (const Zone& zone : q.airspace->zones) {
      if (std::isfinite(zone.floor_msl)) levels.push_back(zone.floor_msl - kMargin);
      if (std::isfinite(zone.ceiling_msl)) levels.push_back(zone.ceiling_msl + kMargin);
    }
  if (q.terrain != nullptr)
    levels.push_back(ground_below(q) + q.ground_clearance + kMargin);
  const double a = -q.start.p_N.z(), b = -q.goal.p_N.z();
  std::sort(levels.begin(), levels.end(), [&](double x, double y) {
    const double dx = std::abs(x - a) + std::abs(x - b);
    const double dy = std::abs(y - a) + std::abs(y - b);
    return dx != dy ? dx < dy : x < y;
  });
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  if (levels.size() > kMax) levels.resize(kMax);
  return levels;
}

}  // namespace skein::solve
