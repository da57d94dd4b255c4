// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "skein/layer/communication/propagation/obstacle.h"
#include "skein/role/propagation.h"

namespace skein::communication {

/// Another propagation with obstacles: each that the straight line between two places
/// passes through takes its decibels, an opaque one all. Around them nothing bends.
class Obstructed final : public Propagation {
 public:
  Obstructed(std::unique_ptr<Propagation> open, std::vector<Obstacle> obstacles);
  double received(double radiated, const Vec3& from, const Vec3& to) const override;

 private:
  struct Body {
    Obstacle obstacle;
    Vec2 low, high;  // corners of the rectangle around it
    double factor;   // of the power that passes
  };
  std::unique_ptr<Propagation> open_;
  std::vector<Body> bodies_;
};

}  // namespace skein::communication
