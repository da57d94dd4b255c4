// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/geo/polygon.h"
#include "skein/geo/vec.h"

namespace skein {

/// "At `time` the ground at `point` was (not) burning", as an agent believes it: the
/// point comes from the aircraft's estimated position.
struct FireReading {
  Time time;
  EntityId aircraft;
  Vec2 point = Vec2::Zero();  ///< [m]
  double point_sd = 0;        ///< of the point, per axis [m]
  bool inside = false;
};

constexpr auto describe(const FireReading*) {
  using T = FireReading;
  return described<T>(
      {"reading", "readings"},
      "One look of an in/out fire sensor, placed where the aircraft believes it.",
      field("time", &T::time, "when it was measured"),
      field("entity_id", &T::aircraft, "whose sensor"),
      field("", &T::point, axes::kPlace, "the point looked at"),
      field("position_sd", &T::point_sd, unit::kMetre, "of the point, per axis"),
      field("inside", &T::inside, "it burns"));
}

/// Two successive readings of one aircraft that differ: the boundary passed between them.
struct Crossing {
  Time time;  ///< of the later reading
  EntityId aircraft;
  Vec2 point = Vec2::Zero();  ///< middle of the two readings [m]
  Vec2 track = Vec2::Zero();  ///< from the earlier to the later point [m]
  double point_sd = 0;        ///< of the position, per axis [m]
  bool entered = false;       ///< the later reading is inside
};

constexpr auto describe(const Crossing*) {
  using T = Crossing;
  return described<T>(
      {"crossing", "crossings"},
      "Two successive readings of one aircraft that differ, as the agent found that "
      "keeps "
      "the belief. Not in order of time where readings came late.",
      field("time", &T::time, "of the later reading"),
      field("entity_id", &T::aircraft, "who crossed the boundary"),
      field("", &T::point, axes::kPlace, "middle of the two readings"),
      field("position_sd", &T::point_sd, unit::kMetre, "of the place, per axis"),
      field("entered", &T::entered, "the later reading is inside"),
      field("track", &T::track, axes::kOffset, "from the earlier to the later reading"));
}

/// One point of a believed boundary.
struct BoundaryPoint {
  Vec2 position = Vec2::Zero();  ///< [m]
  Vec2 normal = Vec2::Zero();    ///< outward unit normal
  double sigma = 0;              ///< standard deviation along the normal [m]
  double sigma_growth = 0;       ///< d sigma/dt while nothing is observed [m/s]
  double rate = 0;               ///< believed speed along the normal [m/s]
  /// Major semi-axis of the 1-sigma ellipse of the position [m]; zero where only the
  /// uncertainty along the normal is known.
  Vec2 major_axis = Vec2::Zero();
};

constexpr auto describe(const BoundaryPoint*) {
  using T = BoundaryPoint;
  return described<T>(
      {"boundary_point"}, "One point of a believed boundary.",
      field("", &T::position, axes::kPlace, "where"),
      field("normal", &T::normal, axes::kDirection, "outward unit normal"),
      field("sigma", &T::sigma, unit::kMetre, "standard deviation along the normal"),
      field("sigma_growth", &T::sigma_growth, unit::kMetrePerSecond,
            "of sigma while nothing is observed"),
      field("rate", &T::rate, unit::kMetrePerSecond, "believed speed along the normal"),
      field("major_axis", &T::major_axis, axes::kOffset,
            "major semi-axis of the 1-sigma ellipse; 0 where it is not known"));
}

/// A believed boundary: closed rings of points, outer ones positive (see geo/polygon.h).
struct BoundaryEstimate {
  Time time;
  std::vector<std::vector<BoundaryPoint>> rings;
};

constexpr auto describe(const BoundaryEstimate*) {
  using T = BoundaryEstimate;
  return described<T>({"boundary"}, "A believed boundary.",
                      field("time", &T::time, "that it is of"),
                      field("rings", &T::rings, Storage::kFloats,
                            "closed; outer ones run clockwise on the map"));
}

/// The rings of a boundary that enclose something: three points or more.
inline geo::Region rings_of(const BoundaryEstimate& boundary) {
  geo::Region region;
  region.reserve(boundary.rings.size());
  for (const auto& points : boundary.rings) {
    if (points.size() < 3) continue;
    geo::Ring& ring = region.emplace_back();
    ring.reserve(points.size());
    for (const BoundaryPoint& point : points) ring.push_back(point.position);
  }
  return region;
}

/// What a mission believes about a boundary.
struct PerimeterBelief {
  BoundaryEstimate boundary;
  std::uint32_t phenomenon = 0;  ///< whose boundary: its place in the environment's list
  std::string mission = {};      ///< its name
};

/// Where a boundary is believed to be at a later time, if nothing more is observed.
struct PerimeterForecast {
  Time made;
  BoundaryEstimate boundary;     ///< of the time that it is for
  std::uint32_t phenomenon = 0;  ///< whose boundary: its place in the environment's list
  std::string mission = {};      ///< its name
};

constexpr auto describe(const PerimeterForecast*) {
  using T = PerimeterForecast;
  return described<T>({"perimeter_forecast"},
                      "Where a boundary is believed to be at a later time.",
                      field("made", &T::made, "when"),
                      field("boundary", &T::boundary, "as believed for its time"),
                      field("phenomenon", &T::phenomenon, "whose boundary"),
                      field("mission", &T::mission, "whose belief"));
}

/// Probability that a boundary has reached a place by a time.
struct ArrivalStep {
  Time time;
  double probability = 0;
};

constexpr auto describe(const ArrivalStep*) {
  using T = ArrivalStep;
  return described<T>({"arrival_step"}, "Probability that a boundary has come by a time.",
                      field("time", &T::time, "by when"),
                      field("probability", &T::probability, "that it has come"));
}

/// When a boundary is believed to reach a place.
struct ArrivalForecast {
  Time made;
  std::string place;                               ///< its name
  Vec2 point = Vec2::Zero();                       ///< where it is [m]
  std::optional<double> early, middle, late = {};  ///< by then with 10, 50, 90 % [s]
  std::vector<ArrivalStep> steps;                  ///< its distribution; both grow
  std::uint32_t phenomenon = 0;  ///< whose boundary: its place in the environment's list
  std::string mission = {};      ///< its name
};

constexpr auto describe(const ArrivalForecast*) {
  using T = ArrivalForecast;
  return described<T>(
      {"arrival_forecast"}, "When a boundary is believed to reach a place.",
      field("made", &T::made, "when it was said"), field("place", &T::place, "its name"),
      field("", &T::point, axes::kPlace, "where it is"),
      field("early", &T::early, unit::kSecond,
            "by then with 10 %; null: not within the horizons"),
      field("middle", &T::middle, unit::kSecond, "the same with 50 %"),
      field("late", &T::late, unit::kSecond, "the same with 90 %"),
      field("steps", &T::steps, Storage::kJson, "the distribution"),
      field("phenomenon", &T::phenomenon, "whose boundary"),
      field("mission", &T::mission, "whose belief"));
}

/// What is known of a fire before the first observation.
struct PerimeterPrior {
  Vec2 origin = Vec2::Zero();  ///< believed origin of the fire [m]
  double radius = 500;         ///< believed distance of the boundary at the start [m]
  double radius_sd = 104;      ///< of the boundary at the start [m]
  double rate = 3;             ///< believed spread [m/s]
  double rate_sd = 0.058;      ///< of the spread [m/s]
  Vec2 wind = Vec2::Zero();    ///< believed drift of the boundary [m/s]
  double wind_sd = 1;          ///< per axis, of the drift that is not known [m/s]
};

}  // namespace skein
