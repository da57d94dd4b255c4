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
#include "skein/link/router/frame_router.h"
#include "skein/link/transport/endpoints.h"
#include "skein/link/vehicle_links/mailbox.h"
#include "skein/role/vehicle_port.h"

namespace skein::vehicle_links {

/// A vehicle at the far end of an endpoint.
struct LinkedVehicle {
  transport::EndpointAddress endpoint;
  autopilot_client::AutopilotClientOptions client;
};

/// The links of a run to real vehicles and ground stations, in a thread of their own.
///
/// Several vehicles may share an endpoint; they are told apart by their numbers. What a
/// vehicle sends goes to the ground stations too, and what those send to the vehicle it
/// is for: they see it as if they were connected to it.
///
/// Use: add vehicles and stations, take ports, start(). Ports may be used until this ends,
/// and before start(): then nothing comes.
class VehicleLinks final : public transport::ChannelListener {
 public:
  explicit VehicleLinks(const geo::LocalFrame& frame);
  /// Ends the thread.
  ~VehicleLinks() override;

  /// @returns  its number here.
  /// Fails: kBadInput where the endpoint has a vehicle of that system already.
  Result<std::size_t> add(const LinkedVehicle& vehicle);
  void add_station(const transport::EndpointAddress& endpoint);

  /// The simulation's end of a vehicle, by the number that add() gave it.
  std::unique_ptr<VehiclePort> port(std::size_t vehicle);

  /// Opens the endpoints, and begins.
  /// @returns  where servers wait, with the ports that they have got.
  /// Fails: kBadInput where an endpoint cannot be opened.
  Result<std::vector<std::string>> start();

 private:
  using Clock = std::chrono::steady_clock;
  struct Vehicle;
  struct Planned {
    transport::EndpointAddress address;
    bool station = false;
  };
  struct Peer {
    mavlink::FrameParser parser;
    transport::EndpointId endpoint = 0;
    bool station = false;
    std::uint64_t sent = 0, dropped = 0;
  };
  class Port;

  void opened(transport::ChannelId channel, transport::EndpointId endpoint,
              const std::string& name) override;
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override;
  void closed(transport::ChannelId channel, const std::string& why) override;
  void run();
  void step(Time now);
  void forward(transport::ChannelId from, const mavlink::Frame& frame);
  void send(transport::ChannelId channel, std::span<const std::byte> bytes);
  LinkHealth health_of(const Vehicle& vehicle) const;
  transport::EndpointId endpoint_of(const transport::EndpointAddress& address);
  Time now() const;

  geo::LocalFrame frame_;
  Clock::time_point begin_ = Clock::now();
  std::vector<Planned> planned_;  // endpoints, by their numbers
  std::vector<std::unique_ptr<Vehicle>> vehicles_;
  std::map<transport::ChannelId, Peer> peers_;
  router::FrameRouter router_;
  std::vector<router::Channel> to_;  // used again for each frame
  vehicle_services::Outbox out_;
  transport::Endpoints endpoints_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace skein::vehicle_links
