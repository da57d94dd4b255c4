// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/vehicle_server.h"

#include <utility>

#include "skein/link/vehicle_services/announcements.h"
#include "skein/link/vehicle_services/guided_inputs.h"
#include "skein/link/vehicle_services/message_dispatch.h"

namespace skein::vehicle_services {

struct VehicleServer::Parts {
  Parts(const VehicleServerOptions& options, const geo::LocalFrame& frame)
      : targets(options, frame) {}

  ServedVehicle& vehicle() { return targets.vehicle; }

  MessageTargets targets;
  Announcements announcements;
};

VehicleServer::VehicleServer(const VehicleServerOptions& options,
                             const geo::LocalFrame& frame)
    : parts_(std::make_unique<Parts>(options, frame)) {}
VehicleServer::~VehicleServer() = default;
VehicleServer::VehicleServer(VehicleServer&&) noexcept = default;
VehicleServer& VehicleServer::operator=(VehicleServer&&) noexcept = default;

void VehicleServer::update(const VehicleSnapshot& snapshot) {
  parts_->vehicle().update(snapshot);
  parts_->targets.lists.update_home();
}

void VehicleServer::open(Channel channel, const Clocks& now) {
  close(channel);
  parts_->vehicle().now = now;
  parts_->announcements.open(channel, now.wall);
  parts_->targets.streams.open(channel, now.simulated);
}

void VehicleServer::close(Channel channel) {
  parts_->announcements.close(channel);
  parts_->targets.streams.close(channel);
  parts_->targets.parameters.close(channel);
  parts_->targets.lists.close(channel);
  parts_->targets.commands.close(channel);
}

void VehicleServer::receive(const mavlink::Frame& frame, Channel channel,
                            const Clocks& now, Outbox& out) {
  Parts& parts = *parts_;
  if (!concerns(frame, parts.vehicle().options)) return;
  if (!parts.announcements.is_open(channel)) return;
  parts.vehicle().now = now;
  dispatch(frame, channel, parts.targets, out);
  parts.announcements.send_texts(parts.vehicle(), out);
}

void VehicleServer::step(const Clocks& now, Outbox& out) {
  Parts& parts = *parts_;
  ServedVehicle& vehicle = parts.vehicle();
  vehicle.now = now;
  parts.targets.pilot.step(vehicle);
  step_guided(vehicle);
  parts.targets.commands.step(parts.targets, out);
  parts.targets.lists.step(out);
  parts.targets.parameters.step(now.wall, out);
  parts.announcements.step(vehicle, out);
  if (vehicle.known) parts.targets.streams.step(vehicle, out);
}

std::vector<VehicleRequest> VehicleServer::take_requests() {
  return parts_->vehicle().requests.take();
}

std::optional<Vec3> VehicleServer::take_home() {
  return std::exchange(parts_->vehicle().home_setpoint, std::nullopt);
}

const Fence& VehicleServer::fence() const {
  return parts_->targets.vehicle.fence;
}

const Parameter* VehicleServer::parameter(std::string_view name) const {
  return parts_->targets.parameters.find(name);
}

void VehicleServer::say(mavlink::Severity severity, std::string text) {
  parts_->vehicle().say(severity, std::move(text));
}

}  // namespace skein::vehicle_services
