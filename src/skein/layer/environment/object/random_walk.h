// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/base/random.h"
#include "skein/role/moving_object.h"

namespace skein::environment {

struct RandomWalkOptions {
  double speed = 1.4;            ///< [m/s]
  double mean_leg = 60;          ///< time between two changes of direction, mean [s]
  std::optional<double> radius;  ///< it stays about so near to its begin [m]; none: free
};

/// Walks straight on for times that are distributed exponentially, each time in a new
/// direction, uniform over all. Beyond its radius it turns to where it began, up to a
/// quarter turn aside.
class RandomWalk final : public MovingObject {
 public:
  /// @param begin   at time 0 [m].
  /// @param object  its number: each has a random stream of its own.
  RandomWalk(const Vec2& begin, const RandomWalkOptions& options, std::uint64_t seed,
             std::uint32_t object);

  void advance(const ObjectView& view) override;
  Vec2 position() const override { return position_; }
  Vec2 velocity() const override { return velocity_; }

  /// Chooses a new direction now.
  void turn();

  /// Moves to a place by other means than walking.
  void put(const Vec2& place, Time now);

 private:
  RandomWalkOptions options_;
  RandomStream random_;
  Vec2 home_, position_, velocity_ = Vec2::Zero();
  Time now_, leg_end_;
  bool begun_ = false;
};

}  // namespace skein::environment
