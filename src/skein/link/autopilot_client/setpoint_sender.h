// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "skein/base/time.h"
#include "skein/data/vehicle/setpoint.h"
#include "skein/geo/local_frame.h"
#include "skein/link/autopilot_client/command_sender.h"
#include "skein/link/vehicle_services/outbox.h"

namespace skein::autopilot_client {

/// Sends what a vehicle in its guided mode follows from moment to moment, unconfirmed.
///
/// Of a bank setpoint the attitude goes out each time; the altitude when it has changed,
/// and twice a second; the airspeed, which is a command, when it has changed, once a
/// second.
class SetpointSender {
 public:
  SetpointSender(std::uint8_t system, const geo::LocalFrame& frame)
      : system_(system), frame_(frame) {}

  /// @param commands  takes the airspeed.
  void send(const BankSetpoint& setpoint, Time now, vehicle_services::Channel channel,
            vehicle_services::Outbox& out, CommandSender& commands);
  void send(const TrackSetpoint& setpoint, vehicle_services::Channel channel,
            vehicle_services::Outbox& out) const;

  /// Whatever the vehicle was sent, it may know it no longer: all goes out again.
  void forget();

 private:
  std::uint8_t system_;
  geo::LocalFrame frame_;
  std::optional<double> altitude_, airspeed_;  // sent last
  Time altitude_due_, airspeed_due_;
};

}  // namespace skein::autopilot_client
