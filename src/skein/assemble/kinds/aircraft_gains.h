// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "skein/layer/autopilot/control/fixed_wing_gains.h"
#include "skein/layer/autopilot/control/multirotor_gains.h"
#include "skein/scenario/choice.h"

namespace skein::assemble {

/// What an aircraft file says of its autopilot's gains; none: the autopilot's own.
struct AircraftGains {
  std::optional<autopilot::FixedWingGains> wing;
  std::optional<autopilot::MultirotorGains> rotors;
};

/// The gains that come with a plant, as its aircraft file has them.
AircraftGains gains_of(const scenario::Choice& plant);

}  // namespace skein::assemble
