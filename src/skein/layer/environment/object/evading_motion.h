// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/environment/object/random_walk.h"

namespace skein::environment {

struct EvadingMotionOptions {
  RandomWalkOptions walk;  ///< as long as it notices nobody
  double flee_speed = 3;   ///< [m/s]
  double notice = 300;     ///< horizontal distance at which it notices aircraft [m]
  double reaction = 3;     ///< time between two decisions on the run [s]
  double zigzag =
      geo::radians(60);    ///< it runs up to so far aside of straight away [rad]
  double calm_after = 20;  ///< unnoticed for so long it walks again [s]
};

/// Walks at random until an aircraft comes near; then it runs away from the nearest one,
/// in zigzags, until it has noticed none for some time.
class EvadingMotion final : public MovingObject {
 public:
  /// @param begin   at time 0 [m].
  /// @param object  its number: each has a random stream of its own.
  EvadingMotion(const Vec2& begin, const EvadingMotionOptions& options,
                std::uint64_t seed, std::uint32_t object);

  void advance(const ObjectView& view) override;
  Vec2 position() const override { return flees_ ? position_ : walk_.position(); }
  Vec2 velocity() const override { return flees_ ? velocity_ : walk_.velocity(); }

 private:
  void decide(const ObjectView& view);
  std::optional<Vec2> from_nearest(const Vec2& here, const ObjectView& view) const;

  EvadingMotionOptions options_;
  RandomWalk walk_;
  RandomStream random_;
  bool flees_ = false;
  Vec2 position_, velocity_ = Vec2::Zero();  // while it flees
  Time now_, next_decision_, noticed_;
};

}  // namespace skein::environment
