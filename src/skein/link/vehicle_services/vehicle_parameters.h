// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/link/vehicle_services/parameter_service.h"
#include "skein/link/vehicle_services/served_vehicle.h"

namespace skein::vehicle_services {

/// The parameters of a vehicle, by the names of its make: those that do something, and
/// facts that cannot be changed; then those of the options.
ParameterService make_parameters(ServedVehicle& vehicle);

/// The name of the one by which the fence is switched on and off.
const char* fence_parameter(Make make);

}  // namespace skein::vehicle_services
