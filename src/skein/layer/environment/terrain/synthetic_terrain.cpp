// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/terrain/synthetic_terrain.h"

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::environment {

HillTerrain::HillTerrain(const HillTerrainOptions& options) : options_(options) {
  SKEIN_CHECK(options_.width > 0, options_.width);
}

double HillTerrain::elevation_msl(const Vec2& p) const {
  const double r2 = (p - options_.centre).squaredNorm();
  return options_.elevation +
         options_.height * math::exp(-r2 / (2 * options_.width * options_.width));
}

Vec2 HillTerrain::gradient(const Vec2& p) const {
  const double variance = options_.width * options_.width;
  const Vec2 r = p - options_.centre;
  return -options_.height * math::exp(-r.squaredNorm() / (2 * variance)) / variance * r;
}

CanyonTerrain::CanyonTerrain(const CanyonTerrainOptions& options)
    : options_(options),
      along_(geo::unit(options.bearing)),
      across_(geo::turned_right(along_)) {
  SKEIN_CHECK(
      options_.width > 0 && options_.meander_length > 0 && options_.ridge_spacing > 0,
      options_.width, options_.meander_length, options_.ridge_spacing);
}

CanyonTerrain::Shape CanyonTerrain::shape(const Vec2& p) const {
  const CanyonTerrainOptions& o = options_;
  const double s = p.dot(along_), c = p.dot(across_);
  const double bend = 2 * geo::kPi / o.meander_length;
  const double u = c - o.meander * math::sin(bend * s);
  const double u_s = -o.meander * bend * math::cos(bend * s);  // du/ds; du/dc = 1

  const double bell = math::exp(-u * u / (2 * o.width * o.width));
  const double wall = 1 - bell;
  const double wall_u = u / (o.width * o.width) * bell;

  const double side = math::tanh(u / o.width);
  const double wave = 2 * geo::kPi / o.ridge_spacing;
  const double phase = wave * s + side * geo::kPi / 2;
  const double ridge = o.ridge * (1 + math::cos(phase)) / 2;
  const double ridge_phase = -o.ridge * math::sin(phase) / 2;
  const double ridge_u = ridge_phase * (1 - side * side) / o.width * geo::kPi / 2;

  const double by_u = (o.depth + ridge) * wall_u + ridge_u * wall;
  return {o.floor - o.fall * s + (o.depth + ridge) * wall,
          -o.fall + by_u * u_s + ridge_phase * wave * wall, by_u};
}

double CanyonTerrain::elevation_msl(const Vec2& p) const {
  return shape(p).elevation;
}

Vec2 CanyonTerrain::gradient(const Vec2& p) const {
  const Shape at = shape(p);
  return at.along * along_ + at.across * across_;
}

}  // namespace skein::environment
