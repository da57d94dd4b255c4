// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/launch.h"

#include <utility>

namespace skein::reasoning {
namespace {

constexpr double kReportAgain = 20;  // longer than any run [s]
constexpr double kSettle = 5;        // at rest: the estimator finds its errors [s]
constexpr double kArrival = 8;       // of the altitude, counted as reached [m]

}  // namespace

bool Launch::takes_off(const AgentInput& in, double altitude, AgentOutput& out) {
  if (state_ == State::kFlies) return false;
  const bool first = state_ == State::kNew;
  const bool up = !in.autopilot.on_ground &&
                  (in.autopilot.done || -in.nav->p_N.z() >= altitude - kArrival);
  if (first ? !in.autopilot.on_ground : up) {
    state_ = State::kFlies;
    return false;
  }
  if (first) order_at_ = in.now + Time::from_seconds(kSettle);
  state_ = State::kTakesOff;
  if (in.autopilot.on_ground && in.now >= order_at_) {
    AutopilotCommand command;
    command.guidance = TakeOff{in.nav->heading};
    command.altitude_msl = altitude;
    out.command = std::move(command);
    order_at_ = in.now + Time::from_seconds(kReportAgain);
  }
  return true;
}

}  // namespace skein::reasoning
