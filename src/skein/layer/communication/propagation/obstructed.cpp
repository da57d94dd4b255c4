// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/propagation/obstructed.h"

#include <utility>

#include "skein/base/math.h"

namespace skein::communication {
namespace {

std::pair<Vec2, Vec2> rectangle_around(const Obstacle& obstacle) {
  if (const auto* disc = std::get_if<Disc>(&obstacle.area)) {
    const Vec2 reach(disc->radius, disc->radius);
    return {disc->centre - reach, disc->centre + reach};
  }
  const auto& ring = std::get<geo::Ring>(obstacle.area);
  Vec2 low = ring.front(), high = low;
  for (const Vec2& corner : ring) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  return {low, high};
}

}  // namespace

Obstructed::Obstructed(std::unique_ptr<Propagation> open, std::vector<Obstacle> obstacles)
    : open_(std::move(open)) {
  for (Obstacle& each : obstacles) {
    const auto [low, high] = rectangle_around(each);
    const double factor = math::pow(10, -each.attenuation_db / 10);
    bodies_.push_back({std::move(each), low, high, factor});
  }
}

double Obstructed::received(double radiated, const Vec3& from, const Vec3& to) const {
  double power = open_->received(radiated, from, to);
  const Vec2 low = geo::horizontal(from).cwiseMin(geo::horizontal(to));
  const Vec2 high = geo::horizontal(from).cwiseMax(geo::horizontal(to));
  for (const Body& body : bodies_) {
    if ((low.array() > body.high.array()).any() ||
        (high.array() < body.low.array()).any())
      continue;
    if (is_crossed(body.obstacle, from, to)) power *= body.factor;
  }
  return power;
}

}  // namespace skein::communication
