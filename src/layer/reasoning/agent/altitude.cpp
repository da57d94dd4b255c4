#include "layer/reasoning/agent/altitude.h"

#include <algorithm>

namespace skein::reasoning {
namespace {

constexpr double kNear = 6;     // flight in every direction [s]
constexpr double kFar = 45;     // flight straight ahead [s]
constexpr double kFarStep = 3;  // [s]; 60 m at 20 m/s, about the cells of terrain data
constexpr double kClimbReserve = 0.8;  // part of the climb rate that is counted on

}  // namespace

double altitude_over(const Terrain& ground, const Vec2& position, const Vec2& velocity,
                     double height, double climb_rate) {
  double highest = ground.elevation_msl(position);
  for (const double turn : {-1.2, -0.6, 0.0, 0.6, 1.2}) {
    const Vec2 v = velocity.norm() * geo::unit(geo::bearing(velocity) + turn);
    for (double t = kNear / 3; t <= kNear; t += kNear / 3)
      highest = std::max(highest, ground.elevation_msl(position + t * v));
  }
  for (double t = kNear + kFarStep; t <= kFar; t += kFarStep) {
    const double climbed = kClimbReserve * climb_rate * t;
    highest = std::max(highest, ground.elevation_msl(position + t * velocity) - climbed);
  }
  return highest + height;
}

}  // namespace skein::reasoning
