// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/link/vehicle_services/pilot_override.h"
#include "skein/link/vehicle_services/served_vehicle.h"
#include "skein/link/vehicle_services/stored_lists.h"
#include "skein/link/vehicle_services/telemetry_streams.h"
#include "skein/link/vehicle_services/vehicle_parameters.h"

namespace skein::vehicle_services {

/// The parts of a VehicleServer that commands act on.
struct VehicleParts {
  VehicleParts(const VehicleServerOptions& options, const geo::LocalFrame& frame)
      : vehicle(options, frame),
        streams(options.make, options.system),
        parameters(make_parameters(vehicle)),
        lists(vehicle) {}

  ServedVehicle vehicle;
  TelemetryStreams streams;
  PilotOverride pilot;
  ParameterService parameters;
  StoredLists lists;
};

}  // namespace skein::vehicle_services
