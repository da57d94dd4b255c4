// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/recorded/perimeter_fire.h"

#include <algorithm>
#include <limits>

#include "skein/base/check.h"
#include "skein/geo/contour.h"
#include "skein/layer/environment/recorded/distance_grid.h"

namespace skein::environment {

PerimeterFire::PerimeterFire(const std::vector<Perimeter>& series, const GridShape& shape,
                             double start)
    : start_(start) {
  SKEIN_CHECK(!series.empty() && series.front().time == 0);
  for (const Perimeter& perimeter : series) {
    SKEIN_CHECK(times_.empty() || perimeter.time > times_.back(), perimeter.time);
    times_.push_back(perimeter.time);
    GridField field = signed_distance(perimeter.region, shape);
    if (!distances_.empty()) {
      // Growth holds node by node even where rounding would undo it.
      std::vector<double> values(field.values().begin(), field.values().end());
      const auto before = distances_.back().values();
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = std::min(values[i], before[i]);
      field = GridField(shape, std::move(values));
    }
    distances_.push_back(std::move(field));
  }
  advance(Time());
}

void PerimeterFire::advance(Time time) {
  SKEIN_CHECK(time >= now_, time.seconds(), now_.seconds());
  now_ = time;
  const double t = start_ + time.seconds();
  const auto next = std::upper_bound(times_.begin(), times_.end(), t);
  Moment moment;
  moment.after =
      std::min(static_cast<std::size_t>(next - times_.begin()), times_.size() - 1);
  moment.before =
      next == times_.begin() ? 0 : static_cast<std::size_t>(next - times_.begin()) - 1;
  if (moment.after > moment.before)
    moment.part =
        (t - times_[moment.before]) / (times_[moment.after] - times_[moment.before]);
  if (moment.before == moment_.before && moment.after == moment_.after &&
      moment.part == moment_.part)
    return;
  moment_ = moment;
  region_.reset();
}

bool PerimeterFire::inside(const Vec2& p) const {
  const GridField& before = distances_[moment_.before];
  if (!before.covers(p)) return false;
  const double a = moment_.part;
  return (1 - a) * before.at(p) + a * distances_[moment_.after].at(p) < 0;
}

const geo::Region& PerimeterFire::region() const {
  return region_.get([&] {
    const auto before = distances_[moment_.before].values();
    const auto after = distances_[moment_.after].values();
    const double a = moment_.part;
    std::vector<double> values(before.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = (1 - a) * before[i] + a * after[i];
    const GridShape& grid = shape();
    return geo::contour(values, grid.rows, grid.columns, grid.low, grid.spacing, 0);
  });
}

double PerimeterFire::arrival_time(const Vec2& p) const {
  if (!distances_.front().covers(p)) return std::numeric_limits<double>::infinity();
  double outside = 0;  // distance to the boundary that does not hold p yet
  for (std::size_t k = 0; k < times_.size(); ++k) {
    const double s = distances_[k].at(p);
    if (s < 0)
      return k == 0
                 ? 0
                 : times_[k - 1] + (times_[k] - times_[k - 1]) * outside / (outside - s);
    outside = s;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace skein::environment
