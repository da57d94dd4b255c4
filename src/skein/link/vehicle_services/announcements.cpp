// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/announcements.h"

#include <algorithm>
#include <string>

#include "skein/link/mavlink/payload.h"
#include "skein/link/vehicle_services/small_services.h"
#include "skein/link/vehicle_services/telemetry.h"

namespace skein::vehicle_services {
namespace {

const Time kHeartbeatEach = Time::from_seconds(1);

std::string greeting(const ServedVehicle& vehicle) {
  std::string text = vehicle.options.name + ": simulated " +
                     (vehicle.options.hovers ? "multirotor" : "fixed wing");
  if (!vehicle.options.software.empty()) text += ", " + vehicle.options.software;
  return text;
}

}  // namespace

void Announcements::open(Channel channel, Time wall) {
  close(channel);
  links_.push_back({channel, wall, false});
}

void Announcements::close(Channel channel) {
  std::erase_if(links_, [&](const Link& link) { return link.channel == channel; });
}

bool Announcements::is_open(Channel channel) const {
  return std::ranges::find(links_, channel, &Link::channel) != links_.end();
}

void Announcements::step(ServedVehicle& vehicle, Outbox& out) {
  // A run that has begun anew is a vehicle that was switched off and on.
  if (vehicle.now.simulated < last_simulated_)
    for (Link& link : links_) link.greeted = false;
  last_simulated_ = vehicle.now.simulated;
  if (vehicle.known) send_changes(vehicle, out);
  send_heartbeats(vehicle, out);
  greet(vehicle, out);
  send_texts(vehicle, out);
}

template <class Message>
bool Announcements::send_change(Message& last, const Message& now, Outbox& out) const {
  if (shown_any_ && mavlink::pack(last) == mavlink::pack(now)) return false;
  last = now;
  send_to_all(now, out);
  return true;
}

void Announcements::send_changes(ServedVehicle& vehicle, Outbox& out) {
  if (send_change(shown_.heartbeat, heartbeat(vehicle), out))
    for (Link& link : links_) link.heartbeat = vehicle.now.wall + kHeartbeatEach;
  send_change(shown_.mode, current_mode(vehicle), out);
  send_change(shown_.landed, extended_sys_state(vehicle), out);
  for (const std::uint16_t item : vehicle.reached) {
    mavlink::MissionItemReached reached;
    reached.seq = static_cast<std::uint16_t>(item + vehicle.mission.first);
    send_to_all(reached, out);
  }
  vehicle.reached.clear();
  send_change(shown_.mission, mission_current(vehicle), out);
  if (!shown_any_ || shown_.home_N != vehicle.snapshot.home_N) {
    shown_.home_N = vehicle.snapshot.home_N;
    send_to_all(home_position(vehicle), out);
  }
  shown_any_ = true;
}

void Announcements::send_heartbeats(const ServedVehicle& vehicle, Outbox& out) {
  const Time wall = vehicle.now.wall;
  for (Link& link : links_) {
    if (wall < link.heartbeat) continue;
    out.send(link.channel, heartbeat(vehicle));
    link.heartbeat += kHeartbeatEach;
    if (link.heartbeat <= wall) link.heartbeat = wall + kHeartbeatEach;
  }
}

void Announcements::greet(const ServedVehicle& vehicle, Outbox& out) {
  for (Link& link : links_) {
    if (link.greeted) continue;
    link.greeted = true;
    send_to(link.channel,
            {static_cast<std::uint8_t>(mavlink::Severity::kInfo), greeting(vehicle)},
            out);
  }
}

void Announcements::send_to(Channel channel, const VehicleText& text, Outbox& out) {
  if (++texts_ == 0) ++texts_;
  send_text(text, texts_, channel, out);
}

void Announcements::send_texts(ServedVehicle& vehicle, Outbox& out) {
  for (const VehicleText& text : vehicle.texts)
    for (const Link& link : links_) send_to(link.channel, text, out);
  vehicle.texts.clear();
}

}  // namespace skein::vehicle_services
