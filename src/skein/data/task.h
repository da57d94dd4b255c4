#pragma once

#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

#include "skein/base/id.h"
#include "skein/data/describe.h"
#include "skein/geo/vec.h"

namespace skein {

/// Fly to a point and through it.
struct FlyTo {
  Vec2 point = Vec2::Zero();  ///< [m]
};

constexpr auto describe(const FlyTo*) {
  using T = FlyTo;
  return described<T>({"fly_to"}, "Fly to a point and through it.",
                      field("", &T::point, axes::kPlace, "the point"));
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

/// What an aircraft may be asked to do.
using TaskKind = std::variant<Loiter, FlyTo, FollowEdge, FollowLine, FlyCourse, FlyRoute,
                              FollowLeader, FlyTour>;

/// The word for a task.
std::string_view kind_of(const TaskKind& task);

/// One order for one aircraft. Numbers grow; an agent keeps the newest.
struct Task {
  std::uint32_t number = 0;
  TaskKind what = Loiter{};
};

constexpr auto describe(const Task*) {
  using T = Task;
  return described<T>({"task"}, "One order for one aircraft.",
                      field("task_number", &T::number, "the newest counts"),
                      field("what", &T::what, Storage::kJson, "what to do"));
}

}  // namespace skein
