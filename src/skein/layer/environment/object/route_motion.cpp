// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/object/route_motion.h"

#include <algorithm>
#include <cmath>

namespace skein::environment {

RouteMotion::RouteMotion(const Vec2& begin, const RouteMotionOptions& options)
    : corners_{begin},
      speed_(options.speed),
      repeats_(options.end != RouteEnd::kStay),
      position_(begin) {
  corners_.insert(corners_.end(), options.points.begin(), options.points.end());
  if (options.end == RouteEnd::kBack)
    for (std::size_t k = corners_.size() - 1; k-- > 0;)
      corners_.push_back(Vec2(corners_[k]));
  if (options.end == RouteEnd::kRound) corners_.push_back(begin);
  along_.push_back(0);
  for (std::size_t k = 1; k < corners_.size(); ++k)
    along_.push_back(along_.back() + (corners_[k] - corners_[k - 1]).norm());
}

void RouteMotion::advance(const ObjectView& view) {
  const double length = along_.back();
  double gone = speed_ * view.now.seconds();
  if (repeats_ && length > 0) gone = std::fmod(gone, length);
  if (gone >= length) {
    position_ = corners_.back();
    velocity_ = Vec2::Zero();
    return;
  }
  const auto next = std::upper_bound(along_.begin(), along_.end(), gone);
  const auto k = static_cast<std::size_t>(next - along_.begin());
  const Vec2 direction = (corners_[k] - corners_[k - 1]) / (along_[k] - along_[k - 1]);
  position_ = corners_[k - 1] + (gone - along_[k - 1]) * direction;
  velocity_ = speed_ * direction;
}

}  // namespace skein::environment
