// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/time.h"
#include "skein/data/describe/describe.h"
#include "skein/data/team/task_needs.h"
#include "skein/data/vehicle/flight_plan.h"
#include "skein/geo/polygon.h"

// What an aircraft may be asked to do: a value for each kind of task that messages have a
// type for, and one for all others. New kinds need none: docs/guide/task.md.

namespace skein {

/// Fly to a point and through it.
struct FlyTo {
  Vec2 point = Vec2::Zero();  ///< [m]
  /// Reached evenly until there [m]; none: the aircraft's height above the ground.
  std::optional<double> altitude_msl = std::nullopt;
};

constexpr auto describe(const FlyTo*) {
  using T = FlyTo;
  return described<T>({"fly_to"}, "Fly to a point and through it.",
                      field("", &T::point, axes::kPlace, "the point"),
                      field("altitude_msl", &T::altitude_msl, unit::kMetre,
                            "reached evenly until there; null: the height over ground "
                            "that the aircraft flies at"));
}

/// Follow the real edge of the fire with the in/out sensor.
struct FollowEdge {
  bool clockwise = true;      ///< around the fire, on the map
  Vec2 start = Vec2::Zero();  ///< where to look for the edge first [m]
  /// Believed direction of the edge there, fire on its right in either sense; 0 =
  /// unknown.
  Vec2 tangent = Vec2::Zero();
  double angle = 0;  ///< between course and edge [rad]; 0 = the agent's own
};

constexpr auto describe(const FollowEdge*) {
  using T = FollowEdge;
  return described<T>(
      {"follow_edge"}, "Follow the real edge of the fire with the in/out sensor.",
      field("clockwise", &T::clockwise, "around the fire, on the map"),
      field("", &T::start, axes::kPlace, "where to look for the edge first"),
      field("tangent", &T::tangent, axes::kDirection,
            "believed direction of the edge there; 0: not known"),
      field("angle", &T::angle, unit::kDegree,
            "between course and edge; 0: the agent's own"));
}

/// Follow a line of points, once.
struct FollowLine {
  std::vector<Vec2> points;  ///< [m]
};

constexpr auto describe(const FollowLine*) {
  using T = FollowLine;
  return described<T>({"follow_line"}, "Follow a line of points, once.",
                      field("points", &T::points, Storage::kJson, "of the line"));
}

/// Fly a fixed course (a transect).
struct FlyCourse {
  double course = 0;  ///< [rad]
};

constexpr auto describe(const FlyCourse*) {
  using T = FlyCourse;
  return described<T>({"fly_course"}, "Fly a fixed course.",
                      field("course", &T::course, unit::kDegree, "over ground"));
}

/// Circle a point until further notice.
struct Loiter {
  Vec2 centre = Vec2::Zero();
};

constexpr auto describe(const Loiter*) {
  using T = Loiter;
  return described<T>({"loiter"}, "Circle a point until another order comes.",
                      field("", &T::centre, axes::kPlace, "the point"));
}

/// Fly through points, lap after lap.
struct FlyRoute {
  std::vector<Vec2> points;  ///< [m]
  int laps = 1;
  std::vector<EntityId> report_to;  ///< who gets the own position directly, each second
};

constexpr auto describe(const FlyRoute*) {
  using T = FlyRoute;
  return described<T>({"fly_route"}, "Fly through points, lap after lap.",
                      field("points", &T::points, Storage::kJson, "of the route"),
                      field("laps", &T::laps, "times around"),
                      field("report_to", &T::report_to, Storage::kJson,
                            "who gets the own position directly, each second"));
}

/// Stay at a place that moves with another aircraft.
struct FollowLeader {
  EntityId leader;
  Vec2 offset = Vec2::Zero();  ///< ahead of the leader and to its right [m]
};

constexpr auto describe(const FollowLeader*) {
  using T = FollowLeader;
  return described<T>(
      {"follow_leader"}, "Stay at a place that moves with another aircraft.",
      field("leader_id", &T::leader, "whom to follow"),
      field("", &T::offset, axes::kFormation, "ahead of the leader and to its right"));
}

/// Fly through points on turns and straights that are planned for the wind, lap after
/// lap, across the bisector of each corner.
struct FlyTour {
  std::vector<Vec2> points;  ///< two at least [m]
  int laps = 1;
};

constexpr auto describe(const FlyTour*) {
  using T = FlyTour;
  return described<T>({"fly_tour"},
                      "Fly through points on curves planned for the wind, lap after lap.",
                      field("points", &T::points, Storage::kJson, "of the tour"),
                      field("laps", &T::laps, "times around"));
}

/// Stay where the aircraft is.
struct Hold {};

constexpr auto describe(const Hold*) {
  return described<Hold>({"hold"}, "Stay where the aircraft is when the order comes.");
}

/// See all of an area.
struct Survey {
  geo::Ring area;                ///< either direction; does not cross itself [m]
  std::vector<geo::Ring> holes;  ///< not to be seen, but may be flown over [m]
  double swath = 100;            ///< width that is seen, half on either side [m]
  double overlap = 0;            ///< share of it that neighbouring lines have in common
  /// Where each line begins and ends, in the order in which they are flown: what is left
  /// to be seen of the area. Empty: all of it, planned by the aircraft itself.
  std::vector<Vec2> lines;
};

constexpr auto describe(const Survey*) {
  using T = Survey;
  return described<T>(
      {"survey"}, "See all of an area.",
      field("area", &T::area, Storage::kJson, "its corners"),
      field("holes", &T::holes, Storage::kJson, "not to be seen, may be flown over"),
      field("swath", &T::swath, unit::kMetre, "width that is seen"),
      field("overlap", &T::overlap, "of it, that neighbouring lines have in common"),
      field("lines", &T::lines, Storage::kJson,
            "begin and end of each line that is left; empty: all, as it finds best"));
}

/// Fly along a line again and again.
struct Patrol {
  std::vector<Vec2> line;  ///< two points or more [m]
  bool closed = false;     ///< around, instead of there and back
  double offset = 0;       ///< of the flight, to the right of the line as drawn [m]
  int rounds = 0;          ///< there and back, or around; 0: until another order
};

constexpr auto describe(const Patrol*) {
  using T = Patrol;
  return described<T>(
      {"patrol"}, "Fly along a line again and again.",
      field("line", &T::line, Storage::kJson, "its points"),
      field("closed", &T::closed, "around, instead of there and back"),
      field("offset", &T::offset, unit::kMetre, "to the right of the line"),
      field("rounds", &T::rounds, "there and back, or around; 0: until another order"));
}

/// Stay with a point or an object on the ground and look at it.
struct Orbit {
  Vec2 point = Vec2::Zero();  ///< where it is, or was seen last [m]
  /// Which object it is about, as cameras number them; none: the point.
  std::optional<std::uint32_t> object = {};
  double radius = 0;    ///< of the circle [m]; 0: as small as the aircraft can
  bool weave = false;   ///< S-turns along its track instead of a circle
  double duration = 0;  ///< with it [s]; 0: until another order
};

constexpr auto describe(const Orbit*) {
  using T = Orbit;
  return described<T>(
      {"orbit"}, "Stay with a point or an object on the ground and look at it.",
      field("", &T::point, axes::kPlace, "where it is, or was seen last"),
      field("object", &T::object, "which object, as cameras number them; null: none"),
      field("radius", &T::radius, unit::kMetre, "of the circle; 0: the smallest"),
      field("weave", &T::weave, "S-turns along its track instead of a circle"),
      field("duration", &T::duration, unit::kSecond, "with it; 0: until another order"));
}

/// Fly to a point, stay there for a time and report what is sensed there.
struct Measure {
  Vec2 point = Vec2::Zero();  ///< [m]
  double stay = 30;           ///< near it [s]
};

constexpr auto describe(const Measure*) {
  using T = Measure;
  return described<T>({"measure"}, "Fly to a point, stay there for a time and report.",
                      field("", &T::point, axes::kPlace, "the point"),
                      field("stay", &T::stay, unit::kSecond, "near it"));
}

/// Be at a point at a time, and stay there.
struct Rendezvous {
  Vec2 point = Vec2::Zero();          ///< [m]
  Time time;                          ///< of the run, when to be there
  std::optional<double> course = {};  ///< over ground there [rad]; none: any
};

constexpr auto describe(const Rendezvous*) {
  using T = Rendezvous;
  return described<T>(
      {"rendezvous"}, "Be at a point at a time, and stay there.",
      field("", &T::point, axes::kPlace, "the point"),
      field("time", &T::time, "of the run, when to be there"),
      field("course", &T::course, unit::kDegree, "over ground there; null: any"));
}

/// Stay between two others, so that they receive each other.
struct Relay {
  EntityId first, second;  ///< aircraft or ground station
};

constexpr auto describe(const Relay*) {
  using T = Relay;
  return described<T>({"relay"},
                      "Stay between two others, so that they receive each other.",
                      field("first_id", &T::first, "aircraft or ground station"),
                      field("second_id", &T::second, "the other"));
}

/// Fly a plan as it is.
struct FlyPlan {
  FlightPlan plan;
  /// It begins when the aircraft gets to its start, whatever times it has; else it is
  /// flown in time.
  bool any_time = true;
};

constexpr auto describe(const FlyPlan*) {
  using T = FlyPlan;
  return described<T>({"fly_plan"}, "Fly a plan of turns and straights as it is.",
                      field("plan", &T::plan, Storage::kJson, "its elements"),
                      field("any_time", &T::any_time,
                            "begun when the aircraft is at its start; else in time"));
}

/// Fly home and stay above.
struct ReturnHome {};

constexpr auto describe(const ReturnHome*) {
  return described<ReturnHome>({"return"}, "Fly home and stay above.");
}

/// Land.
struct LandAt {
  bool at_home = true;        ///< where the flight began, whatever `place` says
  Vec2 place = Vec2::Zero();  ///< [m]
};

constexpr auto describe(const LandAt*) {
  using T = LandAt;
  return described<T>({"land"}, "Land.",
                      field("at_home", &T::at_home, "where the flight began"),
                      field("", &T::place, axes::kPlace, "else here"));
}

/// A task of a kind that messages have no type for, by its name: what others need to know
/// of it stands beside its values, which only who knows the kind can read
/// (task_value.h).
struct NamedTask {
  std::string kind;
  std::vector<EntityId> others;  ///< whom it is about, in the order of its values
  TaskNeeds needs;
  std::vector<std::uint8_t> coded;  ///< its values, as wire::encode() makes them
};

constexpr auto describe(const NamedTask*) {
  using T = NamedTask;
  return described<T>({"named"}, "A task of a kind that messages know by its name only.",
                      field("task_kind", &T::kind, "which kind"),
                      field("others", &T::others, Storage::kJson, "whom it is about"),
                      field("", &T::needs, "where it is, and what it takes"),
                      field("coded", &T::coded, Storage::kBytes, "its values, coded"));
}

}  // namespace skein
