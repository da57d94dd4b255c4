// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/recorded/arrival_fire.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/base/check.h"
#include "skein/geo/contour.h"

namespace skein::environment {

ArrivalFire::ArrivalFire(GridField arrival, double start)
    : arrival_(std::move(arrival)), start_(start), last_(start), level_(start) {
  for (const double t : arrival_.values())
    if (std::isfinite(t)) last_ = std::max(last_, t);
}

void ArrivalFire::advance(Time time) {
  SKEIN_CHECK(time >= now_, time.seconds(), now_.seconds());
  now_ = time;
  // Past the last arrival nothing changes; just above it, so that its nodes burn too.
  const double level =
      std::min(start_ + time.seconds(),
               std::nextafter(last_, std::numeric_limits<double>::infinity()));
  if (level == level_) return;
  level_ = level;
  region_.reset();
}

bool ArrivalFire::inside(const Vec2& p) const {
  if (!arrival_.covers(p)) return false;
  const GridShape& shape = arrival_.shape();
  const Vec2 q = (p - shape.low) / shape.spacing;
  const int r = std::clamp(static_cast<int>(q.x()), 0, shape.rows - 2);
  const int c = std::clamp(static_cast<int>(q.y()), 0, shape.columns - 2);
  const bool known = std::isfinite(arrival_.value(r, c)) &&
                     std::isfinite(arrival_.value(r + 1, c)) &&
                     std::isfinite(arrival_.value(r, c + 1)) &&
                     std::isfinite(arrival_.value(r + 1, c + 1));
  if (known) return arrival_.at(p) < level_;
  return arrival_.value(r + (q.x() - r > 0.5 ? 1 : 0), c + (q.y() - c > 0.5 ? 1 : 0)) <
         level_;
}

const geo::Region& ArrivalFire::region() const {
  return region_.get([&] {
    const GridShape& grid = arrival_.shape();
    return geo::contour(arrival_.values(), grid.rows, grid.columns, grid.low,
                        grid.spacing, level_);
  });
}

}  // namespace skein::environment
