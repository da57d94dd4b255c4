// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <variant>

#include "skein/data/describe/describe.h"
#include "skein/geo/polygon.h"

namespace skein {

/// A circle and what is inside.
struct Disc {
  Vec2 centre = Vec2::Zero();  ///< [m]
  double radius = 0;           ///< [m]
  friend bool operator==(const Disc&, const Disc&) = default;
};

constexpr auto describe(const Disc*) {
  using T = Disc;
  return described<T>({"disc"}, "A circle and what is inside.",
                      field("centre", &T::centre, axes::kPlace, "its middle"),
                      field("radius", &T::radius, unit::kMetre, "its radius"));
}

/// A no-fly zone: what lies above an area, in a range of altitudes and of times.
struct Zone {
  std::variant<geo::Ring, Disc> area =
      {};  ///< a ring is positive and does not cross itself
  double floor_msl = -std::numeric_limits<double>::infinity();   ///< lowest altitude [m]
  double ceiling_msl = std::numeric_limits<double>::infinity();  ///< highest altitude [m]
  double from = -std::numeric_limits<double>::infinity();        ///< forbidden since [s]
  double until = std::numeric_limits<double>::infinity();        ///< forbidden until [s]
  std::string name = {};  ///< for people; may be empty
  friend bool operator==(const Zone&, const Zone&) = default;
};

constexpr auto describe(const Zone*) {
  using T = Zone;
  return described<T>(
      {"zone"}, "A no-fly zone.", field("name", &T::name, "for people"),
      field("area", &T::area, Storage::kJson, "a ring of corners or a disc"),
      field("floor_msl", &T::floor_msl, unit::kMetre, "lowest altitude; null: no limit"),
      field("ceiling_msl", &T::ceiling_msl, unit::kMetre,
            "highest altitude; null: no limit"),
      field("from", &T::from, unit::kSecond, "forbidden since; null: always"),
      field("until", &T::until, unit::kSecond, "forbidden until; null: for ever"));
}

/// Whether a place on the map lies over or under the zone, whatever altitude and time.
bool covers(const Zone& zone, const Vec2& p);

/// Whether a zone forbids an altitude [m] at a time [s], somewhere.
constexpr bool holds_at(const Zone& zone, double altitude_msl, double time) {
  return altitude_msl >= zone.floor_msl && altitude_msl <= zone.ceiling_msl &&
         time >= zone.from && time <= zone.until;
}

/// Whether a zone forbids some altitude from `lowest` to `highest` [m] at some time from
/// `from` to `until` [s].
constexpr bool concerns(const Zone& zone, double lowest, double highest, double from,
                        double until) {
  return highest >= zone.floor_msl && lowest <= zone.ceiling_msl && until >= zone.from &&
         from <= zone.until;
}

/// A zone has at most this many corners: looking for crossings is quadratic.
inline constexpr std::size_t kMaxCorners = 2000;

/// What is wrong with a zone, for people; none when it can be used. Wrong are: numbers
/// that are not finite (floor, ceiling and times may be infinite), fewer than 3 or more
/// than kMaxCorners corners, no area, sides that cross (and where), a radius of 0 or
/// less, a floor that is not below the ceiling, an end that is not after the start.
/// A ring that runs in the opposite sense is none of these: see made_positive().
std::optional<std::string> error_in(const Zone& zone);

/// The same ring, reversed when it is negative.
geo::Ring made_positive(geo::Ring ring);

/// The zone's area as a positive ring. A disc becomes a polygon around it, nowhere more
/// than `tolerance` [m] outside of it, with 8 to 512 corners.
geo::Ring outline(const Zone& zone, double tolerance = 0.5);

}  // namespace skein
