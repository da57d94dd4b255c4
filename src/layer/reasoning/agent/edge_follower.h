#pragma once

#include <deque>
#include <optional>

#include "data/fire.h"
#include "data/sensing.h"
#include "data/task.h"

namespace skein::reasoning {

struct EdgeFollowerOptions {
  double angle = 0.61;       ///< between course and edge, to cross it again [rad]
  double patience = 7;       ///< without a crossing before the turn grows [s]
  double escalation = 0.26;  ///< how fast it then grows [rad/s]
  double give_up = 4.8;      ///< turn at which the edge counts as lost [rad]
  double chord = 60;         ///< shortest distance of crossings that give a tangent [m]
  double near = 250;         ///< crossings this near to the start begin the following [m]
  double offset = 10;        ///< kept outside the edge with an ideal edge finder [m]
};

/// Follows the edge of a fire by in/out readings, or by an ideal edge finder.
///
/// It flies at `angle` to the edge, inwards while the last reading is outside and
/// outwards while it is inside, so it crosses the edge again and again. The direction of
/// the edge is that from an earlier crossing, at least `chord` away, to the last one.
/// When no crossing comes for `patience`, at a corner or in a bay, the angle grows into a
/// full turn; after `give_up` it returns to the last place that was on the other side,
/// and in the end flies a widening spiral there.
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
  bool lost() const { return phase_ == Phase::kReturn || phase_ == Phase::kSpiral; }
  /// Crossings so far, those of single readings that were taken back left out.
  int crossings() const { return crossings_; }

 private:
  enum class Phase {
    kApproach,  // to the task's start
    kSeek,      // arrived there, no crossing yet
    kFollow,
    kReturn,  // to the last place on the other side
    kSpiral,  // around it
  };
  struct Mark {
    Time time;
    Vec2 point = Vec2::Zero();
  };

  void crossed(const Mark& crossing, double course);
  void enter(Phase phase, Time now);
  double turn_in(double angle) const;
  double seek_course(double waited) const;
  double follow_finder(const Vec2& position) const;
  double spiral_course(double waited, const Vec2& position) const;

  EdgeFollowerOptions options_;
  FollowEdge task_;
  double side_;  // of the fire: +1 right, -1 left
  Phase phase_ = Phase::kApproach;
  Time since_;  // of the phase, or of the last crossing in kFollow
  bool started_ = false;
  std::optional<double> tangent_;  // direction of flight along the edge [rad]
  std::optional<FireReading> last_;
  std::optional<Mark> last_inside_, last_outside_;
  std::deque<Mark> marks_;    // crossings, newest last
  Vec2 goal_ = Vec2::Zero();  // of kReturn and kSpiral
  double last_course_ = 0;
  int crossings_ = 0;
  struct Edge {
    Time time;
    Vec2 point, tangent;
  };
  std::optional<Edge> edge_;
};

}  // namespace skein::reasoning
