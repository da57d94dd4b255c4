// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "skein/link/mavlink/messages.h"
#include "skein/link/vehicle_services/outbox.h"
#include "skein/link/vehicle_services/served_vehicle.h"

namespace skein::vehicle_services {

/// What goes out over every link of a vehicle besides telemetry: heartbeats each second
/// of the wall clock, who it is when a link begins, texts, and at once what has changed:
/// its mode, whether it is armed, in the air, at which item of its mission, and home.
class Announcements {
 public:
  void open(Channel channel, Time wall);
  void close(Channel channel);
  bool is_open(Channel channel) const;

  void step(ServedVehicle& vehicle, Outbox& out);

  /// Texts that are waiting.
  void send_texts(ServedVehicle& vehicle, Outbox& out);

 private:
  struct Link {
    Channel channel = 0;
    Time heartbeat;  // the next, by the wall clock
    bool greeted = false;
  };
  // What was sent last.
  struct Shown {
    mavlink::Heartbeat heartbeat;
    mavlink::CurrentMode mode;
    mavlink::ExtendedSysState landed;
    mavlink::MissionCurrent mission;
    Vec3 home_N = Vec3::Zero();
  };

  template <class Message>
  void send_to_all(const Message& message, Outbox& out) const {
    for (const Link& link : links_) out.send(link.channel, message);
  }
  // Sends a message where it has changed.
  template <class Message>
  bool send_change(Message& last, const Message& now, Outbox& out) const;

  void send_heartbeats(const ServedVehicle& vehicle, Outbox& out);
  void send_changes(ServedVehicle& vehicle, Outbox& out);
  void greet(const ServedVehicle& vehicle, Outbox& out);
  void send_to(Channel channel, const VehicleText& text, Outbox& out);

  std::vector<Link> links_;
  Shown shown_;
  bool shown_any_ = false;
  Time last_simulated_;
  std::uint16_t texts_ = 0;  // that were sent
};

}  // namespace skein::vehicle_services
