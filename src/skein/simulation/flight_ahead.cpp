// SPDX-License-Identifier: Apache-2.0
#include "skein/simulation/flight_ahead.h"

#include <algorithm>
#include <cmath>

#include "skein/geo/vec.h"
#include "skein/model/path/path_geometry.h"

namespace skein::simulation {
namespace {

constexpr double kMinBetween = 2;   // between two paths [s]
constexpr double kAgain = 10;       // of what is commanded at each step [s]
constexpr double kTurned = 0.26;    // of a course: another flight [rad]
constexpr double kMoved = 10;       // of a circle or a place: another flight [m]
constexpr double kStraightOn = 30;  // of a course [s]
constexpr double kOffStraight = 2;  // of a plan that is left out [m]
constexpr double kSpacing = 20;     // of points on arcs [m]
constexpr int kAroundCircle = 24;   // points
constexpr std::size_t kMaxPoints = 400;
constexpr double kMinSpeed = 1;  // [m/s]

// A path that grows from where the aircraft is, at its speed where nothing says times.
class Growing {
 public:
  Growing(const NavEstimate& nav, const AutopilotCommand& command)
      : speed_(std::max(
            {command.airspeed.value_or(0), geo::horizontal(nav.v_N).norm(), kMinSpeed})),
        altitude_(command.altitude_msl),
        last_(geo::horizontal(nav.p_N)) {
    put(0, last_, -nav.p_N.z());
  }

  bool full() const { return path_.points.size() >= kMaxPoints; }
  void to(const Vec2& point) { to(point, altitude_); }
  void to(const Vec2& point, double altitude_msl) {
    ahead_ += (point - last_).norm() / speed_;
    last_ = point;
    put(ahead_, point, altitude_msl);
  }
  void at(double ahead, const Vec3& p_N) { put(ahead, geo::horizontal(p_N), -p_N.z()); }
  void around(const Vec2& centre, double radius, bool clockwise) {
    const Vec2 out = last_ - centre;
    const double from = out.norm() > 0 ? geo::bearing(out) : 0;
    for (int k = 0; k <= kAroundCircle; ++k)
      to(centre + radius * geo::unit(from + (clockwise ? 1 : -1) * 2 * geo::kPi * k /
                                                kAroundCircle));
  }
  FlightPath take(bool ends) {
    path_.ends = ends && !full();
    return std::move(path_);
  }

 private:
  void put(double ahead, const Vec2& point, double altitude_msl) {
    if (full()) return;
    path_.points.push_back({static_cast<float>(ahead), static_cast<float>(point.x()),
                            static_cast<float>(point.y()),
                            static_cast<float>(altitude_msl)});
  }

  FlightPath path_;
  double speed_, altitude_, ahead_ = 0;
  Vec2 last_;
};

bool nearly_straight(const Plan& plan, std::size_t from, std::size_t to) {
  const Vec3 leg = plan[to].p_N - plan[from].p_N;
  const double length2 = leg.squaredNorm();
  for (std::size_t k = from + 1; k < to; ++k) {
    const Vec3 off = plan[k].p_N - plan[from].p_N;
    const double share = length2 > 0 ? std::clamp(off.dot(leg) / length2, 0.0, 1.0) : 0;
    if ((off - share * leg).norm() > kOffStraight) return false;
  }
  return true;
}

struct Tracer {
  const NavEstimate& nav;
  Time now;
  Growing& path;

  // @returns whether the flight ends at the last point.
  bool operator()(const FollowPlan& follow) {
    const Plan& plan = follow.plan;
    std::size_t k = 0;
    while (k < plan.size() && plan[k].time <= now) ++k;
    while (k < plan.size() && !path.full()) {
      path.at((plan[k].time - now).seconds(), plan[k].p_N);
      std::size_t next = k + 1;
      while (next + 1 < plan.size() && nearly_straight(plan, k, next + 1)) ++next;
      k = next;
    }
    return true;
  }
  bool operator()(const FollowPath& follow) {
    for (const PathElement& element : follow.path) {
      const int pieces = element.curvature == 0
                             ? 1
                             : static_cast<int>(std::ceil(element.length / kSpacing));
      path.to(element.start);
      for (int k = 1; k <= pieces && !path.full(); ++k)
        path.to(model::pose_at(element, element.length * k / pieces).position);
    }
    return true;
  }
  bool operator()(const FlyWaypoints& fly) {
    for (int lap = 0; lap < fly.laps && !path.full(); ++lap)
      for (const auto& [point, altitude_msl] : fly.points) path.to(point, altitude_msl);
    return true;
  }
  bool operator()(const HoldCourse& hold) { return straight(hold.course); }
  bool operator()(const HoldBank&) { return straight(nav.heading); }
  bool operator()(const TakeOff& take_off) { return straight(take_off.course); }
  bool operator()(const Circle& circle) {
    path.around(circle.centre, circle.radius, circle.clockwise);
    return false;
  }
  bool operator()(const HoldPosition& hold) { return to(hold.point); }
  bool operator()(const Land& land) {
    path.to(land.point, land.ground_msl);
    return true;
  }
  bool operator()(const Return& back) { return back.point ? to(*back.point) : false; }

  bool to(const Vec2& point) {
    path.to(point);
    return true;
  }
  bool straight(double course) {
    const double speed = std::max(geo::horizontal(nav.v_N).norm(), kMinSpeed);
    path.to(geo::horizontal(nav.p_N) + kStraightOn * speed * geo::unit(course));
    return false;
  }
};

// Commanded anew at each step: another one is no other flight yet.
bool steers(const AutopilotCommand& command) {
  return std::holds_alternative<HoldCourse>(command.guidance) ||
         std::holds_alternative<HoldBank>(command.guidance);
}

// About one place.
bool stays(const AutopilotCommand& command) {
  return std::holds_alternative<Circle>(command.guidance) ||
         std::holds_alternative<HoldPosition>(command.guidance);
}

}  // namespace

FlightAhead::Mark FlightAhead::mark_of(const AutopilotCommand& command) {
  struct Marker {
    double altitude;
    Mark operator()(const FollowPlan& f) const {
      if (f.plan.empty()) return {};
      const PlanPoint& end = f.plan.back();
      return {0, end.p_N.x(), end.p_N.y(),
              end.time.seconds() + f.plan.front().time.seconds() +
                  static_cast<double>(f.plan.size())};
    }
    Mark operator()(const FollowPath& f) const {
      if (f.path.empty()) return {};
      const Vec2 end = model::end_of(f.path.back()).position;
      return {0, end.x(), end.y(), model::length(f.path)};
    }
    Mark operator()(const FlyWaypoints& f) const {
      Vec2 sum = Vec2::Zero();
      for (std::size_t k = 0; k < f.points.size(); ++k)
        sum += static_cast<double>(k + 1) * f.points[k].point;
      return {0, sum.x(), sum.y(), static_cast<double>(f.laps)};
    }
    Mark operator()(const HoldCourse& h) const { return {0, h.course, 0, 0}; }
    Mark operator()(const HoldBank&) const { return {}; }
    Mark operator()(const TakeOff& t) const { return {0, t.course, 0, altitude}; }
    Mark operator()(const Circle& c) const {
      return {0, c.centre.x(), c.centre.y(), c.clockwise ? c.radius : -c.radius};
    }
    Mark operator()(const HoldPosition& h) const {
      return {0, h.point.x(), h.point.y(), 0};
    }
    Mark operator()(const Land& l) const { return {0, l.point.x(), l.point.y(), 0}; }
    Mark operator()(const Return& r) const {
      const Vec2 point = r.point.value_or(Vec2::Zero());
      return {0, point.x(), point.y(), 0};
    }
  };
  Mark mark = std::visit(Marker{command.altitude_msl}, command.guidance);
  mark.kind = command.guidance.index();
  return mark;
}

bool FlightAhead::is_another(const AutopilotCommand& command, const Mark& mark,
                             Time now) const {
  if (!said_ || mark.kind != said_->kind) return true;
  // Circles are as wide as the wind wants at the moment.
  if (stays(command))
    return std::abs(mark.a - said_->a) > kMoved || std::abs(mark.b - said_->b) > kMoved ||
           std::abs(mark.c - said_->c) > kMoved;
  if (!steers(command)) return mark != *said_;
  return (now - said_at_).seconds() >= kAgain ||
         std::abs(geo::wrap_pi(mark.a - said_->a)) > kTurned;
}

std::optional<FlightPath> FlightAhead::step(const AutopilotCommand* command,
                                            const NavEstimate& nav, Time now) {
  if (command)
    waiting_.reset();
  else if (waiting_)
    command = &*waiting_;
  else
    return std::nullopt;
  const Mark mark = mark_of(*command);
  if (!is_another(*command, mark, now)) return std::nullopt;
  if (said_ && (now - said_at_).seconds() < kMinBetween) {
    // Who steers says it again.
    if (!waiting_ && !steers(*command)) waiting_ = *command;
    return std::nullopt;
  }
  said_ = mark;
  said_at_ = now;
  Growing path(nav, *command);
  const bool ends = std::visit(Tracer{nav, now, path}, command->guidance);
  waiting_.reset();
  return path.take(ends);
}

}  // namespace skein::simulation
