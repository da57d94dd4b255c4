// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "skein/assemble/kinds/kinds_of.h"

namespace skein::assemble {

inline constexpr std::string_view kFlightModelKind = "flight-model";

/// The row of vehicles whose flight model is in another program and whose autopilot and
/// sensors are here.
void add_flight_model_kind(Kinds<Vehicle, VehicleContext>& kinds);

}  // namespace skein::assemble
