// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "skein/data/vehicle/pilot.h"
#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/served_vehicle.h"

namespace skein::vehicle_services {

/// A safety pilot at a ground station: sticks that come over the link, as channels of a
/// transmitter (RC_CHANNELS_OVERRIDE: roll, pitch, throttle, yaw) or as a joystick
/// (MANUAL_CONTROL).
///
/// In the manual mode sticks move the actuators, in stabilized mode they say the
/// attitude. In all others they lie idle, until one of roll, pitch or yaw is moved by 30
/// % or more of its way: then the pilot has taken over, in stabilized mode. The pilot
/// hands back by releasing the channels, by three seconds of silence, or when another
/// mode than the manual and stabilized ones is commanded; to take over again, the sticks
/// must have been centred once.
class PilotOverride {
 public:
  void handle(const mavlink::RcChannelsOverride& channels, ServedVehicle& vehicle);
  void handle(const mavlink::ManualControl& joystick, ServedVehicle& vehicle);

  /// Hands back when nothing was heard for too long.
  void step(ServedVehicle& vehicle);

  /// Another mode is commanded: hands back.
  void give_up(ServedVehicle& vehicle);

  /// The pilot flies.
  bool flies() const { return flies_; }

 private:
  void take(const PilotInput& sticks, ServedVehicle& vehicle);
  void release(ServedVehicle& vehicle);

  bool flies_ = false;
  bool by_mode_ = false;  // because of the mode that the vehicle was in
  bool centred_ = true;   // since the pilot flew last
  PilotInput last_;
  Time heard_;  // by the wall clock
};

}  // namespace skein::vehicle_services
