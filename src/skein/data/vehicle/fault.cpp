// SPDX-License-Identifier: Apache-2.0
#include "skein/data/vehicle/fault.h"

namespace skein {

std::string text_of(const VehicleFault& fault) {
  switch (fault.kind) {
    case VehicleFault::Kind::kMotor:
      return fault.name + " stands";
    case VehicleFault::Kind::kServoStuck:
      return fault.name + " is stuck";
    case VehicleFault::Kind::kServoLoose:
      return fault.name + " is loose";
    case VehicleFault::Kind::kSensor:
    case VehicleFault::Kind::kPayload:
      return fault.name + " is silent";
    case VehicleFault::Kind::kBattery:
      return "the battery gives nothing";
    case VehicleFault::Kind::kLink:
      return "the radio link is down";
  }
  return {};
}

std::string text_of_end(const VehicleFault& fault) {
  switch (fault.kind) {
    case VehicleFault::Kind::kBattery:
      return "the battery works again";
    case VehicleFault::Kind::kLink:
      return "the radio link works again";
    default:
      return fault.name + " works again";
  }
}

}  // namespace skein
