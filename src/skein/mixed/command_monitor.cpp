#include "skein/mixed/command_monitor.h"

#include <fmt/format.h>

#include <cmath>

#include "skein/geo/rotation.h"

namespace skein::mixed {
namespace {

constexpr double kPatience = 15;         // [s]
constexpr double kClimbPatience = 30;    // [s]
constexpr double kClimbStep = 1;         // that is a climb [m]
constexpr double kObeyedPatience = 30;   // with setpoints, once it has obeyed some [s]
constexpr double kFar = 10;              // from a setpoint: it has to come nearer [m]
constexpr double kMinSetpointSpeed = 2;  // below it none is expected to move [m/s]
constexpr double kMinShare = 0.25;       // of the speed of a setpoint, along it
constexpr double kMinNearing = 0.5;      // towards a setpoint that is far [m/s]
constexpr double kBankMoved = 0.15;      // [rad]
const Time kJudged = Time::from_seconds(1);  // after a setpoint

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
    return {};
  }
  if (lasts(kPosition, !in.position || in.jumped, now, kPatience))
    return in.jumped ? "its position has jumped"
                     : fmt::format("its last position is {:.0f} s old", in.position_age);
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
  const bool astray = in.guided && astray_ && now - judged_ < kJudged;
  if (lasts(kSetpoints, astray, now, obeyed_ ? kObeyedPatience : kPatience))
    return "it does not obey its setpoints";
  return {};
}

void CommandMonitor::follows(bool follows, Time now) {
  obeyed_ = obeyed_ || follows;
  astray_ = !follows;
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
