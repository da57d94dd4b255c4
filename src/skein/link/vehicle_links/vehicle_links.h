// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "skein/base/result.h"
#include "skein/geo/local_frame.h"
#include "skein/link/autopilot_client/autopilot_client.h"
#include "skein/link/mavlink/frame_parser.h"
#include "skein/link/mavlink/link_security.h"
#include "skein/link/router/frame_router.h"
#include "skein/link/transport/endpoints.h"
#include "skein/link/vehicle_links/mailbox.h"
#include "skein/link/vehicle_links/refused_orders.h"
#include "skein/link/vehicle_links/traffic_exchange.h"
#include "skein/link/vehicle_services/vehicle_server.h"
#include "skein/role/vehicle_port.h"

namespace skein::vehicle_links {

/// Where others are met.
struct LinkEndpoint {
  transport::EndpointAddress address;
  /// Frames are signed, and unsigned ones refused, by the key of set_key().
  bool is_signed = false;
  /// What stations that do not sign may do. None: where frames are signed nothing, else
  /// all on this machine, and telemetry beyond it.
  std::optional<mavlink::UnsignedFrames> unsigned_frames = {};
};

/// A vehicle at the far end of an endpoint.
struct LinkedVehicle {
  LinkEndpoint endpoint;
  autopilot_client::AutopilotClientOptions client;
  /// The run's time as the vehicle has it [ns], which moves by the steps of its plant
  /// here; null: it goes by the wall clock.
  std::shared_ptr<const std::atomic<std::int64_t>> clock_ns = nullptr;
  std::string name = {};                       ///< as the scenario has it
  std::optional<TrafficOptions> traffic = {};  ///< that it is told of; none: of nobody
};

/// Where a simulated aircraft is.
struct SimulatedTraffic {
  Time time = {};          ///< when, by the run's clock
  std::size_t number = 0;  ///< by add_traffic()
  Vec3 p_N = Vec3::Zero();
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
};

/// The links of a run to real vehicles and ground stations, in a thread of their own.
///
/// Simulated vehicles that are shown appear at the ground stations' endpoints, 250 of
/// them at each port: those beyond are at the next port. Several real vehicles may share
/// an endpoint; they are told apart by their numbers. What a vehicle sends goes to the
/// ground stations too, and what those send to the vehicle it is for: they see it as if
/// they were connected to it. Of one another, and of simulated aircraft, vehicles are
/// told as soon as it is known where those are (TrafficExchange).
///
/// A vehicle that goes by the run's clock (LinkedVehicle::clock_ns) may move much faster
/// than the wall clock: before its port hands out what has come, the thread here has read
/// all that is there and sent all that is due. Where there is such a vehicle, all are
/// told of one another by the run's clock.
///
/// Use: add vehicles and stations, take ports, start(). Ports may be used until this
/// ends, and before start(): then nothing comes.
class VehicleLinks final : public transport::ChannelListener {
 public:
  explicit VehicleLinks(const geo::LocalFrame& frame);
  /// Ends the thread.
  ~VehicleLinks() override;

  /// @returns  its number here.
  /// Fails: kBadInput where the endpoint has a vehicle of that system already, or is
  ///        signed for one and not for another.
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

  /// A simulated aircraft that real vehicles are told of; before start().
  /// @param name  no two have the same, nor has a real vehicle.
  /// @returns  its number among these.
  std::size_t add_traffic(const std::string& name);
  /// Whether a vehicle is to be told of others.
  bool needs_traffic() const;
  /// Where simulated aircraft are now; any thread may call it.
  void update_traffic(const std::vector<SimulatedTraffic>& where);

  /// Of a vehicle that is shown; any thread may call these.
  void update(std::size_t shown, const vehicle_services::VehicleSnapshot& snapshot);
  std::vector<VehicleRequest> take_requests(std::size_t shown);
  /// Orders of ground stations that were refused; any thread may call it.
  std::vector<RefusedOrder> take_refused() { return refused_.take(); }
  /// The run's clock, which telemetry goes by.
  void set_simulated(Time time) { simulated_ns_ = time.ns(); }
  void set_paused(bool paused) { paused_ = paused; }

  /// The simulation's end of a vehicle, by the number that add() gave it.
  std::unique_ptr<VehiclePort> port(std::size_t vehicle);

  /// Where another program of this machine finds the link of a vehicle, as an endpoint of
  /// its own; after start(). Empty where the link is no network's.
  std::string far_end(std::size_t vehicle) const;

  /// Opens the endpoints, if there are any, and begins.
  /// @returns  where servers wait, with the ports that they have got.
  /// Fails: kBadInput where an endpoint cannot be opened, is for vehicles and stations,
  ///        or a simulated vehicle would have the number of a real one there.
  Result<std::vector<std::string>> start();

 private:
  using Clock = std::chrono::steady_clock;
  struct Vehicle;
  struct Shown;
  struct Planned {
    LinkEndpoint endpoint;
    bool station = false;
    std::uint16_t group = 0;                         // of shown vehicles, for stations
    std::map<std::uint8_t, Vehicle*> vehicles = {};  // by their systems
  };
  struct Peer {
    mavlink::FrameParser parser;
    transport::EndpointId endpoint = 0;
    std::string name = {};  // for people
    bool station = false;
    std::uint16_t group = 0;
    bool refused = false;  // an order, and it was said
    std::uint64_t sent = 0, dropped = 0;
    std::vector<std::byte> gathered;  // frames that go out together
    std::uint64_t gathered_frames = 0;
  };
  class Port;

  void opened(transport::ChannelId channel, transport::EndpointId endpoint,
              const std::string& name) override;
  void received(transport::ChannelId channel, std::span<const std::byte> bytes) override;
  void closed(transport::ChannelId channel, const std::string& why) override;
  void run();
  void step();
  void step_shown(Time now);
  void serve(const Peer& peer, transport::ChannelId channel, const mavlink::Frame& frame,
             Time now);
  void secure(const Planned& planned, transport::ChannelId channel,
              transport::EndpointId endpoint, bool is_local);
  void refuse(Peer& peer, transport::ChannelId channel, const mavlink::Frame& frame);
  vehicle_services::Clocks clocks(Time now) const {
    return {now, Time::from_ns(simulated_ns_)};
  }
  Result<void> same_security(const LinkEndpoint& endpoint);
  Result<void> distinct_numbers() const;
  void begin_traffic();
  void note_far_ends();
  void send_requests(Vehicle& vehicle, Time now);
  void hand_over(Vehicle& vehicle, Time now);
  void take_traffic(Time now);
  // Of what is told of other aircraft.
  Time traffic_time(Time wall, const Vehicle& vehicle) const;
  void forward(transport::ChannelId from, const mavlink::Frame& frame);
  void send(transport::ChannelId channel, std::span<const std::byte> bytes);
  void send_gathered(transport::ChannelId channel, Peer& peer);
  LinkHealth health_of(const Vehicle& vehicle) const;
  FeedHealth feeds_of(const Vehicle& vehicle) const;
  transport::EndpointId endpoint_of(const LinkEndpoint& endpoint);
  Time now() const;
  Time now(const Vehicle& vehicle) const;
  // Waits until the thread has read and sent all that there is.
  void catch_up();

  geo::LocalFrame frame_;
  Clock::time_point begin_ = Clock::now();
  std::vector<Planned> planned_;  // endpoints, by their numbers
  std::vector<std::unique_ptr<Vehicle>> vehicles_;
  std::vector<std::unique_ptr<Shown>> shown_;
  std::map<std::pair<std::uint16_t, std::uint8_t>, Shown*> shown_at_;  // group, system
  bool by_run_ = false;                     // some vehicle goes by the run's clock
  std::vector<std::string> simulated_;      // aircraft that others are told of
  std::optional<TrafficExchange> traffic_;  // once started
  std::mutex traffic_mutex_;
  std::vector<SimulatedTraffic> traffic_now_;  // from the simulation
  std::vector<SimulatedTraffic> traffic_taken_;
  std::vector<LinkEndpoint> stations_;
  std::atomic<std::int64_t> simulated_ns_ = 0;
  std::atomic<bool> paused_ = false;
  Time shown_due_;
  std::vector<std::string> far_ends_;  // of endpoints
  std::map<transport::ChannelId, Peer> peers_;
  router::FrameRouter router_;
  std::vector<router::Channel> to_;  // used again for each frame
  bool gathers_ = false;             // what is for stations
  mavlink::LinkSecurity security_;
  RefusedOrders refused_;
  vehicle_services::Outbox out_;
  transport::Endpoints endpoints_;
  std::atomic<bool> stop_ = false;
  std::mutex turn_mutex_;
  std::condition_variable turned_;
  std::uint64_t turn_asked_ = 0, turn_done_ = 0;
  std::thread thread_;
};

}  // namespace skein::vehicle_links
