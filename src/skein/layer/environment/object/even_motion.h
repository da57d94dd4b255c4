// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/role/moving_object.h"

namespace skein::environment {

/// Stands, or moves evenly.
class EvenMotion final : public MovingObject {
 public:
  /// @param begin     at time 0 [m].
  /// @param velocity  [m/s].
  EvenMotion(const Vec2& begin, const Vec2& velocity)
      : begin_(begin), velocity_(velocity) {}

  void advance(const ObjectView& view) override;
  Vec2 position() const override;
  Vec2 velocity() const override { return velocity_; }

 private:
  Vec2 begin_, velocity_;
  Time now_;
};

}  // namespace skein::environment
