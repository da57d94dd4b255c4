#include "layer/reasoning/agent/edge_follower.h"

#include <algorithm>
#include <cmath>

namespace skein::reasoning {
namespace {

constexpr double kArrived = 80;          // from the start: begin to look for the edge [m]
constexpr double kSeekInwards = 45;      // flown straight inwards before the spiral [s]
constexpr double kReadingsApart = 5;     // readings further apart make no crossing [s]
constexpr double kForget = 120;          // crossings older than this give no tangent [s]
constexpr double kSteepest = 1.4;        // a course within this of the edge's normal...
constexpr double kFinderAge = 3;         // what an edge finder saw is valid for [s]
constexpr double kFinderLookAhead = 60;  // distance in which an offset is taken out [m]
constexpr double kSpiralStart = 120;     // radius [m]
constexpr double kSpiralGrowth = 3;      // of the radius [m/s]: about 120 m a round

}  // namespace

EdgeFollower::EdgeFollower(const EdgeFollowerOptions& options, const FollowEdge& task)
    : options_(options), task_(task), side_(task.clockwise ? 1 : -1) {
  // The task's tangent has the fire on its right.
  if (!task.tangent.isZero()) tangent_ = geo::bearing(side_ * task.tangent);
}

void EdgeFollower::enter(Phase phase, Time now) {
  phase_ = phase;
  since_ = now;
}

void EdgeFollower::add(const FireReading& reading, double course) {
  last_course_ = course;
  const std::optional<FireReading> before = last_;
  last_ = reading;
  (reading.inside ? last_inside_ : last_outside_) = Mark{reading.time, reading.point};
  if (!before || before->inside == reading.inside) return;
  if ((reading.time - before->time).seconds() > kReadingsApart) return;
  crossed({reading.time, (before->point + reading.point) / 2}, course);
}

void EdgeFollower::crossed(const Mark& crossing, double course) {
  ++crossings_;
  if (phase_ == Phase::kApproach && (crossing.point - task_.start).norm() > options_.near)
    return;
  enter(Phase::kFollow, crossing.time);

  // Whoever enters the fire flies towards its side of the edge, so the edge runs more or
  // less like this (exactly, when it is crossed at a right angle):
  const double across = course - side_ * (last_->inside ? 1 : -1) * geo::kPi / 2;
  // The newest crossing that is far enough away gives the edge's line; across says which
  // way along it, as a loop may have crossed it further back.
  for (auto mark = marks_.rbegin(); mark != marks_.rend(); ++mark) {
    const Vec2 chord = crossing.point - mark->point;
    if (chord.norm() < options_.chord) continue;
    if ((crossing.time - mark->time).seconds() > kForget) break;
    const double line = geo::bearing(chord);
    tangent_ =
        std::abs(geo::wrap_pi(line - across)) < geo::kPi / 2 ? line : line + geo::kPi;
    break;
  }
  const double off = tangent_ ? geo::wrap_pi(*tangent_ - across) : 0;
  tangent_ = geo::wrap_pi(across + std::clamp(off, -kSteepest, kSteepest));

  marks_.push_back(crossing);
  if (marks_.size() > 12) marks_.pop_front();
}

void EdgeFollower::add(const EdgeSample& sample, const Vec2& position) {
  edge_ = Edge{sample.time, position + sample.offset, sample.tangent};
}

double EdgeFollower::turn_in(double angle) const {
  const bool inside = last_ && last_->inside;
  return geo::wrap_pi(*tangent_ + side_ * (inside ? -angle : angle));
}

double EdgeFollower::course(Time now, const Vec2& position) {
  if (!started_) since_ = now;
  started_ = true;
  if (edge_ && (now - edge_->time).seconds() < kFinderAge) return follow_finder(position);
  const double waited = (now - since_).seconds();
  switch (phase_) {
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
    case Phase::kFollow: {
      const double angle = options_.angle + options_.escalation *
                                                std::max(0.0, waited - options_.patience);
      if (angle < options_.give_up) return turn_in(angle);
      goal_ = (last_->inside ? last_outside_ : last_inside_)->point;
      last_course_ = geo::bearing(goal_ - position);
      enter(Phase::kReturn, now);
      return last_course_;
    }
    case Phase::kReturn: {
      const Vec2 to_goal = goal_ - position;
      if (to_goal.norm() > kArrived) return last_course_ = geo::bearing(to_goal);
      // Outwards the fire ends somewhere; inwards it should have been met by now.
      if (!last_->inside) enter(Phase::kSpiral, now);
      return last_course_;
    }
    case Phase::kSpiral:
      return spiral_course(waited, position);
  }
  return last_course_;
}

// Straight across the believed edge; without a belief, straight on.
double EdgeFollower::seek_course(double waited) const {
  if (!tangent_) return last_course_;
  return turn_in(std::min(options_.angle + 0.1 * waited, geo::kPi / 2));
}

double EdgeFollower::spiral_course(double waited, const Vec2& position) const {
  const Vec2 out = position - goal_;
  const double missing = kSpiralStart + kSpiralGrowth * waited - out.norm();
  return geo::bearing(out) + geo::kPi / 2 - std::atan2(missing, kSpiralStart);
}

double EdgeFollower::follow_finder(const Vec2& position) const {
  const Vec2 from_edge = position - edge_->point;
  const bool right = geo::cross(edge_->tangent, from_edge) > 0;  // in the fire
  const double outside = right ? -from_edge.norm() : from_edge.norm();
  const double along = geo::bearing(side_ * edge_->tangent);
  return along + side_ * std::atan2(outside - options_.offset, kFinderLookAhead);
}

}  // namespace skein::reasoning
