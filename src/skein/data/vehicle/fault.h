// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "skein/base/time.h"

namespace skein {

/// A part of a vehicle that does not work for a while.
struct VehicleFault {
  enum class Kind : std::uint8_t {
    kMotor,       ///< actuator `part` is a motor that gives nothing
    kServoStuck,  ///< actuator `part` stays where it is
    kServoLoose,  ///< actuator `part` is a surface that swings freely
    kSensor,      ///< sensor `part` of the vehicle says nothing
    kPayload,     ///< payload sensor `part` says nothing
    kBattery,     ///< the battery gives nothing
    kLink,        ///< no message goes in or out
  };
  Kind kind = Kind::kMotor;
  std::size_t part = 0;
  Time at;
  Time until;             ///< exclusive
  std::string name = {};  ///< of the part, for people: "motor 2", "sensor imu"

  bool active(Time now) const { return at <= now && now < until; }
};

/// What has failed, in words.
std::string text_of(const VehicleFault& fault);
/// The same of its end.
std::string text_of_end(const VehicleFault& fault);

}  // namespace skein
