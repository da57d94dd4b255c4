// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "skein/data/vehicle/vehicle_request.h"
#include "skein/geo/local_frame.h"
#include "skein/link/mavlink/constants.h"
#include "skein/link/mavlink/frame.h"
#include "skein/link/vehicle_services/outbox.h"
#include "skein/link/vehicle_services/vehicle_snapshot.h"

namespace skein::vehicle_services {

/// A simulated aircraft as ground stations see it: a MAVLink vehicle.
///
/// It is a state machine without I/O. Whoever owns it hands in what the simulation says
/// (`update`) and what comes over links (`receive`), calls `step` some fifty times a
/// second, and hands to the simulation what ground stations ask for (`take_requests`).
/// All calls are made by one thread. It is not for signatures: see LinkSecurity.
///
/// Heartbeats and time-outs go by the wall clock, telemetry by the run's. Every ground
/// station may command. What is asked for is judged by the last snapshot, and for a few
/// seconds by what was asked for before and does not show in it yet. What each part does
/// is in docs/links.md.
///
/// Memory is bounded, whatever comes in. Telemetry allocates nothing.
class VehicleServer {
 public:
  /// @param frame  the run's local frame; altitudes above mean sea level are heights in
  ///               it, since a run makes no difference between sea level and ellipsoid.
  VehicleServer(const VehicleServerOptions& options, const geo::LocalFrame& frame);
  ~VehicleServer();
  VehicleServer(VehicleServer&&) noexcept;
  VehicleServer& operator=(VehicleServer&&) noexcept;

  /// What the simulation says, after each of its steps. Before the first there are only
  /// heartbeats, and commands are refused.
  void update(const VehicleSnapshot& snapshot);

  /// A link is there. Frames of links that are not open are passed over.
  void open(Channel channel, const Clocks& now);
  /// It is gone; Outbox::close() is the caller's business.
  void close(Channel channel);

  /// Takes in a frame. One that is for another system, or of no kind that concerns a
  /// vehicle, costs next to nothing.
  void receive(const mavlink::Frame& frame, Channel channel, const Clocks& now,
               Outbox& out);

  /// Sends what is due: of each stream of telemetry at most one message.
  void step(const Clocks& now, Outbox& out);

  /// What ground stations asked for and was accepted since the last call, in order.
  ///
  /// A setpoint that was not taken before the next came is left out. A mission, or a
  /// take-off mode, that is asked for on the ground before arming begins when the vehicle
  /// is armed. ModeRequest(kMission) goes on with the present item, MissionStart begins
  /// at one.
  std::vector<VehicleRequest> take_requests();

  /// Home as a ground station has set it since the last call; only where the options let
  /// it be set.
  std::optional<Vec3> take_home();

  const Fence& fence() const;
  /// Of a name; null without one.
  const Parameter* parameter(std::string_view name) const;

  /// Says something to the people at all ground stations.
  void say(mavlink::Severity severity, std::string text);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace skein::vehicle_services
