#pragma once

#include "layer/autopilot/control/fixed_wing_gains.h"
#include "layer/autopilot/control/multirotor_gains.h"
#include "scenario/fields.h"

namespace skein::assemble {

// How the gains of the control loops are written in files.
scenario::Fields<autopilot::FixedWingGains> fixed_wing_gains_fields();
scenario::Fields<autopilot::MultirotorGains> multirotor_gains_fields();

}  // namespace skein::assemble
