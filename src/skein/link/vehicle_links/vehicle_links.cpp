// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_links/vehicle_links.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "skein/base/log.h"
#include "skein/link/vehicle_services/refused_order.h"
#include "skein/link/vehicle_services/vehicle_numbers.h"

namespace skein::vehicle_links {
namespace {

// Of what speaks for the simulation: no ground station's, so that autopilots do not take
// its silence for the loss of their pilots.
constexpr std::uint8_t kOwnSystem = 245;
constexpr std::uint8_t kOwnComponent = 191;  // an on-board computer

constexpr std::chrono::milliseconds kTurn{10};
constexpr std::chrono::milliseconds kMaxTurn{100};  // that a catch-up waits
constexpr int kMaxEvents = 1000;                    // of what happens in it
const Time kHealthPeriod = Time::from_seconds(5);
const Time kShownPeriod = Time::from_seconds(0.02);
// Telemetry of many vehicles goes out in few datagrams: buffers of sockets hold some
// hundreds of them, however small.
constexpr std::size_t kMaxDatagram = 1400;
constexpr std::size_t kMaxTraffic = 20'000;  // while nobody takes it
constexpr std::size_t kMaxRequests = 1000;   // of a vehicle, while nobody takes them

std::int64_t unix_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

}  // namespace

struct VehicleLinks::Vehicle {
  Vehicle(const LinkedVehicle& linked, const geo::LocalFrame& frame,
          transport::EndpointId at, std::uint32_t of)
      : client(linked.client, frame),
        endpoint(at),
        number(of),
        name(linked.name),
        traffic(linked.traffic),
        clock_ns(linked.clock_ns) {}

  autopilot_client::AutopilotClient client;
  transport::EndpointId endpoint;
  std::uint32_t number;  // also as traffic
  std::string name;
  std::optional<TrafficOptions> traffic;
  FeedHealth feeds;  // what was left out
  FeedHealth reported;
  std::shared_ptr<Mailbox> mailbox = std::make_shared<Mailbox>();
  std::shared_ptr<const std::atomic<std::int64_t>> clock_ns;  // null: the wall's
  Time health_due;
};

// A simulated vehicle. The simulation writes the snapshot and takes the requests, this
// thread does the rest.
struct VehicleLinks::Shown {
  Shown(const vehicle_services::VehicleServerOptions& options,
        const geo::LocalFrame& frame, std::size_t which, std::uint16_t of,
        vehicle_services::Outbox outbox)
      : server(options, frame),
        number(which),
        system(options.system),
        group(of),
        out(std::move(outbox)) {}

  vehicle_services::VehicleServer server;
  std::size_t number;  // as show() gave it
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
  Port(VehicleLinks& links, std::shared_ptr<Mailbox> mailbox, bool by_run)
      : links_(links), mailbox_(std::move(mailbox)), by_run_(by_run) {}

  // The age of a motion is what counts: the run's clock stands still in pauses. Times of
  // a vehicle that goes by the run's clock are the run's.
  void receive(Time now, std::vector<VehicleReport>& out) override {
    if (by_run_) links_.catch_up();
    const Time here = by_run_ ? now : links_.now();
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
  bool by_run_;
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

Time VehicleLinks::now(const Vehicle& vehicle) const {
  return vehicle.clock_ns ? Time::from_ns(*vehicle.clock_ns) : now();
}

transport::EndpointId VehicleLinks::endpoint_of(const LinkEndpoint& endpoint) {
  const std::string text = transport::text_of(endpoint.address);
  for (std::size_t k = 0; k < planned_.size(); ++k)
    if (transport::text_of(planned_[k].endpoint.address) == text)
      return static_cast<transport::EndpointId>(k);
  planned_.push_back({endpoint});
  return static_cast<transport::EndpointId>(planned_.size() - 1);
}

// Whoever shares an endpoint shares its key.
Result<void> VehicleLinks::same_security(const LinkEndpoint& endpoint) {
  const LinkEndpoint& known = planned_[endpoint_of(endpoint)].endpoint;
  if (known.unsigned_frames != endpoint.unsigned_frames)
    return Error{ErrorCode::kBadInput, transport::text_of(endpoint.address),
                 "is an endpoint twice, with two values of unsigned.",
                 "Give the same, or each an endpoint of its own."};
  if (known.is_signed == endpoint.is_signed) return {};
  return Error{ErrorCode::kBadInput, transport::text_of(endpoint.address),
               "is an endpoint twice, once signed and once not.",
               "Say the same of both, or give each an endpoint of its own."};
}

// A ground station could not tell them apart, and would command both.
Result<void> VehicleLinks::distinct_numbers() const {
  if (stations_.empty()) return {};
  for (const auto& vehicle : vehicles_)
    for (const auto& shown : shown_)
      if (shown->system == vehicle->client.system())
        return Error{ErrorCode::kBadInput, "links.first_system",
                     fmt::format("{} has system id {}, and so would a simulated aircraft "
                                 "at the ground stations.",
                                 vehicle->name, shown->system),
                     "Choose another first_system, or another system of the vehicle."};
  return {};
}

Result<std::size_t> VehicleLinks::add(const LinkedVehicle& vehicle) {
  const transport::EndpointId endpoint = endpoint_of(vehicle.endpoint);
  if (auto fits = same_security(vehicle.endpoint); !fits) return fits.error();
  if (planned_[endpoint].vehicles.contains(vehicle.client.system))
    return Error{ErrorCode::kBadInput, transport::text_of(vehicle.endpoint.address),
                 fmt::format("two vehicles have number {} there.", vehicle.client.system),
                 "Give each a system of its own."};
  by_run_ = by_run_ || vehicle.clock_ns;
  LinkedVehicle timed = vehicle;
  timed.client.unix_ns = unix_ns() - now().ns();
  vehicles_.push_back(std::make_unique<Vehicle>(
      timed, frame_, endpoint, static_cast<std::uint32_t>(vehicles_.size())));
  planned_[endpoint].vehicles[vehicle.client.system] = vehicles_.back().get();
  return vehicles_.size() - 1;
}

std::size_t VehicleLinks::add_traffic(const std::string& name) {
  simulated_.push_back(name);
  return simulated_.size() - 1;
}

bool VehicleLinks::needs_traffic() const {
  return std::any_of(vehicles_.begin(), vehicles_.end(),
                     [](const auto& vehicle) { return vehicle->traffic.has_value(); });
}

void VehicleLinks::update_traffic(const std::vector<SimulatedTraffic>& where) {
  {
    const std::lock_guard lock(traffic_mutex_);
    traffic_now_.insert(traffic_now_.end(), where.begin(), where.end());
    if (traffic_now_.size() > kMaxTraffic) traffic_now_.clear();  // nobody takes it
  }
  endpoints_.wake();
}

// The vehicles first: their numbers are those of traffic too.
void VehicleLinks::begin_traffic() {
  double range = 1;
  for (const auto& vehicle : vehicles_)
    if (vehicle->traffic) range = std::max(range, vehicle->traffic->range);
  traffic_.emplace(frame_, range,
                   [this](std::uint32_t number, const mavlink::AdsbVehicle& message) {
                     const auto& client = vehicles_[number]->client;
                     if (const auto channel = client.channel())
                       out_.send(*channel, message);
                   });
  for (const auto& vehicle : vehicles_)
    traffic_->add(vehicle->name, false, vehicle->traffic);
  for (const std::string& name : simulated_) traffic_->add(name, true, std::nullopt);
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
  shown_.push_back(std::make_unique<Shown>(vehicle, frame_, shown_.size(),
                                           numbers.port_offset, std::move(out)));
  shown_at_[{numbers.port_offset, numbers.system}] = shown_.back().get();
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
  const Vehicle& of = *vehicles_.at(vehicle);
  return std::make_unique<Port>(*this, of.mailbox, of.clock_ns != nullptr);
}

Result<std::vector<std::string>> VehicleLinks::start() {
  if (vehicles_.empty() && stations_.empty()) return std::vector<std::string>();
  security_.set_time(unix_ns());  // before the first frame: old signatures are refused
  if (auto distinct = distinct_numbers(); !distinct) return distinct.error();
  const std::uint16_t groups = shown_.empty()
                                   ? std::uint16_t{1}
                                   : static_cast<std::uint16_t>(shown_.back()->group + 1);
  for (const LinkEndpoint& station : stations_)
    for (std::uint16_t group = 0; group < groups; ++group) {
      LinkEndpoint at = station;
      at.address = transport::moved(at.address, group);
      Planned& planned = planned_[endpoint_of(at)];
      if (!planned.vehicles.empty())
        return Error{ErrorCode::kBadInput, transport::text_of(at.address),
                     "is for a vehicle and for ground stations, which have one port for "
                     "each 250 simulated aircraft.",
                     "Give each an endpoint of its own."};
      if (auto fits = same_security(at); !fits) return fits.error();
      planned.station = true;
      planned.group = group;
    }
  for (const Planned& planned : planned_)
    if (auto opened = endpoints_.open(planned.endpoint.address); !opened)
      return opened.error();
  begin_traffic();
  note_far_ends();
  std::vector<std::string> places = endpoints_.places();
  thread_ = std::thread([this] { run(); });
  return places;
}

// Ports of servers are known only now.
void VehicleLinks::note_far_ends() {
  for (std::size_t k = 0; k < planned_.size(); ++k) {
    const std::string place = endpoints_.place(static_cast<transport::EndpointId>(k));
    const auto opened = place.empty() ? planned_[k].endpoint.address
                                      : transport::parse_endpoint(place).value();
    const auto other = transport::counterpart(opened);
    far_ends_.push_back(other ? transport::text_of(*other) : std::string());
  }
}

std::string VehicleLinks::far_end(std::size_t vehicle) const {
  return far_ends_.at(vehicles_.at(vehicle)->endpoint);
}

void VehicleLinks::run() {
  while (!stop_) {
    endpoints_.run_for(kTurn);
    security_.set_time(unix_ns());
    const std::uint64_t asked = [this] {
      const std::lock_guard lock(turn_mutex_);
      return turn_asked_;
    }();
    if (asked != turn_done_)
      for (int k = 0; k < kMaxEvents && endpoints_.run_one_for({}); ++k) {
      }
    take_traffic(now());
    step();
    step_shown(now());
    if (asked == turn_done_) continue;
    const std::lock_guard lock(turn_mutex_);
    turn_done_ = asked;
    turned_.notify_all();
  }
}

void VehicleLinks::catch_up() {
  std::unique_lock lock(turn_mutex_);
  if (!thread_.joinable()) return;
  const std::uint64_t mine = ++turn_asked_;
  endpoints_.wake();
  turned_.wait_for(lock, kMaxTurn, [&] { return turn_done_ >= mine; });
}

void VehicleLinks::step_shown(Time now) {
  if (now < shown_due_) return;
  shown_due_ = now + kShownPeriod;
  gathers_ = true;
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
  gathers_ = false;
  for (auto& [channel, peer] : peers_) send_gathered(channel, peer);
}

// To the shown vehicles that a station's frame is for.
void VehicleLinks::serve(const Peer& peer, transport::ChannelId channel,
                         const mavlink::Frame& frame, Time now) {
  const std::uint8_t target = frame.target_system();
  if (target != 0) {
    const auto shown = shown_at_.find({peer.group, target});
    if (shown != shown_at_.end())
      shown->second->server.receive(frame, channel, clocks(now), shown->second->out);
    return;
  }
  for (const auto& shown : shown_)
    if (shown->group == peer.group)
      shown->server.receive(frame, channel, clocks(now), shown->out);
}

void VehicleLinks::step() {
  for (const auto& vehicle : vehicles_) {
    const Time now = this->now(*vehicle);
    send_requests(*vehicle, now);
    vehicle->client.step(now, out_);
    std::vector<VehicleReport> reports = vehicle->client.take_reports();
    if (vehicle->client.up() && now >= vehicle->health_due) {
      vehicle->health_due = now + kHealthPeriod;
      reports.emplace_back(health_of(*vehicle));
      const FeedHealth feeds = feeds_of(*vehicle);
      if (std::exchange(vehicle->reported, feeds) != feeds) reports.emplace_back(feeds);
    }
    vehicle->mailbox->put(std::move(reports));
    if (!vehicle->client.up()) traffic_->lost(vehicle->number);
  }
}

// Of what is good for a moment only the newest goes out.
void VehicleLinks::send_requests(Vehicle& vehicle, Time now) {
  const std::vector<Mailbox::Request> requests = vehicle.mailbox->take_requests();
  bool obstacles = false, fix = false;
  std::vector<const Mailbox::Request*> kept;
  for (auto request = requests.rbegin(); request != requests.rend(); ++request) {
    if (std::holds_alternative<ObstacleDistances>(request->what)) {
      if (std::exchange(obstacles, true)) {
        ++vehicle.feeds.obstacles_limited;
        continue;
      }
    } else if (std::holds_alternative<PositionFix>(request->what)) {
      if (std::exchange(fix, true)) {
        ++vehicle.feeds.fixes_limited;
        continue;
      }
    }
    kept.push_back(&*request);
  }
  for (auto request = kept.rbegin(); request != kept.rend(); ++request)
    vehicle.client.request((*request)->number, (*request)->what, now, out_);
}

FeedHealth VehicleLinks::feeds_of(const Vehicle& vehicle) const {
  FeedHealth health = vehicle.client.feeds();
  const TrafficExchange::Counts& traffic = traffic_->counts(vehicle.number);
  health.traffic = traffic.sent;
  health.traffic_limited = traffic.limited;
  health.obstacles_limited = vehicle.feeds.obstacles_limited;
  health.fixes_limited = vehicle.feeds.fixes_limited;
  return health;
}

// What the simulation says of its aircraft.
void VehicleLinks::take_traffic(Time now) {
  {
    const std::lock_guard lock(traffic_mutex_);
    traffic_taken_.swap(traffic_now_);
  }
  const auto first = static_cast<std::uint32_t>(vehicles_.size());
  for (const SimulatedTraffic& each : traffic_taken_) {
    const Time then = by_run_ ? each.time : now;
    traffic_->moved(first + static_cast<std::uint32_t>(each.number),
                    {then, each.p_N, each.v_N}, then);
  }
  traffic_taken_.clear();
}

Time VehicleLinks::traffic_time(Time wall, const Vehicle& vehicle) const {
  if (!by_run_) return wall;
  return vehicle.clock_ns ? now(vehicle) : Time::from_ns(simulated_ns_);
}

// What a vehicle has said, to those who are near it, then to the simulation.
void VehicleLinks::hand_over(Vehicle& vehicle, Time now) {
  std::vector<VehicleReport> reports = vehicle.client.take_reports();
  const Time there = this->now(vehicle), then = traffic_time(now, vehicle);
  for (const VehicleReport& report : reports)
    if (const auto* motion = std::get_if<VehicleMotion>(&report))
      traffic_->moved(vehicle.number,
                      {then - (there - motion->time), motion->p_N, motion->v_N,
                       vehicle.client.channel()},
                      then);
  vehicle.mailbox->put(std::move(reports));
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
  if (!gathers_ || !peer->second.station) {
    ++(endpoints_.send(channel, bytes) ? peer->second.sent : peer->second.dropped);
    return;
  }
  std::vector<std::byte>& gathered = peer->second.gathered;
  if (gathered.size() + bytes.size() > kMaxDatagram) send_gathered(channel, peer->second);
  gathered.insert(gathered.end(), bytes.begin(), bytes.end());
  ++peer->second.gathered_frames;
}

void VehicleLinks::send_gathered(transport::ChannelId channel, Peer& peer) {
  if (peer.gathered.empty()) return;
  const bool sent = endpoints_.send(channel, peer.gathered);
  (sent ? peer.sent : peer.dropped) += peer.gathered_frames;
  peer.gathered.clear();
  peer.gathered_frames = 0;
}

void VehicleLinks::opened(transport::ChannelId channel, transport::EndpointId endpoint,
                          const std::string& name) {
  Peer& peer = peers_[channel];
  peer.endpoint = endpoint;
  const Planned& planned = planned_[endpoint];
  peer.station = planned.station;
  peer.group = planned.group;
  peer.name = name;
  const bool is_local = transport::is_local_channel(name);
  secure(planned, channel, endpoint, is_local);
  router_.open(channel);
  if (peer.station)
    for (const auto& shown : shown_)
      if (shown->group == peer.group) shown->server.open(channel, clocks(now()));
  for (const auto& vehicle : vehicles_)
    if (vehicle->endpoint == endpoint)
      vehicle->client.open(channel, !is_local && !planned.endpoint.is_signed);
}

// A vehicle may always report: what it is sent is no matter of its signatures.
void VehicleLinks::secure(const Planned& planned, transport::ChannelId channel,
                          transport::EndpointId endpoint, bool is_local) {
  using mavlink::UnsignedFrames;
  const LinkEndpoint& at = planned.endpoint;
  if (at.is_signed) security_.secure(channel, static_cast<std::uint8_t>(endpoint + 1));
  if (!planned.station) return;
  const UnsignedFrames usual = at.is_signed ? UnsignedFrames::kNothing
                               : is_local   ? UnsignedFrames::kAll
                                            : UnsignedFrames::kTelemetry;
  security_.allow_unsigned(channel, at.unsigned_frames.value_or(usual));
}

// Answers an order that is not signed, and says so to the station, once.
void VehicleLinks::refuse(Peer& peer, transport::ChannelId channel,
                          const mavlink::Frame& frame) {
  const std::uint8_t system = frame.target_system();
  const auto shown = shown_at_.find({peer.group, system});
  Shown* target = shown == shown_at_.end() ? nullptr : shown->second;
  vehicle_services::refuse_order(frame, channel, target ? target->out : out_);
  if (!std::exchange(peer.refused, true) && target)
    target->server.say(mavlink::Severity::kWarning, "Refused: commands must be signed");
  RefusedOrder order;
  if (target) order.shown = target->number;
  for (const auto& vehicle : vehicles_)
    if (!target && vehicle->client.system() == system) order.vehicle = vehicle->name;
  refused_.add(peer.name, std::move(order), now());
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
    using Admission = mavlink::LinkSecurity::Admission;
    const Admission admission = security_.judge(channel, frame);
    if (admission == Admission::kOrderRefused) refuse(peer, channel, frame);
    if (admission != Admission::kTaken) return;
    if (peer.station) {
      serve(peer, channel, frame, arrived);
    } else {
      const auto& vehicles = planned_[peer.endpoint].vehicles;
      const auto found = vehicles.find(frame.system());
      if (found != vehicles.end()) {
        Vehicle& vehicle = *found->second;
        vehicle.client.receive(frame, channel, now(vehicle), out_);
        hand_over(vehicle, arrived);
      } else {
        for (const auto& [system, vehicle] : vehicles)
          vehicle->client.receive_other(frame, now(*vehicle));
      }
    }
    forward(channel, frame);
  });
}

// Between vehicles and stations only: what one vehicle says is no other's business.
void VehicleLinks::forward(transport::ChannelId from, const mavlink::Frame& frame) {
  router_.route(from, frame, to_);
  const bool station = peers_.at(from).station;
  for (const router::Channel channel : to_)
    if (peers_.at(channel).station != station) send(channel, frame.bytes);
}

}  // namespace skein::vehicle_links
