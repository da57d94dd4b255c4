#include "skein/link/vehicle_links/vehicle_links.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "skein/link/vehicle_services/vehicle_numbers.h"

namespace skein::vehicle_links {
namespace {

// Of what speaks for the simulation: no ground station's, so that autopilots do not take
// its silence for the loss of their pilots.
constexpr std::uint8_t kOwnSystem = 245;
constexpr std::uint8_t kOwnComponent = 191;  // an on-board computer

constexpr std::chrono::milliseconds kTurn{10};
const Time kHealthPeriod = Time::from_seconds(5);
const Time kShownPeriod = Time::from_seconds(0.02);
constexpr std::size_t kMaxRequests = 1000;  // of a vehicle, while nobody takes them

std::int64_t unix_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

struct VehicleLinks::Vehicle {
  Vehicle(const autopilot_client::AutopilotClientOptions& options,
          const geo::LocalFrame& frame, transport::EndpointId at)
      : client(options, frame), endpoint(at) {}

  autopilot_client::AutopilotClient client;
  transport::EndpointId endpoint;
  std::shared_ptr<Mailbox> mailbox = std::make_shared<Mailbox>();
  Time health_due;
};

// A simulated vehicle. The simulation writes the snapshot and takes the requests, this
// thread does the rest.
struct VehicleLinks::Shown {
  Shown(const vehicle_services::VehicleServerOptions& options,
        const geo::LocalFrame& frame, std::uint16_t of, vehicle_services::Outbox outbox)
      : server(options, frame),
        system(options.system),
        group(of),
        out(std::move(outbox)) {}

  vehicle_services::VehicleServer server;
  std::uint8_t system;
  std::uint16_t group;
  vehicle_services::Outbox out;
  std::mutex mutex;
  vehicle_services::VehicleSnapshot snapshot;
  bool changed = false, paused = false;
  std::vector<VehicleRequest> requests;
};

class VehicleLinks::Port final : public VehiclePort {
 public:
  Port(VehicleLinks& links, std::shared_ptr<Mailbox> mailbox)
      : links_(links), mailbox_(std::move(mailbox)) {}

  // The age of a motion is what counts: the run's clock stands still in pauses.
  void receive(Time now, std::vector<VehicleReport>& out) override {
    const Time here = links_.now();
    for (VehicleReport& report : mailbox_->take_reports()) {
      if (auto* motion = std::get_if<VehicleMotion>(&report))
        motion->time = now - (here - motion->time);
      out.push_back(std::move(report));
    }
  }

  void send(std::uint32_t number, const VehicleRequest& request) override {
    mailbox_->put({number, request});
    links_.endpoints_.wake();
  }

 private:
  VehicleLinks& links_;
  std::shared_ptr<Mailbox> mailbox_;
};

VehicleLinks::VehicleLinks(const geo::LocalFrame& frame)
    : frame_(frame),
      out_(
          kOwnSystem, kOwnComponent,
          [this](transport::ChannelId channel, std::span<const std::byte> bytes) {
            send(channel, bytes);
          },
          &security_),
      endpoints_(*this) {}

VehicleLinks::~VehicleLinks() {
  stop_ = true;
  endpoints_.wake();
  if (thread_.joinable()) thread_.join();
}

Time VehicleLinks::now() const {
  return Time::from_ns(
      std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - begin_)
          .count());
}

transport::EndpointId VehicleLinks::endpoint_of(const LinkEndpoint& endpoint) {
  const std::string text = transport::text_of(endpoint.address);
  for (std::size_t k = 0; k < planned_.size(); ++k)
    if (transport::text_of(planned_[k].endpoint.address) == text)
      return static_cast<transport::EndpointId>(k);
  planned_.push_back({endpoint});
  return static_cast<transport::EndpointId>(planned_.size() - 1);
}

Result<std::size_t> VehicleLinks::add(const LinkedVehicle& vehicle) {
  const transport::EndpointId endpoint = endpoint_of(vehicle.endpoint);
  for (const auto& other : vehicles_)
    if (other->endpoint == endpoint && other->client.system() == vehicle.client.system)
      return Error{
          ErrorCode::kBadInput, transport::text_of(vehicle.endpoint.address),
          fmt::format("two vehicles have number {} there.", vehicle.client.system),
          "Give each a system of its own."};
  vehicles_.push_back(std::make_unique<Vehicle>(vehicle.client, frame_, endpoint));
  return vehicles_.size() - 1;
}

void VehicleLinks::add_station(const LinkEndpoint& endpoint) {
  stations_.push_back(endpoint);
}

std::size_t VehicleLinks::show(vehicle_services::VehicleServerOptions vehicle) {
  const std::size_t first = shown_.empty() ? vehicle.system : shown_.front()->system;
  const auto numbers = vehicle_services::numbers_of_vehicle(first - 1 + shown_.size());
  vehicle.system = numbers.system;
  vehicle_services::Outbox out(
      vehicle.system, vehicle.component,
      [this](transport::ChannelId channel, std::span<const std::byte> bytes) {
        send(channel, bytes);
      },
      &security_);
  shown_.push_back(
      std::make_unique<Shown>(vehicle, frame_, numbers.port_offset, std::move(out)));
  return shown_.size() - 1;
}

bool VehicleLinks::needs_key() const {
  return std::any_of(planned_.begin(), planned_.end(),
                     [](const Planned& p) { return p.endpoint.is_signed; }) ||
         std::any_of(stations_.begin(), stations_.end(),
                     [](const LinkEndpoint& station) { return station.is_signed; });
}

void VehicleLinks::update(std::size_t shown,
                          const vehicle_services::VehicleSnapshot& snapshot) {
  Shown& to = *shown_.at(shown);
  const std::lock_guard lock(to.mutex);
  to.snapshot = snapshot;
  to.changed = true;
}

std::vector<VehicleRequest> VehicleLinks::take_requests(std::size_t shown) {
  Shown& from = *shown_.at(shown);
  const std::lock_guard lock(from.mutex);
  return std::exchange(from.requests, {});
}

std::unique_ptr<VehiclePort> VehicleLinks::port(std::size_t vehicle) {
  return std::make_unique<Port>(*this, vehicles_.at(vehicle)->mailbox);
}

Result<std::vector<std::string>> VehicleLinks::start() {
  const std::uint16_t groups = shown_.empty()
                                   ? std::uint16_t{1}
                                   : static_cast<std::uint16_t>(shown_.back()->group + 1);
  for (const LinkEndpoint& station : stations_)
    for (std::uint16_t group = 0; group < groups; ++group) {
      LinkEndpoint at = station;
      at.address = transport::moved(at.address, group);
      Planned& planned = planned_[endpoint_of(at)];
      planned.station = true;
      planned.group = group;
    }
  for (const Planned& planned : planned_)
    if (auto opened = endpoints_.open(planned.endpoint.address); !opened)
      return opened.error();
  std::vector<std::string> places = endpoints_.places();
  thread_ = std::thread([this] { run(); });
  return places;
}

void VehicleLinks::run() {
  while (!stop_) {
    endpoints_.run_for(kTurn);
    security_.set_time(unix_ns());
    step(now());
    step_shown(now());
  }
}

void VehicleLinks::step_shown(Time now) {
  if (now < shown_due_) return;
  shown_due_ = now + kShownPeriod;
  for (const auto& shown : shown_) {
    {
      const std::lock_guard lock(shown->mutex);
      shown->snapshot.paused = paused_;
      if (std::exchange(shown->changed, false) || paused_ != shown->paused)
        shown->server.update(shown->snapshot);
      shown->paused = paused_;
    }
    shown->server.step(clocks(now), shown->out);
    std::vector<VehicleRequest> asked = shown->server.take_requests();
    if (asked.empty()) continue;
    const std::lock_guard lock(shown->mutex);
    for (VehicleRequest& request : asked)
      if (shown->requests.size() < kMaxRequests)
        shown->requests.push_back(std::move(request));
  }
}

// To the shown vehicles that a station's frame is for.
void VehicleLinks::serve(const Peer& peer, transport::ChannelId channel,
                         const mavlink::Frame& frame, Time now) {
  const std::uint8_t target = frame.target_system();
  for (const auto& shown : shown_)
    if (shown->group == peer.group && (target == 0 || target == shown->system))
      shown->server.receive(frame, channel, clocks(now), shown->out);
}

void VehicleLinks::step(Time now) {
  for (const auto& vehicle : vehicles_) {
    for (Mailbox::Request& request : vehicle->mailbox->take_requests())
      vehicle->client.request(request.number, request.what, now, out_);
    vehicle->client.step(now, out_);
    std::vector<VehicleReport> reports = vehicle->client.take_reports();
    if (vehicle->client.up() && now >= vehicle->health_due) {
      vehicle->health_due = now + kHealthPeriod;
      reports.emplace_back(health_of(*vehicle));
    }
    vehicle->mailbox->put(std::move(reports));
  }
}

LinkHealth VehicleLinks::health_of(const Vehicle& vehicle) const {
  LinkHealth health;
  health.received = vehicle.client.sequence().heard();
  health.lost = vehicle.client.sequence().lost();
  health.round_trip = vehicle.client.round_trip();
  const auto peer = peers_.find(vehicle.client.channel().value_or(0));
  if (peer == peers_.end()) return health;
  health.damaged = peer->second.parser.counts().bad_crc;
  health.sent = peer->second.sent;
  health.dropped = peer->second.dropped;
  return health;
}

void VehicleLinks::send(transport::ChannelId channel, std::span<const std::byte> bytes) {
  const auto peer = peers_.find(channel);
  if (peer == peers_.end()) return;
  ++(endpoints_.send(channel, bytes) ? peer->second.sent : peer->second.dropped);
}

void VehicleLinks::opened(transport::ChannelId channel, transport::EndpointId endpoint,
                          const std::string&) {
  Peer& peer = peers_[channel];
  peer.endpoint = endpoint;
  const Planned& planned = planned_[endpoint];
  peer.station = planned.station;
  peer.group = planned.group;
  if (planned.endpoint.is_signed)
    security_.secure(channel, static_cast<std::uint8_t>(endpoint + 1));
  router_.open(channel);
  if (peer.station)
    for (const auto& shown : shown_)
      if (shown->group == peer.group) shown->server.open(channel, clocks(now()));
  for (const auto& vehicle : vehicles_)
    if (vehicle->endpoint == endpoint) vehicle->client.open(channel);
}

void VehicleLinks::closed(transport::ChannelId channel, const std::string&) {
  for (const auto& vehicle : vehicles_) vehicle->client.close(channel);
  for (const auto& shown : shown_) {
    shown->server.close(channel);
    shown->out.close(channel);
  }
  router_.close(channel);
  security_.close(channel);
  out_.close(channel);
  peers_.erase(channel);
}

void VehicleLinks::received(transport::ChannelId channel,
                            std::span<const std::byte> bytes) {
  const Time arrived = now();
  Peer& peer = peers_.at(channel);
  peer.parser.read(bytes, [&](const mavlink::Frame& frame) {
    if (!security_.admits(channel, frame)) return;
    if (peer.station)
      serve(peer, channel, frame, arrived);
    else
      for (const auto& vehicle : vehicles_)
        if (vehicle->endpoint == peer.endpoint)
          vehicle->client.receive(frame, channel, arrived, out_);
    forward(channel, frame);
  });
  for (const auto& vehicle : vehicles_)
    if (vehicle->endpoint == peer.endpoint)
      vehicle->mailbox->put(vehicle->client.take_reports());
}

// Between vehicles and stations only: what one vehicle says is no other's business.
void VehicleLinks::forward(transport::ChannelId from, const mavlink::Frame& frame) {
  router_.route(from, frame, to_);
  const bool station = peers_.at(from).station;
  for (const router::Channel channel : to_)
    if (peers_.at(channel).station != station) send(channel, frame.bytes);
}

}  // namespace skein::vehicle_links
