// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/edge/edge_follower.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"

namespace skein::reasoning {
namespace {

constexpr double kArrived = 80;       // from the start: begin to look for the edge [m]
constexpr double kSeekInwards = 45;   // flown straight inwards before the spiral [s]
constexpr double kReadingsApart = 5;  // readings further apart make no crossing [s]
constexpr double kMarkLife = 90;      // crossings older than this teach nothing [s]
constexpr std::size_t kMarks = 8;     // crossings that are kept
constexpr double kSteepest =
    1.4;  // largest angle of the edge to a perpendicular crossing
constexpr double kCourseSd = 0.4;  // of the edge's direction, from crossing to crossing
constexpr double kCornerSd = 0.7;  // of a direction guessed from one crossing
constexpr double kCorner = 5;      // a crossing as overdue as this is behind a corner [s]
constexpr double kSteepFrom = 60;  // distance at which the edge is met at 45 degrees [m]
constexpr double kAcross = 1.75;   // angle at which an edge nearby must be met [rad]
constexpr double kHoldAcross = 5;  // flight at that angle [s]
constexpr double kOutwards = 60;   // flown straight to leave the fire [s]
constexpr double kBeyond = 80;     // aimed at behind the last burning point [m]
constexpr double kNextDirection = 2.4;  // golden angle: spreads any number of directions
constexpr double kPlausible = 60;  // distance of a crossing from the believed edge [m]
constexpr double kFinderAge = 3;   // what an edge finder saw is valid for [s]
constexpr double kFinderLookAhead = 60;  // distance in which an offset is taken out [m]
constexpr double kSpiralStart = 120;     // radius [m]
constexpr double kSpiralGrowth = 3;      // of the radius [m/s]: about 120 m a turn

}  // namespace

EdgeFollower::EdgeFollower(const EdgeFollowerOptions& options, const FollowEdge& task)
    : options_(options), task_(task), side_(task.clockwise ? 1 : -1) {
  if (task.angle > 0) options_.angle = task.angle;
  // The task's tangent has the fire on its right.
  if (!task.tangent.isZero()) tangent_ = geo::bearing(side_ * task.tangent);
}

void EdgeFollower::enter(Phase phase, Time now) {
  belief_.phase = phase;
  belief_.since = now;
}

void EdgeFollower::add(const FireReading& reading, double course) {
  if (belief_.phase != Phase::kReturn) course_ = course;
  const std::optional<FireReading> previous = last_;
  last_ = reading;
  const bool differs = previous && previous->inside != reading.inside &&
                       (reading.time - previous->time).seconds() <= kReadingsApart;
  if (implausible_ && differs) {
    // The reading in between stands alone: forget its crossing.
    implausible_ = false;
    belief_ = before_;
    return;
  }
  implausible_ = false;
  const Vec2 middle =
      previous ? Vec2((previous->point + reading.point) / 2) : reading.point;
  if (differs) {
    implausible_ = !plausible(middle);
    before_ = belief_;
    crossed({reading.time, middle}, course);
  }
  if (reading.inside && !implausible_) last_inside_ = Mark{reading.time, reading.point};
}

bool EdgeFollower::plausible(const Vec2& crossing) const {
  return belief_.phase == Phase::kFollow &&
         std::abs(belief_.edge->right_of(crossing)) < kPlausible;
}

void EdgeFollower::crossed(const Mark& crossing, double course) {
  if (belief_.phase == Phase::kApproach &&
      (crossing.point - task_.start).norm() > options_.near)
    return;
  ++belief_.crossings;
  // Whoever enters the fire flies towards its side of the edge, so the edge runs more or
  // less like this (exactly, when it is crossed at a right angle):
  const double across = course - side_ * (last_->inside ? 1 : -1) * geo::kPi / 2;
  auto& marks = belief_.marks;
  std::erase_if(marks, [&](const Mark& m) {
    return (crossing.time - m.time).seconds() > kMarkLife;
  });
  // What lay before a corner does not continue behind it.
  const bool corner = belief_.overdue > kCorner || belief_.phase != Phase::kFollow ||
                      std::abs(belief_.edge->right_of(crossing.point)) > kPlausible;
  if (corner && marks.size() > 1) marks.erase(marks.begin(), marks.end() - 1);
  marks.push_back(crossing);
  if (marks.size() > kMarks) marks.pop_front();

  double expected = across;
  double sd = kCornerSd;
  if (belief_.edge && !corner) {
    expected = belief_.edge->course_at(crossing.point);
    sd = kCourseSd;
  } else if (!belief_.edge && tangent_) {
    expected = *tangent_;
  }
  belief_.edge = fit_edge(marks, expected, sd);
  const double off = geo::wrap_pi(belief_.edge->course - across);
  belief_.edge->course = geo::wrap_pi(across + std::clamp(off, -kSteepest, kSteepest));
  belief_.overdue = 0;
  enter(Phase::kFollow, crossing.time);
}

void EdgeFollower::add(const EdgeSample& sample, const Vec2& position) {
  found_ = Edge{sample.time, position + sample.offset, sample.tangent};
}

double EdgeFollower::turn_in(double along, double angle) const {
  const bool inside = last_ && last_->inside;
  return geo::wrap_pi(along + side_ * (inside ? -angle : angle));
}

double EdgeFollower::course(Time now, const Vec2& position) {
  if (!started_) belief_.since = now;
  started_ = true;
  const double waited = (now - belief_.since).seconds();
  if (found_ && (now - found_->time).seconds() < kFinderAge)
    return follow_finder(position);
  switch (belief_.phase) {
    case Phase::kApproach: {
      const Vec2 to_start = task_.start - position;
      if (to_start.norm() > kArrived) return geo::bearing(to_start);
      enter(Phase::kSeek, now);
      return seek_course(0);
    }
    case Phase::kSeek:
      if (waited > kSeekInwards && !(last_ && last_->inside)) {
        goal_ = task_.start;
        enter(Phase::kSpiral, now);
      }
      return seek_course(waited);
    case Phase::kFollow:
      return follow_course(now, position);
    case Phase::kReturn:
      // At the goal the fire should have been met; that reading must have been false.
      if (!last_->inside && (goal_ - position).norm() < kArrived)
        enter(Phase::kSpiral, now);
      return return_course(waited, position);
    case Phase::kSpiral:
      return spiral_course(waited, position);
  }
  return course_;
}

double EdgeFollower::follow_course(Time now, const Vec2& position) {
  const bool inside = last_->inside;
  const LocalEdge& edge = *belief_.edge;
  // Distance still to fly to the believed edge.
  const double missing = side_ * (inside ? 1 : -1) * edge.right_of(position);
  const double dt = (now - std::max(updated_, belief_.since)).seconds();
  updated_ = now;
  if (missing < 0) belief_.overdue += dt;
  const double angle = std::max(options_.angle, math::atan(missing / kSteepFrom)) +
                       overdue_angle(belief_.overdue);
  if (angle < options_.give_up) return turn_in(edge.course_at(position), angle);

  // What has burnt goes on burning, so the path back into the fire is known; the path out
  // is only believed.
  goal_ = last_inside_ ? last_inside_->point : edge.point;
  goal_ += kBeyond * (goal_ - position).normalized();
  course_ = turn_in(edge.course_at(position), geo::kPi / 2);
  enter(Phase::kReturn, now);
  return return_course(0, position);
}

// The turn after an edge that should have been crossed: across the believed edge,
// straight on there for a while, then a full circle.
double EdgeFollower::overdue_angle(double overdue) const {
  const double across = kAcross - options_.angle;
  const double turned = options_.escalation * overdue;
  return std::min(turned, across) +
         std::max(0.0, turned - across - options_.escalation * kHoldAcross);
}

double EdgeFollower::return_course(double waited, const Vec2& position) const {
  if (!last_->inside) return geo::bearing(goal_ - position);
  // Outwards; each time that this was wrong, in another direction for longer.
  int tries = 0;
  for (double leg = kOutwards; waited > leg; leg += kOutwards) {
    waited -= leg;
    ++tries;
  }
  return geo::wrap_pi(course_ + tries * kNextDirection);
}

// Straight across the believed edge; without a belief, straight on.
double EdgeFollower::seek_course(double waited) const {
  if (!tangent_) return course_;
  return turn_in(*tangent_, std::min(options_.angle + 0.1 * waited, geo::kPi / 2));
}

double EdgeFollower::spiral_course(double waited, const Vec2& position) const {
  const Vec2 out = position - goal_;
  const double missing = kSpiralStart + kSpiralGrowth * waited - out.norm();
  return geo::bearing(out) + geo::kPi / 2 - math::atan2(missing, kSpiralStart);
}

double EdgeFollower::follow_finder(const Vec2& position) const {
  const Vec2 from_edge = position - found_->point;
  const bool right = geo::cross(found_->tangent, from_edge) > 0;  // in the fire
  const double outside = right ? -from_edge.norm() : from_edge.norm();
  const double along = geo::bearing(side_ * found_->tangent);
  // To the other side and back: an edge that is never crossed is never measured.
  const double setpoint = last_ && last_->inside ? options_.offset : -options_.offset;
  return along + side_ * math::atan2(outside - setpoint, kFinderLookAhead);
}

}  // namespace skein::reasoning
