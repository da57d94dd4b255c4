// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/flight_goal.h"

#include <algorithm>
#include <variant>

#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kAhead = 60;  // [s]
constexpr double kNear = 150;  // a place that is nearer says nothing of a course [m]

class GoalFinder {
 public:
  GoalFinder(std::size_t passed, const NavEstimate& nav, double now)
      : passed_(passed), nav_(nav), now_(now) {
    goal_.track = geo::bearing(nav.v_N.head<2>());
    goal_.speed = nav.v_N.head<2>().norm();
    goal_.vertical_speed = 0;
    goal_.altitude = -nav.p_N.z();
  }

  void operator()(const Itinerary& itinerary) {
    if (itinerary.plan.empty()) return;
    const double until = std::min(now_ + kAhead, model::end_time_of(itinerary.plan));
    const Vec3 place = model::moment_at(itinerary.plan, until).p_N;
    head_for(place.head<2>());
    if (!itinerary.over_ground) climb_to(-place.z(), kAhead);
  }
  void operator()(const Legs& legs) {
    if (legs.points.empty()) return;
    const std::size_t all = legs.points.size() * static_cast<std::size_t>(legs.laps);
    const std::size_t next = std::min(passed_, all - 1) % legs.points.size();
    head_for(legs.points[next]);
  }
  void operator()(const Steering& steering) { goal_.track = steering.course; }
  void operator()(const Circling& circling) { head_for(circling.centre); }
  void operator()(const Landing& landing) { head_for(landing.place); }
  void operator()(const Returning&) {}

  const model::FlightGoal& goal() const { return goal_; }

 private:
  void head_for(const Vec2& place) {
    const Vec2 off = place - nav_.p_N.head<2>();
    if (off.norm() > kNear) goal_.track = geo::bearing(off);
  }
  void climb_to(double altitude, double time) {
    goal_.vertical_speed = (altitude + nav_.p_N.z()) / time;
    goal_.altitude = altitude;
  }

  std::size_t passed_;
  const NavEstimate& nav_;
  double now_;
  model::FlightGoal goal_;
};

}  // namespace

model::FlightGoal goal_of(const FlightIntent* wanted, std::size_t passed,
                          const NavEstimate& nav, double now) {
  GoalFinder finder(passed, nav, now);
  if (wanted) std::visit(finder, wanted->what);
  return finder.goal();
}

}  // namespace skein::reasoning
