// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/object/evading_motion.h"

#include "skein/base/math.h"

namespace skein::environment {

EvadingMotion::EvadingMotion(const Vec2& begin, const EvadingMotionOptions& options,
                             std::uint64_t seed, std::uint32_t object)
    : options_(options),
      walk_(begin, options.walk, seed, object),
      random_(seed, object, Purpose::kObject, 1),
      position_(begin) {}

void EvadingMotion::advance(const ObjectView& view) {
  if (flees_)
    position_ += (view.now - now_).seconds() * velocity_;
  else
    walk_.advance(view);
  now_ = view.now;
  if (now_ >= next_decision_) decide(view);
}

void EvadingMotion::decide(const ObjectView& view) {
  next_decision_ = view.now + Time::from_seconds(options_.reaction);
  const Vec2 here = position();
  if (const auto away = from_nearest(here, view)) {
    const double direction = math::atan2(away->y(), away->x()) +
                             random_.uniform(-options_.zigzag, options_.zigzag);
    position_ = here;
    velocity_ = options_.flee_speed * Vec2(math::cos(direction), math::sin(direction));
    flees_ = true;
    noticed_ = view.now;
  } else if (flees_ && (view.now - noticed_).seconds() > options_.calm_after) {
    walk_.put(here, view.now);
    walk_.turn();
    flees_ = false;
  }
}

std::optional<Vec2> EvadingMotion::from_nearest(const Vec2& here,
                                                const ObjectView& view) const {
  std::optional<Vec2> away;
  double nearest = options_.notice;
  for (const Vec3& aircraft : view.aircraft) {
    const Vec2 apart = here - geo::horizontal(aircraft);
    if (apart.norm() >= nearest) continue;
    nearest = apart.norm();
    away = apart;
  }
  return away;
}

}  // namespace skein::environment
