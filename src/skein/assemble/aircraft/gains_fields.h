// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/autopilot/control/fixed_wing_gains.h"
#include "skein/layer/autopilot/control/multirotor_gains.h"
#include "skein/scenario/fields.h"

namespace skein::assemble {

// How the gains of the control loops are written in files.
scenario::Fields<autopilot::FixedWingGains> fixed_wing_gains_fields();
scenario::Fields<autopilot::MultirotorGains> multirotor_gains_fields();

}  // namespace skein::assemble
