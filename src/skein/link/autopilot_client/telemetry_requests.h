// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "skein/base/time.h"
#include "skein/link/autopilot_client/command_sender.h"
#include "skein/link/mavlink/flight_modes.h"

namespace skein::autopilot_client {

/// Asks a vehicle for what its telemetry is to be: messages at rates, its home while that
/// is not known, and every 10 s what its board is, since two boards that answer are two
/// vehicles. Apart from commands: neither waits for the other.
class TelemetryRequests {
 public:
  /// @param rate  of its motion [Hz].
  TelemetryRequests(std::uint8_t system, double rate) : sender_(system), rate_(rate) {}

  /// Asks for all, of a vehicle that has just been heard or has rebooted.
  void begin(mavlink::Make make, Time now);

  /// Sends what is due.
  void step(Time now, bool home_is_known, vehicle_services::Channel channel,
            vehicle_services::Outbox& out);
  void handle(const mavlink::CommandAck& ack, Time now) { sender_.handle(ack, now); }

  /// The vehicle is gone.
  void abandon(const std::string& why) { sender_.abandon(why); }

 private:
  void set_interval(std::uint32_t message, double interval_us);
  void request(std::uint32_t message);

  CommandSender sender_;
  double rate_;
  Time home_due_, version_due_;
};

}  // namespace skein::autopilot_client
