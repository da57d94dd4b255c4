// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/landing_flight.h"

#include <fmt/format.h>

#include <utility>

namespace skein::reasoning {
namespace {

constexpr double kNearlyDown = 10;  // above the ground: a landing is finished [m]

}  // namespace

void LandingFlight::step(const TrajectoryStep& step, AgentOutput& out) {
  if (commanded_ && !step.zones_changed) return;
  const Vec2 place = step.returns.allowed(landing_.place);
  const double ground = map_.elevation_msl(place);
  const bool nearly_down = -step.in.nav->p_N.z() - ground < kNearlyDown;
  if (commanded_ && (place == *commanded_ || nearly_down)) return;
  commanded_ = place;
  if (place != landing_.place)
    out.events.push_back({step.in.now, self_, EventKind::kReturnMoved,
                          fmt::format("lands at {:.0f} m north, {:.0f} m east, out of a "
                                      "no-fly zone",
                                      place.x(), place.y())});
  AutopilotCommand command;
  command.altitude_msl = landing_.altitude_msl;
  command.guidance = Land{place, ground, landing_.course};
  out.command = std::move(command);
}

}  // namespace skein::reasoning
