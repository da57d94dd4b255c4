// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/follow/slot_plan.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/data/vehicle/air.h"

namespace skein::reasoning {
namespace {

constexpr double kMaxTurned = geo::kPi / 2;  // of the leader's turn, foretold [rad]
constexpr double kClimbs = 2;                // the leader's climb is foretold [s]

constexpr double kStep = 0.1;        // of the motion [s]
constexpr int kStepsAPoint = 5;      // of the plan
constexpr double kAheadGain = 0.15;  // speed per distance to the slot [1/s]
// Idle, a wing slows down by what it would sink otherwise; autopilots keep half of that
// for the height.
constexpr double kIdle = 0.4;
constexpr double kSlowsEarly = 0.6;  // of the deceleration, on the path into the slot
constexpr double kRightGain = 0.2;   // [1/s]
constexpr double kMaxAcross = 0.35;  // of the speed: the steepest path to the slot's line
constexpr double kCourseGain = 0.8;  // turn rate per error of the course [1/s]
constexpr double kAcceleration = 1.2;   // of a fixed wing along its path [m/s^2]
constexpr double kHoverMoves = 2;       // of what can hover, to any side [m/s^2]
constexpr double kClimbGain = 0.3;      // climb rate per height to the slot [1/s]
constexpr double kClimbChange = 1;      // [m/s^2]
constexpr double kClimbReserve = 0.8;   // of climb and sink rates
constexpr double kTurnReserve = 0.65;   // of the bank limit
constexpr double kTurns = 0.25;         // off the commanded course: it turns [rad]
constexpr double kRollIn = 0.8;         // from level flight to that [s]
constexpr double kSpeedReserve = 0.05;  // of the range of speeds, at both ends

// A follower as a point that flies within its limits.
class Follower {
 public:
  Follower(const NavEstimate& own, const FlightLimits& limits)
      : limits_(limits), wind_(own.wind_N), p_(own.p_N), climb_(-own.v_N.z()) {
    const double reserve = kSpeedReserve * (limits.fastest - limits.slowest);
    fastest_ = limits.fastest - reserve;
    slowest_ = hovers() ? 0 : limits.slowest + reserve;
    air_ = geo::horizontal(own.v_N) - wind_;
    if (air_.norm() < 1) air_ = geo::unit(own.heading);
    if (hovers() && geo::horizontal(own.v_N).norm() < 1) air_ = -wind_;
    const double speed = air_.norm();
    air_ *= std::clamp(speed, slowest_, fastest_) / std::max(speed, 1e-9);
    max_lateral_ = kTurnReserve * limits.airspeed * limits.airspeed /
                   std::max(limits.turn_radius, 1.0);
    climb_ = bounded_climb(climb_);
    deceleration_ = kIdle * limits.sink_rate * kGravity / std::max(limits.airspeed, 1.0);
    const double max = max_lateral_ / std::max(air_.norm(), 1.0);
    const double roll = std::clamp(own.roll, -1.0, 1.0);
    rate_ =
        std::clamp(kGravity * math::tan(roll) / std::max(air_.norm(), 1.0), -max, max);
  }

  const Vec3& place() const { return p_; }
  Vec3 velocity() const {
    const Vec2 v = air_ + wind_;
    return {v.x(), v.y(), -climb_};
  }

  // At once as fast as it shall be: autopilots speed up towards their plan's speed, and
  // a plan that begins at the present speed would ask for nothing.
  void begin(const PlanPoint& slot) {
    if (!hovers()) air_ = speed_for(to_slot(slot)) * air_.normalized();
  }

  void step(const PlanPoint& slot) {
    const Vec2 setpoint = to_slot(slot);
    const Vec2 before = air_;
    if (hovers())
      move(setpoint);
    else
      turn(setpoint);
    const Vec2 v = (before + air_) / 2 + wind_;
    const double rise = -slot.p_N.z() + p_.z();
    const double change = bounded_climb(-slot.v_N.z() + kClimbGain * rise) - climb_;
    climb_ += std::clamp(change, -kClimbChange * kStep, kClimbChange * kStep);
    p_ += kStep * Vec3(v.x(), v.y(), -climb_);
  }

 private:
  bool hovers() const { return limits_.slowest <= 0; }
  double bounded_climb(double climb) const {
    return std::clamp(climb, -kClimbReserve * limits_.sink_rate,
                      kClimbReserve * limits_.climb_rate);
  }

  // The air-relative velocity that leads into the slot.
  Vec2 to_slot(const PlanPoint& slot) const {
    const Vec2 v = geo::horizontal(slot.v_N);
    const Vec2 off = geo::horizontal(slot.p_N) - geo::horizontal(p_);
    if (hovers() || v.norm() < 1) {
      const Vec2 closing = kAheadGain * off;
      const double max = fastest_ / 2;
      return v - wind_ + closing * std::min(1.0, max / std::max(closing.norm(), 1e-9));
    }
    const Vec2 forward = v.normalized(), right = geo::turned_right(forward);
    const double max = kMaxAcross * v.norm();
    // Beyond what the speeds allow there is no more to ask for.
    const double along = off.dot(forward);
    const double closing =
        std::min(kAheadGain * std::abs(along),
                 std::sqrt(2 * kSlowsEarly * deceleration_ * std::abs(along)));
    const double ahead = std::copysign(std::min(closing, fastest_ - slowest_), along);
    const double across = std::clamp(kRightGain * off.dot(right), -max, max);
    return v - wind_ + ahead * forward + across * right;
  }

  // The radius of a turn grows with the square of the speed: what is fast in a turn comes
  // out of it far outside.
  double speed_for(const Vec2& setpoint) const {
    const double off =
        std::abs(geo::wrap_pi(geo::bearing(setpoint) - geo::bearing(air_)));
    const double max = off > kTurns ? std::min(limits_.airspeed, fastest_) : fastest_;
    return std::clamp(setpoint.norm(), slowest_, std::max(max, slowest_));
  }

  void turn(const Vec2& setpoint) {
    const double speed = air_.norm(), heading = geo::bearing(air_);
    const double max = max_lateral_ / std::max(speed, 1.0);
    const double rate = std::clamp(
        kCourseGain * geo::wrap_pi(geo::bearing(setpoint) - heading), -max, max);
    const double roll_in = max * kStep / kRollIn;
    rate_ = std::clamp(rate_ + std::clamp(rate - rate_, -roll_in, roll_in), -max, max);
    const double faster = speed_for(setpoint) - speed;
    const double change =
        std::clamp(faster, -deceleration_ * kStep, kAcceleration * kStep);
    air_ = std::clamp(speed + change, slowest_, fastest_) *
           geo::unit(heading + rate_ * kStep);
  }

  void move(const Vec2& setpoint) {
    const Vec2 change = setpoint - air_;
    air_ += change * std::min(1.0, kHoverMoves * kStep / std::max(change.norm(), 1e-9));
    air_ *= std::min(1.0, fastest_ / std::max(air_.norm(), 1e-9));
  }

  FlightLimits limits_;
  Vec2 wind_, air_;
  Vec3 p_;
  double climb_, rate_ = 0;
  double slowest_, fastest_, max_lateral_, deceleration_;
};

}  // namespace

PlanPoint slot_at(const LeaderMotion& leader, const Vec2& offset, double after) {
  const Vec2 velocity = geo::horizontal(leader.at.v_N);
  const double course = geo::bearing(velocity), speed = velocity.norm();
  const double turned = std::clamp(leader.turn_rate * after, -kMaxTurned, kMaxTurned);
  const bool turns = turned == leader.turn_rate * after;
  const double turning = turns ? after : turned / leader.turn_rate;
  // Chord of the arc: speed at sin(turned/2) / (turned/2), along the mean course.
  const double half = turned / 2;
  const double chord =
      speed * turning * (std::abs(half) < 1e-6 ? 1 : math::sin(half) / half);
  const Vec2 forward = geo::unit(course + turned);
  const Vec2 right = geo::turned_right(forward);
  const Vec2 p = geo::horizontal(leader.at.p_N) + chord * geo::unit(course + half) +
                 speed * (after - turning) * forward + offset.x() * forward +
                 offset.y() * right;
  const double rate = turns ? leader.turn_rate : 0;
  const Vec2 v = speed * forward + rate * (offset.x() * right - offset.y() * forward);
  const double climbing = std::min(after, kClimbs);
  return {leader.at.time + Time::from_seconds(after),
          Vec3(p.x(), p.y(), leader.at.p_N.z() + climbing * leader.at.v_N.z()),
          Vec3(v.x(), v.y(), after < kClimbs ? leader.at.v_N.z() : 0)};
}

Plan plan_to_slot(const NavEstimate& own, const LeaderMotion& leader, const Vec2& offset,
                  const FlightLimits& limits, double horizon) {
  const double age = (own.time - leader.at.time).seconds();
  Follower follower(own, limits);
  follower.begin(slot_at(leader, offset, age));
  Plan plan = {{own.time, follower.place(), follower.velocity()}};
  const int points = std::max(1, static_cast<int>(horizon / (kStep * kStepsAPoint)));
  for (int k = 0; k < points * kStepsAPoint; ++k) {
    follower.step(slot_at(leader, offset, age + k * kStep));
    if ((k + 1) % kStepsAPoint == 0)
      plan.push_back({own.time + Time::from_seconds((k + 1) * kStep), follower.place(),
                      follower.velocity()});
  }
  return plan;
}

}  // namespace skein::reasoning
