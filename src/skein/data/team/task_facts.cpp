// SPDX-License-Identifier: Apache-2.0
#include "skein/data/team/task_facts.h"

#include <cmath>
#include <cstddef>

#include "skein/geo/polygon.h"

namespace skein {
namespace {

constexpr double kMaxTime = 1e7;        // of a task [s]
constexpr double kMaxCoordinate = 1e7;  // [m]
constexpr std::size_t kMaxPoints = 100'000;

bool usable(const Vec2& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kMaxCoordinate;
}

std::string laps_error(int count) {
  return count >= 1 ? "" : "it has one lap or more.";
}

double length_of(const std::vector<Vec2>& points, bool closed) {
  double length = 0;
  for (std::size_t k = 1; k < points.size(); ++k)
    length += (points[k] - points[k - 1]).norm();
  if (closed && points.size() > 1) length += (points.front() - points.back()).norm();
  return length;
}

Vec2 middle_of(const std::vector<Vec2>& points) {
  Vec2 low = points.front(), high = low;
  for (const Vec2& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (low + high) / 2;
}

// Along points that it begins at, some times over; it ends at the last of a line.
TaskNeeds along(const std::vector<Vec2>& points, double length, bool line = false) {
  TaskNeeds needs;
  if (points.empty()) return needs;
  needs.begin = points.front();
  if (line) needs.end = points.back();
  needs.centre = middle_of(points);
  needs.length = length;
  return needs;
}

bool is_flight(const FlightElement& e) {
  return std::isfinite(e.start) && e.duration > 0 && e.duration <= kMaxTime &&
         e.p_N.allFinite() && std::isfinite(e.heading) && e.airspeed > 0 &&
         std::isfinite(e.airspeed) && std::isfinite(e.turn_rate) &&
         std::isfinite(e.climb_rate) && std::isfinite(e.climb_acceleration) &&
         e.wind.allFinite();
}

}  // namespace

std::string place_error(const Vec2& place) {
  return usable(place) ? "" : "the point is no place.";
}

std::string duration_error(double seconds) {
  return seconds >= 0 && seconds <= kMaxTime ? "" : "a time must be 0 s or more.";
}

std::string points_error(std::span<const Vec2> points, std::size_t min,
                         const char* needs) {
  if (points.size() < min) return needs;
  if (points.size() > kMaxPoints) return "it has too many points.";
  for (const Vec2& point : points)
    if (!usable(point)) return "a point is no place.";
  return {};
}

TaskNeeds needs_at(const Vec2& point, double stay) {
  TaskNeeds needs;
  needs.begin = needs.centre = point;
  needs.stay = stay;
  return needs;
}

TaskNeeds endless(TaskNeeds needs) {
  needs.endless = true;
  return needs;
}

std::string check_task(const Loiter& task) {
  return place_error(task.centre);
}
TaskNeeds needs_of_task(const Loiter& task) {
  return endless(needs_at(task.centre));
}

std::string check_task(const FlyTo& task) {
  return place_error(task.point);
}
TaskNeeds needs_of_task(const FlyTo& task) {
  return needs_at(task.point);
}

std::string check_task(const FollowEdge& task) {
  if (!task.tangent.allFinite() || !std::isfinite(task.angle))
    return "a direction is none.";
  return place_error(task.start);
}
TaskNeeds needs_of_task(const FollowEdge& task) {
  TaskNeeds needs = endless(needs_at(task.start));
  needs.sensors = kFireSensor;
  needs.foreseen = false;
  return needs;
}

std::string check_task(const FollowLine& task) {
  return points_error(task.points, 0, "");
}
TaskNeeds needs_of_task(const FollowLine& task) {
  return along(task.points, length_of(task.points, false), true);
}

std::string check_task(const FlyCourse& task) {
  return std::isfinite(task.course) ? "" : "the course is none.";
}
TaskNeeds needs_of_task(const FlyCourse&) {
  return endless({});
}

std::string check_task(const FlyRoute& task) {
  if (auto error = points_error(task.points, 1, "a route has a point or more.");
      !error.empty())
    return error;
  return laps_error(task.laps);
}
TaskNeeds needs_of_task(const FlyRoute& task) {
  return along(task.points, task.laps * length_of(task.points, true));
}

std::string check_task(const FollowLeader& task) {
  return place_error(task.offset);
}
TaskNeeds needs_of_task(const FollowLeader&) {
  TaskNeeds needs = endless({});
  needs.foreseen = false;
  return needs;
}

std::string check_task(const FlyTour& task) {
  if (auto error = points_error(task.points, 2, "a tour has two points or more.");
      !error.empty())
    return error;
  return laps_error(task.laps);
}
TaskNeeds needs_of_task(const FlyTour& task) {
  return along(task.points, task.laps * length_of(task.points, true));
}

std::string check_task(const Hold&) {
  return {};
}
TaskNeeds needs_of_task(const Hold&) {
  return endless({});
}

std::string check_task(const Survey& task) {
  if (auto error = points_error(task.area, 3, "an area has three corners or more.");
      !error.empty())
    return error;
  for (const geo::Ring& hole : task.holes)
    if (auto error = points_error(hole, 3, "a hole has three corners or more.");
        !error.empty())
      return error;
  if (!(task.swath > 0) || !(task.swath <= kMaxCoordinate))
    return "the swath must be above 0 m.";
  if (!(task.overlap >= 0) || !(task.overlap < 1))
    return "the overlap is a share below 1.";
  if (task.lines.size() % 2 != 0) return "each line has a begin and an end.";
  return points_error(task.lines, 0, "");
}
TaskNeeds needs_of_task(const Survey& task) {
  const double spacing = task.swath * (1 - task.overlap);
  return along(task.area, std::abs(geo::signed_area(task.area)) / spacing);
}

std::string check_task(const Patrol& task) {
  if (!std::isfinite(task.offset) || std::abs(task.offset) > kMaxCoordinate ||
      task.rounds < 0)
    return "the offset must be a number, the rounds 0 or more.";
  return points_error(task.line, 2, "a line has two points or more.");
}
TaskNeeds needs_of_task(const Patrol& task) {
  const double round =
      task.closed ? length_of(task.line, true) : 2 * length_of(task.line, false);
  TaskNeeds needs = along(task.line, task.rounds * round);
  needs.endless = task.rounds == 0;
  return needs;
}

std::string check_task(const Orbit& task) {
  if (!(task.radius >= 0) || !(task.radius <= kMaxCoordinate))
    return "the radius must be 0 m or more.";
  if (auto error = duration_error(task.duration); !error.empty()) return error;
  return place_error(task.point);
}
TaskNeeds needs_of_task(const Orbit& task) {
  TaskNeeds needs = needs_at(task.point, task.duration);
  needs.endless = task.duration <= 0;
  if (task.object) needs.sensors = kCameraSensor;
  needs.foreseen = !task.object;
  needs.better_hovering = true;
  return needs;
}

std::string check_task(const Measure& task) {
  if (auto error = duration_error(task.stay); !error.empty()) return error;
  return place_error(task.point);
}
TaskNeeds needs_of_task(const Measure& task) {
  TaskNeeds needs = needs_at(task.point, task.stay);
  needs.better_hovering = true;
  return needs;
}

std::string check_task(const Rendezvous& task) {
  if (task.course && !std::isfinite(*task.course)) return "the course is none.";
  if (auto error = duration_error(task.time.seconds()); !error.empty()) return error;
  return place_error(task.point);
}
TaskNeeds needs_of_task(const Rendezvous& task) {
  return endless(needs_at(task.point));
}

std::string check_task(const Relay& task) {
  return task.first == task.second ? "a relay is between two others." : "";
}
TaskNeeds needs_of_task(const Relay&) {
  TaskNeeds needs = endless({});
  needs.foreseen = false;
  return needs;
}

std::string check_task(const FlyPlan& task) {
  if (task.plan.empty()) return "the plan is empty.";
  for (const FlightElement& element : task.plan)
    if (!is_flight(element)) return "an element of the plan is no flight.";
  return {};
}
TaskNeeds needs_of_task(const FlyPlan& task) {
  if (task.plan.empty()) return {};
  TaskNeeds needs = needs_at(geo::horizontal(task.plan.front().p_N));
  needs.end = geo::horizontal(task.plan.back().p_N);
  for (const FlightElement& element : task.plan) needs.stay += element.duration;
  return needs;
}

std::string check_task(const ReturnHome&) {
  return {};
}
TaskNeeds needs_of_task(const ReturnHome&) {
  return endless({});
}

std::string check_task(const LandAt& task) {
  return place_error(task.place);
}
TaskNeeds needs_of_task(const LandAt& task) {
  return task.at_home ? endless({}) : endless(needs_at(task.place));
}

}  // namespace skein
