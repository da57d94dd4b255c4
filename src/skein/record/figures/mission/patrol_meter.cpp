// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/mission/patrol_meter.h"

#include <algorithm>
#include <cmath>

namespace skein::record {
namespace {

constexpr double kSpacing = 25;  // of the points [m]
constexpr double kMaxPoints = 4000;
constexpr double kSameVisit = 10;  // [s]

}  // namespace

PatrolMeter::PatrolMeter(const PatrolGoal& goal, Time begin)
    : reach_(goal.reach), begin_(begin) {
  std::vector<Vec2> line = goal.line;
  if (goal.closed) line.push_back(Vec2(line.front()));
  double length = 0;
  for (std::size_t k = 1; k < line.size(); ++k) length += (line[k] - line[k - 1]).norm();
  const double spacing = std::max(kSpacing, length / kMaxPoints);
  for (std::size_t k = 1; k < line.size(); ++k) {
    const Vec2 leg = line[k] - line[k - 1];
    const int parts = std::max(1, static_cast<int>(std::lround(leg.norm() / spacing)));
    for (int i = 0; i < parts; ++i)
      points_.push_back({line[k - 1] + leg * i / parts, std::nullopt});
  }
  if (!goal.closed) points_.push_back({line.back(), std::nullopt});
}

void PatrolMeter::moved(Time time, EntityId /*aircraft*/, const Vec2& from,
                        const Vec2& to) {
  const Vec2 along = to - from;
  const double length2 = along.squaredNorm();
  for (Point& point : points_) {
    const double share =
        length2 > 0 ? std::clamp((point.place - from).dot(along) / length2, 0.0, 1.0) : 0;
    if ((from + share * along - point.place).squaredNorm() > reach_ * reach_) continue;
    if (point.visited) {
      const double gap = (time - *point.visited).seconds();
      if (gap > kSameVisit) {
        gaps_ += gap;
        longest_ = std::max(longest_, gap);
        ++count_;
      }
    }
    point.visited = time;
  }
}

std::vector<MissionFigure> PatrolMeter::figures(Time now) const {
  int visited = 0;
  double oldest = 0;
  for (const Point& point : points_) {
    if (point.visited) ++visited;
    oldest = std::max(oldest, (now - point.visited.value_or(begin_)).seconds());
  }
  std::vector<MissionFigure> all{
      {"visited", static_cast<double>(visited) / static_cast<double>(points_.size())},
      {"age_max_s", oldest}};
  if (count_ > 0) {
    all.push_back({"revisit_mean_s", gaps_ / count_});
    all.push_back({"revisit_max_s", longest_});
  }
  return all;
}

}  // namespace skein::record
