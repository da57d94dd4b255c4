// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <optional>

#include "skein/data/perimeter/fire.h"
#include "skein/data/team/task.h"
#include "skein/data/vehicle/sensing.h"
#include "skein/layer/reasoning/task/edge/local_edge.h"

namespace skein::reasoning {

struct EdgeFollowerOptions {
  double angle = geo::radians(35);  ///< minimum angle between course and edge [rad]
  double escalation = 0.2;  ///< growth of that angle while a crossing is overdue [rad/s]
  double give_up = 4.2;     ///< angle at which the edge counts as lost [rad]
  double near = 250;        ///< crossings this near to the start begin the following [m]
  double offset = 20;       ///< aimed at beyond the edge with an ideal edge finder [m]
};

/// Follows the edge of a fire by in/out readings, or by an ideal edge finder.
///
/// It believes the edge to be an arc, fitted to its last crossings (local_edge.h), and
/// flies towards it at `angle` or more: inwards while the last reading is outside and
/// outwards while it is inside, so that it crosses again and again. When it is beyond the
/// believed edge without having crossed, at a corner or in a bay, the angle grows up to a
/// full turn; after `give_up` it returns to the last place that was on the other side,
/// and in the end flies a widening spiral there.
///
/// A single reading that differs from those before and after it, far from the believed
/// edge, is taken for a false one.
class EdgeFollower {
 public:
  EdgeFollower(const EdgeFollowerOptions& options, const FollowEdge& task);

  /// Takes in a reading; `course` is the aircraft's over ground.
  void add(const FireReading& reading, double course);

  /// Takes in what an ideal edge finder saw from `position`.
  void add(const EdgeSample& sample, const Vec2& position);

  /// The course over ground to fly now [rad].
  double course(Time now, const Vec2& position);

  /// Whether the edge was being followed and is now being looked for.
  bool lost() const {
    return belief_.phase == Phase::kReturn || belief_.phase == Phase::kSpiral;
  }
  /// Crossings so far, those of single readings that were taken back left out.
  int crossings() const { return belief_.crossings; }

 private:
  enum class Phase {
    kApproach,  // to the task's start
    kSeek,      // arrived there, no crossing yet
    kFollow,
    kReturn,  // to the last place on the other side
    kSpiral,  // around it
  };

  void crossed(const Mark& crossing, double course);
  bool plausible(const Vec2& crossing) const;
  void enter(Phase phase, Time now);
  double turn_in(double along, double angle) const;
  double follow_course(Time now, const Vec2& position);
  double overdue_angle(double overdue) const;
  double return_course(double waited, const Vec2& position) const;
  double seek_course(double waited) const;
  double follow_finder(const Vec2& position) const;
  double spiral_course(double waited, const Vec2& position) const;

  // What crossings have taught; put back when a crossing turns out to be a false reading.
  struct Belief {
    Phase phase = Phase::kApproach;
    Time since;                     // of the phase
    std::optional<LocalEdge> edge;  // in the direction of flight
    std::deque<Mark> marks;         // crossings, newest last
    double overdue = 0;             // flown beyond the believed edge without crossing [s]
    int crossings = 0;
  };

  EdgeFollowerOptions options_;
  FollowEdge task_;
  double side_;  // of the fire: +1 right, -1 left
  Belief belief_, before_;
  bool implausible_ = false;  // the last reading made an implausible crossing
  std::optional<double>
      tangent_;  // as the task says it, in the direction of flight [rad]
  std::optional<FireReading> last_;
  std::optional<Mark> last_inside_;
  Vec2 goal_ = Vec2::Zero();  // of kReturn and kSpiral
  double course_ = 0;         // flown, or of the return [rad]
  Time updated_;              // of belief_.overdue
  bool started_ = false;
  struct Edge {
    Time time;
    Vec2 point, tangent;
  };
  std::optional<Edge> found_;  // by the ideal finder
};

}  // namespace skein::reasoning
