#include "data/fault.h"

namespace skein {

std::string text_of(const VehicleFault& fault) {
  const std::string part = std::to_string(fault.part);
  switch (fault.kind) {
    case VehicleFault::Kind::kMotor:
      return "motor on channel " + part;
    case VehicleFault::Kind::kServoStuck:
      return "servo on channel " + part + " stuck";
    case VehicleFault::Kind::kServoLoose:
      return "servo on channel " + part + " loose";
    case VehicleFault::Kind::kSensor:
      return "sensor " + part + " silent";
    case VehicleFault::Kind::kPayload:
      return "payload sensor " + part + " silent";
    case VehicleFault::Kind::kBattery:
      return "battery";
    case VehicleFault::Kind::kLink:
      return "radio link";
  }
  return {};
}

}  // namespace skein
