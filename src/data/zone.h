#pragma once

#include <limits>
#include <string>
#include <variant>

#include "geo/polygon.h"

namespace skein {

/// A circle and what is inside.
struct Disc {
  Vec2 centre = Vec2::Zero();  ///< [m]
  double radius = 0;           ///< [m]
};

/// A no-flight zone: what lies above an area, in a range of altitudes and of times.
struct Zone {
  std::variant<geo::Ring, Disc> area;  ///< a ring is positive and does not cross itself
  double floor_msl = -std::numeric_limits<double>::infinity();   ///< lowest altitude [m]
  double ceiling_msl = std::numeric_limits<double>::infinity();  ///< highest altitude [m]
  double from = -std::numeric_limits<double>::infinity();        ///< forbidden since [s]
  double until = std::numeric_limits<double>::infinity();        ///< forbidden until [s]
  std::string name = {};  ///< for people; may be empty
};

/// Whether a place on the map lies over or under the zone, whatever altitude and time.
bool covers(const Zone& zone, const Vec2& p);

/// Whether a zone forbids an altitude [m] at a time [s], somewhere.
constexpr bool holds_at(const Zone& zone, double altitude_msl, double time) {
  return altitude_msl >= zone.floor_msl && altitude_msl <= zone.ceiling_msl &&
         time >= zone.from && time <= zone.until;
}

/// The zone's area as a positive ring. A disc becomes a polygon around it, nowhere more
/// than `tolerance` [m] outside of it, with 8 to 512 corners.
geo::Ring outline(const Zone& zone, double tolerance = 0.5);

}  // namespace skein
