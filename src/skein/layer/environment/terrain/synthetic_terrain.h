// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "skein/role/terrain.h"

namespace skein::environment {

struct FlatTerrainOptions {
  double elevation = 0;  ///< above mean sea level [m]
};

/// Level ground.
class FlatTerrain final : public Terrain {
 public:
  explicit FlatTerrain(const FlatTerrainOptions& options) : options_(options) {}
  double elevation_msl(const Vec2&) const override { return options_.elevation; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
  double highest_msl() const override { return options_.elevation; }

 private:
  FlatTerrainOptions options_;
};

struct HillTerrainOptions {
  double elevation = 0;        ///< of the plain, above mean sea level [m]
  double height = 100;         ///< of the top above the plain [m]; negative: a hollow
  double width = 300;          ///< distance from the top to where it is steepest [m]
  Vec2 centre = Vec2::Zero();  ///< of the top [m]
};

/// One hill on a plain: elevation + height exp(-r^2 / (2 width^2)).
class HillTerrain final : public Terrain {
 public:
  /// Fails: Bug when the width is not above 0.
  explicit HillTerrain(const HillTerrainOptions& options);
  double elevation_msl(const Vec2& p) const override;
  Vec2 gradient(const Vec2& p) const override;
  double highest_msl() const override {
    return options_.elevation + std::max(0.0, options_.height);
  }

 private:
  HillTerrainOptions options_;
};

struct CanyonTerrainOptions {
  double floor = 250;  ///< of the river at the origin, above mean sea level [m]
  double depth = 320;  ///< from the river to the plateau [m]
  double width = 350;  ///< from the river to where the walls are steepest [m]
  double bearing = geo::radians(57);  ///< towards where the river flows [rad, from north]
  double fall = 0.01;                 ///< of the river, per metre of its course
  double meander = 180;               ///< of the river to either side [m]
  double meander_length = 3500;       ///< between two bends to the same side [m]
  double ridge = 110;          ///< of the side ridges above the ravines between [m]
  double ridge_spacing = 800;  ///< between two ridges on one side [m]
};

/// A winding river canyon with side ridges and ravines, smooth and in closed form.
///
///   s, c   distance along `bearing` and to its right
///   u    = c - meander sin(2 pi s / meander_length)          (from the river)
///   W    = 1 - exp(-u^2 / (2 width^2))                       (the walls)
///   R    = (1 + cos(2 pi s / ridge_spacing + tanh(u/width) pi/2)) / 2
///   elevation = floor - fall s + (depth + ridge R) W
///
/// The steepest wall has a slope near 0.61 (depth + ridge) / width; the defaults reach
/// some 35 degrees. Ridges of one side face ravines of the other.
class CanyonTerrain final : public Terrain {
 public:
  /// Fails: Bug when a length is not above 0.
  explicit CanyonTerrain(const CanyonTerrainOptions& options);
  double elevation_msl(const Vec2& p) const override;
  Vec2 gradient(const Vec2& p) const override;

 private:
  struct Shape {
    double elevation, along, across;  // with the derivatives along s and c
  };
  Shape shape(const Vec2& p) const;

  CanyonTerrainOptions options_;
  Vec2 along_, across_;
};

}  // namespace skein::environment
