// SPDX-License-Identifier: Apache-2.0
#include "skein/data/team/task.h"

#include <cmath>
#include <cstddef>
#include <span>

namespace skein {
namespace {

constexpr double kMaxTime = 1e7;        // of a task [s]
constexpr double kMaxCoordinate = 1e7;  // [m]
constexpr std::size_t kMaxPoints = 100'000;

bool usable(const Vec2& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kMaxCoordinate;
}

std::string points_error(std::span<const Vec2> points, std::size_t min,
                         const char* needs) {
  if (points.size() < min) return needs;
  if (points.size() > kMaxPoints) return "it has too many points.";
  for (const Vec2& point : points)
    if (!usable(point)) return "a point is no place.";
  return {};
}

std::string duration_error(double seconds) {
  return seconds >= 0 && seconds <= kMaxTime ? "" : "a time must be 0 s or more.";
}

// An overload for each kind: the compiler names one that is missing.
struct ErrorOf {
  static std::string place(const Vec2& p) {
    return usable(p) ? "" : "the point is no place.";
  }
  static std::string laps(int count) {
    return count >= 1 ? "" : "it has one lap or more.";
  }

  std::string operator()(const Loiter& t) const { return place(t.centre); }
  std::string operator()(const FlyTo& t) const { return place(t.point); }
  std::string operator()(const FollowEdge& t) const {
    if (!t.tangent.allFinite() || !std::isfinite(t.angle)) return "a direction is none.";
    return place(t.start);
  }
  std::string operator()(const FollowLine& t) const {
    return points_error(t.points, 0, "");
  }
  std::string operator()(const FlyCourse& t) const {
    return std::isfinite(t.course) ? "" : "the course is none.";
  }
  std::string operator()(const FlyRoute& t) const {
    if (auto error = points_error(t.points, 1, "a route has a point or more.");
        !error.empty())
      return error;
    return laps(t.laps);
  }
  std::string operator()(const FollowLeader& t) const { return place(t.offset); }
  std::string operator()(const FlyTour& t) const {
    if (auto error = points_error(t.points, 2, "a tour has two points or more.");
        !error.empty())
      return error;
    return laps(t.laps);
  }
  std::string operator()(const Hold&) const { return {}; }
  std::string operator()(const Survey& t) const {
    if (auto error = points_error(t.area, 3, "an area has three corners or more.");
        !error.empty())
      return error;
    for (const geo::Ring& hole : t.holes)
      if (auto error = points_error(hole, 3, "a hole has three corners or more.");
          !error.empty())
        return error;
    if (!(t.swath > 0) || !(t.swath <= kMaxCoordinate))
      return "the swath must be above 0 m.";
    if (!(t.overlap >= 0) || !(t.overlap < 1)) return "the overlap is a share below 1.";
    if (t.lines.size() % 2 != 0) return "each line has a begin and an end.";
    return points_error(t.lines, 0, "");
  }
  std::string operator()(const Patrol& t) const {
    if (!std::isfinite(t.offset) || std::abs(t.offset) > kMaxCoordinate || t.rounds < 0)
      return "the offset must be a number, the rounds 0 or more.";
    return points_error(t.line, 2, "a line has two points or more.");
  }
  std::string operator()(const Orbit& t) const {
    if (!(t.radius >= 0) || !(t.radius <= kMaxCoordinate))
      return "the radius must be 0 m or more.";
    if (auto error = duration_error(t.duration); !error.empty()) return error;
    return place(t.point);
  }
  std::string operator()(const Measure& t) const {
    if (auto error = duration_error(t.stay); !error.empty()) return error;
    return place(t.point);
  }
  std::string operator()(const Rendezvous& t) const {
    if (t.course && !std::isfinite(*t.course)) return "the course is none.";
    if (auto error = duration_error(t.time.seconds()); !error.empty()) return error;
    return place(t.point);
  }
  std::string operator()(const Relay& t) const {
    return t.first == t.second ? "a relay is between two others." : "";
  }
  std::string operator()(const FlyPlan& t) const {
    if (t.plan.empty()) return "the plan is empty.";
    for (const FlightElement& e : t.plan) {
      const bool fine = std::isfinite(e.start) && e.duration > 0 &&
                        e.duration <= kMaxTime && e.p_N.allFinite() &&
                        std::isfinite(e.heading) && e.airspeed > 0 &&
                        std::isfinite(e.airspeed) && std::isfinite(e.turn_rate) &&
                        std::isfinite(e.climb_rate) &&
                        std::isfinite(e.climb_acceleration) && e.wind.allFinite();
      if (!fine) return "an element of the plan is no flight.";
    }
    return {};
  }
  std::string operator()(const ReturnHome&) const { return {}; }
  std::string operator()(const LandAt& t) const { return place(t.place); }
};

}  // namespace

std::string_view kind_of(const TaskKind& task) {
  return std::visit([]<class T>(const T&) { return kind_of<T>(); }, task);
}

void bind_others(TaskKind& task, std::span<const EntityId> others) {
  if (auto* follow = std::get_if<FollowLeader>(&task); follow && others.size() == 1)
    follow->leader = others[0];
  else if (auto* relay = std::get_if<Relay>(&task); relay && others.size() == 2)
    *relay = {others[0], others[1]};
}

std::string task_error(const TaskKind& task) {
  return std::visit(ErrorOf(), task);
}

}  // namespace skein
