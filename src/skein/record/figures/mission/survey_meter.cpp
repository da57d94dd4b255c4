// SPDX-License-Identifier: Apache-2.0
#include "skein/record/figures/mission/survey_meter.h"

#include <algorithm>
#include <cmath>

namespace skein::record {
namespace {

constexpr double kCellsPerSwath = 16;
constexpr double kMaxCells = 400000;

}  // namespace

SurveyMeter::SurveyMeter(const SurveyGoal& goal, Time begin)
    : begin_(begin),
      planned_at_(goal.planned_at),
      planned_for_(goal.planned_for),
      reach_(goal.swath / 2) {
  Vec2 high = low_ = goal.area.front();
  for (const Vec2& corner : goal.area) {
    low_ = low_.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const Vec2 size = high - low_;
  cell_ = std::max(goal.swath / kCellsPerSwath, std::sqrt(size.prod() / kMaxCells));
  rows_ = static_cast<int>(std::ceil(size.x() / cell_));
  columns_ = static_cast<int>(std::ceil(size.y() / cell_));
  cells_.reserve(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_));
  for (int r = 0; r < rows_; ++r)
    for (int c = 0; c < columns_; ++c) {
      const Vec2 middle = low_ + cell_ * Vec2(r + 0.5, c + 0.5);
      const bool counts =
          geo::contains(goal.area, middle) &&
          std::none_of(goal.holes.begin(), goal.holes.end(), [&](const geo::Ring& hole) {
            return geo::contains(hole, middle);
          });
      cells_.push_back(counts ? Cell::kUnseen : Cell::kOutside);
      if (counts) ++inside_;
    }
}

double SurveyMeter::seen() const {
  return inside_ > 0 ? static_cast<double>(seen_) / static_cast<double>(inside_) : 1;
}

void SurveyMeter::goal_changed(const MissionGoal& goal) {
  const auto* survey = std::get_if<SurveyGoal>(&goal);
  if (!survey) return;
  planned_at_ = survey->planned_at;
  planned_for_ = survey->planned_for;
}

void SurveyMeter::moved(Time time, EntityId /*aircraft*/, const Vec2& from,
                        const Vec2& to) {
  if (seen_ == inside_) return;
  const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / cell_)));
  for (int k = 1; k <= steps; ++k) see_around(from + (to - from) * k / steps);
  if (!seen_95_ && seen() >= 0.95) seen_95_ = time - begin_;
  if (!seen_all_ && seen_ == inside_) seen_all_ = time - begin_;
}

void SurveyMeter::see_around(const Vec2& place) {
  const Vec2 at = (place - low_) / cell_ - Vec2::Constant(0.5);  // in cells
  const double reach = reach_ / cell_;
  const int first = std::max(0, static_cast<int>(std::ceil(at.x() - reach)));
  const int last = std::min(rows_ - 1, static_cast<int>(std::floor(at.x() + reach)));
  for (int r = first; r <= last; ++r) {
    const double across = reach * reach - (r - at.x()) * (r - at.x());
    const double half = std::sqrt(std::max(across, 0.0));
    const int begin = std::max(0, static_cast<int>(std::ceil(at.y() - half)));
    const int end = std::min(columns_ - 1, static_cast<int>(std::floor(at.y() + half)));
    for (int c = begin; c <= end; ++c) {
      Cell& cell =
          cells_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(c)];
      if (cell != Cell::kUnseen) continue;
      cell = Cell::kSeen;
      ++seen_;
    }
  }
}

std::vector<MissionFigure> SurveyMeter::figures(Time /*now*/) const {
  std::vector<MissionFigure> all{{"seen", seen()}};
  if (seen_95_) all.push_back({"seen_95_s", seen_95_->seconds()});
  if (seen_all_) all.push_back({"seen_all_s", seen_all_->seconds()});
  if (planned_for_ > 0) {
    all.push_back({"planned_s", planned_for_});
    if (seen_all_)
      all.push_back({"seen_all_of_plan",
                     ((begin_ + *seen_all_).seconds() - planned_at_) / planned_for_});
  }
  return all;
}

}  // namespace skein::record
