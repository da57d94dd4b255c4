// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "skein/role/moving_object.h"

namespace skein::environment {

/// What comes after the last point of a route.
enum class RouteEnd : std::uint8_t { kStay, kBack, kRound };

struct RouteMotionOptions {
  std::vector<Vec2> points;  ///< after the begin, one at least [m]
  double speed = 1.4;        ///< [m/s]
  RouteEnd end = RouteEnd::kStay;
};

/// Moves along a route at an even speed.
class RouteMotion final : public MovingObject {
 public:
  /// @param begin  at time 0 [m].
  RouteMotion(const Vec2& begin, const RouteMotionOptions& options);

  void advance(const ObjectView& view) override;
  Vec2 position() const override { return position_; }
  Vec2 velocity() const override { return velocity_; }

 private:
  std::vector<Vec2> corners_;  // of the route until it repeats
  std::vector<double> along_;  // distance of each corner from the first [m]
  double speed_;
  bool repeats_;
  Vec2 position_, velocity_ = Vec2::Zero();
};

}  // namespace skein::environment
