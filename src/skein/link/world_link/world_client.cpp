// SPDX-License-Identifier: Apache-2.0
#include "skein/link/world_link/world_client.h"

#include <algorithm>
#include <utility>

#include "skein/data/describe/walk.h"
#include "skein/data/describe/wire.h"
#include "skein/link/world_link/entity_links.h"

namespace skein::world_link {
namespace {

constexpr std::chrono::milliseconds kAgentTurn{10};
constexpr std::size_t kMaxQueue = 5000;  // values of a kind that nobody takes

SessionOptions session_of(const WorldClientOptions& client, std::uint64_t id) {
  SessionOptions options;
  options.id = id;
  options.hello = {client.software, client.entity, client.scenario};
  return options;
}

// A sample is not of the future: clocks are known to some milliseconds only.
struct NotAfter {
  Time now;
  void operator()(Time& time) const { time = std::min(time, now); }
};

template <class T>
void put(std::vector<T>& queue, T value) {
  if (queue.size() >= kMaxQueue) queue.erase(queue.begin());
  queue.push_back(std::move(value));
}

}  // namespace

WorldClient::WorldClient(WorldClientOptions options)
    : options_(std::move(options)),
      session_(session_of(options_, session_of_now())),
      team_(options_.self, session_.id()),
      endpoints_(*this) {}

WorldClient::~WorldClient() {
  stop_ = true;
  endpoints_.wake();
  if (thread_.joinable()) thread_.join();
}

Time WorldClient::now() const {
  return Time::from_ns(
      std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - begin_)
          .count());
}

Result<std::vector<std::string>> WorldClient::start() {
  std::vector<transport::EndpointAddress> all = options_.team;
  if (options_.world) all.insert(all.begin(), *options_.world);
  for (const transport::EndpointAddress& address : all) {
    if (!carries_packets(address))
      return Error{ErrorCode::kBadInput, transport::text_of(address),
                   "packets go by UDP or TCP only.", ""};
    if (auto opened = endpoints_.open(address); !opened) return opened.error();
  }
  std::vector<std::string> places = endpoints_.places();
  thread_ = std::thread([this] { run(); });
  return places;
}

void WorldClient::say(Time at, EntitySaying saying) {
  walk::shift_times(saying, now() - at);
  const std::lock_guard lock(mutex_);
  if (std::holds_alternative<RemoteState>(saying))
    std::erase_if(out_, [](const EntitySaying& each) {
      return std::holds_alternative<RemoteState>(each);
    });
  put(out_, std::move(saying));
}

void WorldClient::receive(Time at, std::vector<Message>& out) {
  const Time shift = at - now();
  const std::lock_guard lock(mutex_);
  for (Message& message : messages_) {
    walk::shift_times(message, shift);
    out.push_back(std::move(message));
  }
  messages_.clear();
}

void WorldClient::take_samples(Time at, std::vector<SensorSample>& out) {
  const Time shift = at - now();
  NotAfter not_after{at};
  const std::lock_guard lock(mutex_);
  for (SensorSample& sample : samples_) {
    walk::shift_times(sample, shift);
    walk::parts(sample, not_after);
    out.push_back(sample);
  }
  samples_.clear();
}

std::vector<Command> WorldClient::take_commands() {
  const std::lock_guard lock(mutex_);
  return std::exchange(commands_, {});
}

std::vector<SessionChange> WorldClient::take_changes() {
  const std::lock_guard lock(mutex_);
  return std::exchange(changes_, {});
}

void WorldClient::run() {
  while (!stop_) {
    endpoints_.run_for(kAgentTurn);
    step();
  }
  session_.say_bye(now(), "the agent has ended",
                   [this](const Packet& packet) { send_to_world(packet); });
  endpoints_.run_for(kAgentTurn);
}

void WorldClient::step() {
  std::vector<EntitySaying> out;
  {
    const std::lock_guard lock(mutex_);
    out = std::exchange(out_, {});
  }
  for (EntitySaying& saying : out) put_out(saying);
  if (options_.world)
    session_.step(now(), [this](const Packet& packet) { send_to_world(packet); });
  if (!options_.team.empty())
    team_.step(now(), [this](auto bytes) { send_to_team(bytes); });
  std::vector<SessionChange> changes = session_.take_changes();
  if (changes.empty()) return;
  const std::lock_guard lock(mutex_);
  for (SessionChange& change : changes) put(changes_, std::move(change));
}

void WorldClient::put_out(EntitySaying& saying) {
  const auto* message = std::get_if<Message>(&saying);
  if (message && !session_.up() && team_.hears(message->to, now()))
    return team_.send(*message, now(), [this](auto bytes) { send_to_team(bytes); });
  if (!options_.world) return;
  std::vector<std::byte> coded;
  wire::encode(saying, coded);
  if (std::holds_alternative<RemoteState>(saying))
    session_.show(coded);
  else
    session_.post(coded, now());
}

void WorldClient::send_to_world(const Packet& packet) {
  for (const auto& [channel, peer] : peers_) {
    if (!of_world(peer)) continue;
    coded_.clear();
    encode(packet, coded_);
    if (peer.connection) coded_ = framed(coded_);
    endpoints_.send(channel, coded_);
  }
}

void WorldClient::send_to_team(std::span<const std::byte> bytes) {
  for (const auto& [channel, peer] : peers_) {
    if (of_world(peer)) continue;
    if (peer.connection)
      endpoints_.send(channel, framed(bytes));
    else
      endpoints_.send(channel, bytes);
  }
}

void WorldClient::opened(transport::ChannelId channel, transport::EndpointId endpoint,
                         const std::string&) {
  Peer& peer = peers_[channel];
  peer.endpoint = endpoint;
  peer.connection =
      of_world(peer)
          ? is_connection(*options_.world)
          : is_connection(options_.team.at(endpoint - (options_.world ? 1u : 0u)));
}

void WorldClient::closed(transport::ChannelId channel, const std::string&) {
  peers_.erase(channel);
}

void WorldClient::received(transport::ChannelId channel,
                           std::span<const std::byte> bytes) {
  Peer& peer = peers_.at(channel);
  const auto take = [&](std::span<const std::byte> packet) {
    if (of_world(peer))
      take_packet(packet);
    else
      take_team_packet(packet);
  };
  if (peer.connection)
    peer.frames.read(bytes, take);
  else
    take(bytes);
}

void WorldClient::take_packet(std::span<const std::byte> bytes) {
  const auto packet = decode_packet(bytes);
  if (!packet) return;
  session_.receive(packet.value(), now(),
                   [this](const Delivery& delivery) { deliver(delivery); });
}

void WorldClient::take_team_packet(std::span<const std::byte> bytes) {
  std::vector<Message> messages;
  team_.receive(bytes, now(), messages);
  for (Message& message : messages) keep(std::move(message));
}

void WorldClient::keep(Message message) {
  if (message.to != options_.self || message.from == options_.self ||
      message.from.value >= options_.entities)
    return;
  const std::lock_guard lock(mutex_);
  put(messages_, std::move(message));
}

// Others are for the world.
bool WorldClient::is_for_us(const Command& command) const {
  const auto* vehicle = std::get_if<VehicleCommand>(&command);
  const auto* fault = std::get_if<FaultCommand>(&command);
  return (vehicle && vehicle->aircraft == options_.entity) ||
         (fault && fault->aircraft == options_.entity);
}

void WorldClient::deliver(const Delivery& delivery) {
  auto input = wire::decode<EntityInput>(std::as_bytes(delivery.coded));
  if (!input || !walk::has_sound_numbers(input.value())) return;
  walk::shift_times(input.value(), delivery.shift);
  if (auto* message = std::get_if<Message>(&input.value()))
    return keep(std::move(*message));
  const std::lock_guard lock(mutex_);
  if (auto* readings = std::get_if<PayloadReadings>(&input.value())) {
    for (const SensorSample& sample : readings->samples) put(samples_, sample);
  } else if (auto* command = std::get_if<Command>(&input.value());
             command && is_for_us(*command)) {
    put(commands_, std::move(*command));
  }
}

}  // namespace skein::world_link
