// SPDX-License-Identifier: Apache-2.0
#include "skein/mixed/command_monitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "skein/geo/rotation.h"

namespace skein::mixed {
namespace {

constexpr double kPatience = 15;         // [s]
constexpr double kJumpPatience = 3;      // until it has jumped back [s]
constexpr double kClimbPatience = 30;    // [s]
constexpr double kClimbStep = 1;         // that is a climb [m]
constexpr double kObeyedPatience = 30;   // with setpoints, once it has obeyed some [s]
constexpr double kFar = 10;              // from a setpoint: it has to come nearer [m]
constexpr double kMinSetpointSpeed = 2;  // below it none is expected to move [m/s]
constexpr double kMinShare = 0.25;       // of the speed of a setpoint, along it
constexpr double kMinNearing = 0.5;      // towards a setpoint that is far [m/s]
constexpr double kBankMoved = 0.15;      // [rad]
constexpr double kJudged = 0.5;          // that a setpoint counts for, at most [s]

}  // namespace

bool CommandMonitor::lasts(Reason reason, bool fails, Time now, double limit) {
  auto& since = since_[reason];
  if (!fails) {
    since.reset();
    return false;
  }
  if (!since) since = now;
  return now - *since > Time::from_seconds(limit);
}

std::string CommandMonitor::step(Time now, const Inputs& in) {
  if (!in.leads) {
    since_ = {};
    highest_ = -1e9;
    astray_ = 0;
    return {};
  }
  if (lasts(kJump, in.jumped, now, kJumpPatience)) return "its position has jumped";
  if (lasts(kPosition, !in.position, now, kPatience))
    return fmt::format("its last position is {:.0f} s old", in.position_age);
  if (lasts(kMode, !in.taking_off && !in.guided, now, kPatience))
    return fmt::format("it stays in {}", in.mode_name);
  const bool climbs = in.altitude_msl > highest_ + kClimbStep;
  if (climbs) highest_ = in.altitude_msl;
  if (!in.taking_off) highest_ = -1e9;
  if (lasts(kClimb, in.taking_off && !climbs, now, kClimbPatience))
    return fmt::format(
        "it has stopped climbing at {:.0f} m above mean sea level, {:.0f} m "
        "was commanded",
        in.altitude_msl, in.climbs_to);
  if (astray_ > (obeyed_ ? kObeyedPatience : kPatience))
    return "it does not obey its setpoints";
  return {};
}

void CommandMonitor::follows(bool follows, Time now) {
  obeyed_ = obeyed_ || follows;
  const double since = (now - judged_).seconds();
  astray_ = follows ? 0 : astray_ + std::min(since, kJudged);
  judged_ = now;
}

void CommandMonitor::sent(Time now, const TrackSetpoint& setpoint,
                          const VehicleMotion& motion) {
  const double speed = setpoint.v_N.norm();
  if (speed >= kMinSetpointSpeed)
    return follows(setpoint.v_N.dot(motion.v_N) / speed > kMinShare * speed, now);
  const Vec3 off = setpoint.p_N - motion.p_N;
  const double distance = off.norm();
  if (distance > kFar) follows(off.dot(motion.v_N) / distance > kMinNearing, now);
}

void CommandMonitor::sent(Time now, const BankSetpoint& setpoint,
                          const VehicleMotion& motion) {
  if (std::abs(setpoint.roll) < 2 * kBankMoved) return;
  const double roll = geo::to_euler(motion.q_NB).roll;
  follows(roll * setpoint.roll > kBankMoved * std::abs(setpoint.roll), now);
}

}  // namespace skein::mixed
