#include "skein/link/vehicle_links/vehicle_links.h"

#include <fmt/format.h>

#include <utility>

namespace skein::vehicle_links {
namespace {

// Of what speaks for the simulation: no ground station's, so that autopilots do not take
// its silence for the loss of their pilots.
constexpr std::uint8_t kOwnSystem = 245;
constexpr std::uint8_t kOwnComponent = 191;  // an on-board computer

constexpr std::chrono::milliseconds kTurn{10};
const Time kHealthPeriod = Time::from_seconds(5);

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
      out_(kOwnSystem, kOwnComponent,
           [this](transport::ChannelId channel, std::span<const std::byte> bytes) {
             send(channel, bytes);
           }),
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

transport::EndpointId VehicleLinks::endpoint_of(
    const transport::EndpointAddress& address) {
  const std::string text = transport::text_of(address);
  for (std::size_t k = 0; k < planned_.size(); ++k)
    if (transport::text_of(planned_[k].address) == text)
      return static_cast<transport::EndpointId>(k);
  planned_.push_back({address, false});
  return static_cast<transport::EndpointId>(planned_.size() - 1);
}

Result<std::size_t> VehicleLinks::add(const LinkedVehicle& vehicle) {
  const transport::EndpointId endpoint = endpoint_of(vehicle.endpoint);
  for (const auto& other : vehicles_)
    if (other->endpoint == endpoint && other->client.system() == vehicle.client.system)
      return Error{ErrorCode::kBadInput, transport::text_of(vehicle.endpoint),
                   fmt::format("two vehicles have number {} there.",
                               vehicle.client.system),
                   "Give each a system of its own."};
  vehicles_.push_back(std::make_unique<Vehicle>(vehicle.client, frame_, endpoint));
  return vehicles_.size() - 1;
}

void VehicleLinks::add_station(const transport::EndpointAddress& address) {
  planned_[endpoint_of(address)].station = true;
}

std::unique_ptr<VehiclePort> VehicleLinks::port(std::size_t vehicle) {
  return std::make_unique<Port>(*this, vehicles_.at(vehicle)->mailbox);
}

Result<std::vector<std::string>> VehicleLinks::start() {
  for (const Planned& planned : planned_)
    if (auto opened = endpoints_.open(planned.address); !opened) return opened.error();
  std::vector<std::string> places = endpoints_.places();
  thread_ = std::thread([this] { run(); });
  return places;
}

void VehicleLinks::run() {
  while (!stop_) {
    endpoints_.run_for(kTurn);
    step(now());
  }
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
  peer.station = planned_[endpoint].station;
  router_.open(channel);
  for (const auto& vehicle : vehicles_)
    if (vehicle->endpoint == endpoint) vehicle->client.open(channel);
}

void VehicleLinks::closed(transport::ChannelId channel, const std::string&) {
  for (const auto& vehicle : vehicles_) vehicle->client.close(channel);
  router_.close(channel);
  out_.close(channel);
  peers_.erase(channel);
}

void VehicleLinks::received(transport::ChannelId channel,
                            std::span<const std::byte> bytes) {
  const Time arrived = now();
  Peer& peer = peers_.at(channel);
  peer.parser.read(bytes, [&](const mavlink::Frame& frame) {
    if (!peer.station)
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
