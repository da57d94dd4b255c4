// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "skein/layer/communication/propagation/obstacle.h"
#include "skein/scenario/fields.h"

namespace skein::assemble {

/// An obstacle between radios as it is written.
struct ObstacleSection {
  std::optional<geo::Ring> ring;
  std::optional<Vec2> centre, size;
  std::optional<double> radius;
  double base_msl = 0, top_msl = 0;
  std::string attenuation_db = "opaque";  // or a number
};

/// A list has at most so many: each link asks each of them.
inline constexpr std::size_t kMaxObstacles = 1000;

scenario::Fields<ObstacleSection> obstacle_fields();

/// Of a section without errors.
communication::Obstacle obstacle_of(const ObstacleSection& section);
/// Reading what is written gives the same obstacle; boxes are written as rings.
ObstacleSection section_of(const communication::Obstacle& obstacle);

}  // namespace skein::assemble
