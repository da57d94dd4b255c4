#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/link/autopilot_client/autopilot_client.h"
#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/link_security.h"
#include "skein/link/router/frame_router.h"
#include "skein/link/transport/endpoints.h"
#include "skein/link/vehicle_links/mailbox.h"
#include "skein/link/vehicle_services/vehicle_server.h"
#include "skein/role/vehicle_port.h"

namespace skein::vehicle_links {

/// Where others are met.
struct LinkEndpoint {
  transport::EndpointAddress address;
  /// Frames are signed, and unsigned ones refused, by the key of set_key().
  bool is_signed = false;
};

/// A vehicle at the far end of an endpoint.
struct LinkedVehicle {
  LinkEndpoint endpoint;
  autopilot_client::AutopilotClientOptions client;
};

/// The links of a run to real vehicles and ground stations, in a thread of their own.
///
/// Simulated vehicles that are shown appear at the ground stations' endpoints, 250 of
/// them at each port: those beyond are at the next port. Several real vehicles may share
/// an endpoint; they are told apart by their numbers. What a vehicle sends goes to the
/// ground stations too, and what those send to the vehicle it is for: they see it as if
/// they were connected to it.
///
/// Use: add vehicles and stations, take ports, start(). Ports may be used until this
/// ends, and before start(): then nothing comes.
class VehicleLinks final : public transport::ChannelListener {
 public:
  explicit VehicleLinks(const geo::LocalFrame& frame);
  /// Ends the thread.
  ~VehicleLinks() override;

  /// @returns  its number here.
  /// Fails: kBadInput where the endpoint has a vehicle of that system already.
  Result<std::size_t> add(const LinkedVehicle& vehicle);
  void add_station(const LinkEndpoint& endpoint);
  /// A simulated vehicle that ground stations see. Its system id is the one after that of
  /// the vehicle before; that of the first is its own.
  /// @returns  its number among these.
  std::size_t show(vehicle_services::VehicleServerOptions vehicle);
  /// Whether an endpoint is signed.
  bool needs_key() const;
  /// For endpoints that are signed; before start().
  void set_key(const mavlink::SigningKey& key) { security_ = mavlink::LinkSecurity(key); }

  /// Of a vehicle that is shown; any thread may call these.
  void update(std::size_t shown, const vehicle_services::VehicleSnapshot& snapshot);
  std::vector<VehicleRequest> take_requests(std::size_t shown);
  /// The run's clock, which telemetry goes by.
  void set_simulated(Time time) { simulated_ns_ = time.ns(); }
  void set_paused(bool paused) { paused_ = paused; }

  /// The simulation's end of a vehicle, by the number that add() gave it.
  std::unique_ptr<VehiclePort> port(std::size_t vehicle);

  /// Opens the endpoints, and begins.
  /// @returns  where servers wait, with the ports that they have got.
  /// Fails: kBadInput where an endpoint cannot be opened.
  Result<std::vector<std::string>> start();

 private:
  using Clock = std::chrono::steady_clock;
  struct Vehicle;
  struct Shown;
  struct Planned {
    LinkEndpoint endpoint;
    bool station = false;
    std::uint16_t group = 0;  // of shown vehicles, for stations
  };
  struct Peer {
    mavlink::FrameParser parser;
    transport::EndpointId endpoint = 0;
    bool station = false;
    std::uint16_t group = 0;
    std::uint64_t sent = 0, dropped = 0;
  };
  class Port;

  void opened(transport::ChannelId channel, transport::EndpointId endpoint,
              const std::string& name) override;
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override;
  void closed(transport::ChannelId channel, const std::string& why) override;
  void run();
  void step(Time now);
  void step_shown(Time now);
  void serve(const Peer& peer, transport::ChannelId channel, const mavlink::Frame& frame,
             Time now);
  vehicle_services::Clocks clocks(Time now) const {
    return {now, Time::from_ns(simulated_ns_)};
  }
  void forward(transport::ChannelId from, const mavlink::Frame& frame);
  void send(transport::ChannelId channel, std::span<const std::byte> bytes);
  LinkHealth health_of(const Vehicle& vehicle) const;
  transport::EndpointId endpoint_of(const LinkEndpoint& endpoint);
  Time now() const;

  geo::LocalFrame frame_;
  Clock::time_point begin_ = Clock::now();
  std::vector<Planned> planned_;  // endpoints, by their numbers
  std::vector<std::unique_ptr<Vehicle>> vehicles_;
  std::vector<std::unique_ptr<Shown>> shown_;
  std::vector<LinkEndpoint> stations_;
  std::atomic<std::int64_t> simulated_ns_ = 0;
  std::atomic<bool> paused_ = false;
  Time shown_due_;
  std::map<transport::ChannelId, Peer> peers_;
  router::FrameRouter router_;
  std::vector<router::Channel> to_;  // used again for each frame
  mavlink::LinkSecurity security_;
  vehicle_services::Outbox out_;
  transport::Endpoints endpoints_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace skein::vehicle_links
