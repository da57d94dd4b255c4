// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/object/random_walk.h"

#include <algorithm>

#include "skein/base/math.h"

namespace skein::environment {
namespace {

constexpr double kMinLeg = 1;  // [s]

}  // namespace

RandomWalk::RandomWalk(const Vec2& begin, const RandomWalkOptions& options,
                       std::uint64_t seed, std::uint32_t object)
    : options_(options),
      random_(seed, object, Purpose::kObject),
      home_(begin),
      position_(begin) {}

void RandomWalk::turn() {
  const Vec2 home = home_ - position_;
  double direction = random_.uniform(-geo::kPi, geo::kPi);
  if (options_.radius && home.norm() > *options_.radius)
    direction = math::atan2(home.y(), home.x()) + direction / 2;
  velocity_ = options_.speed * Vec2(math::cos(direction), math::sin(direction));
  const double leg = -options_.mean_leg * math::log(1 - random_.uniform());
  leg_end_ = now_ + Time::from_seconds(std::max(leg, kMinLeg));
}

void RandomWalk::put(const Vec2& place, Time now) {
  position_ = place;
  now_ = now;
}

void RandomWalk::advance(const ObjectView& view) {
  if (!begun_) turn();
  begun_ = true;
  for (;;) {
    const Time until = std::min(view.now, leg_end_);
    position_ += (until - now_).seconds() * velocity_;
    now_ = until;
    if (now_ == view.now) return;
    turn();
  }
}

}  // namespace skein::environment
