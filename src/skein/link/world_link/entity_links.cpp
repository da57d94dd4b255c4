// SPDX-License-Identifier: Apache-2.0
#include "skein/link/world_link/entity_links.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "skein/data/describe/walk.h"
#include "skein/data/describe/wire.h"
#include "skein/data/vehicle/entity_report.h"

namespace skein::world_link {
namespace {

constexpr std::chrono::milliseconds kTurn{10};
constexpr std::size_t kMaxWaiting = 2000;  // values of an entity that nobody takes

// What a run takes in was so by now: clocks are known to some milliseconds only.
void not_after(Time now, EntitySaying& saying) {
  if (auto* state = std::get_if<RemoteState>(&saying)) {
    state->nav.time = std::min(state->nav.time, now);
    state->truth_time = std::min(state->truth_time, now);
  } else if (auto* event = std::get_if<Event>(&saying)) {
    event->time = std::min(event->time, now);
  }
}

}  // namespace

std::uint64_t session_of_now() {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(
          std::chrono::system_clock::now().time_since_epoch())
          .count());
}

// What goes between the thread of the links and the simulation for one entity, each way
// in order; of states only the newest.
struct EntityLinks::Mailbox {
  void put(VehicleReport report) {
    const auto is_state = [](const VehicleReport& each) {
      const auto* entity = std::get_if<EntityReport>(&each);
      return entity && std::holds_alternative<RemoteState>(entity->said);
    };
    const std::lock_guard lock(mutex);
    if (is_state(report)) std::erase_if(reports, is_state);
    if (reports.size() >= kMaxWaiting) drop_one();
    reports.push_back(std::move(report));
  }
  std::vector<VehicleReport> take_reports() {
    const std::lock_guard lock(mutex);
    return std::exchange(reports, {});
  }
  void put(EntityInput input) {
    const std::lock_guard lock(mutex);
    if (inputs.size() < kMaxWaiting) inputs.push_back(std::move(input));
  }
  std::vector<EntityInput> take_inputs() {
    const std::lock_guard lock(mutex);
    return std::exchange(inputs, {});
  }

  // The oldest; changes of the link last, for the simulation acts on them.
  void drop_one() {
    const auto oldest = std::ranges::find_if(reports, [](const VehicleReport& each) {
      return !std::holds_alternative<LinkChange>(each);
    });
    reports.erase(oldest == reports.end() ? reports.begin() : oldest);
  }

  std::mutex mutex;
  std::vector<VehicleReport> reports;  // times are of the links' clock
  std::vector<EntityInput> inputs;     // the same
};

struct EntityLinks::Entity {
  Entity(LinkedEntity what, transport::EndpointId at, SessionOptions options)
      : described(std::move(what)), endpoint(at), session(std::move(options)) {}

  LinkedEntity described;
  transport::EndpointId endpoint;
  Session session;
  transport::ChannelId channel = 0;  // of its agent; 0: none
  std::shared_ptr<Mailbox> mailbox = std::make_shared<Mailbox>();
};

// Times go from one clock to the other by their age: the run's stands still in pauses.
class EntityLinks::Port final : public EntityPort {
 public:
  Port(EntityLinks& links, std::shared_ptr<Mailbox> mailbox)
      : links_(links), mailbox_(std::move(mailbox)) {}

  void receive(Time now, std::vector<VehicleReport>& out) override {
    const Time shift = now - links_.now();
    for (VehicleReport& report : mailbox_->take_reports()) {
      if (auto* entity = std::get_if<EntityReport>(&report)) {
        walk::shift_times(entity->said, shift);
        not_after(now, entity->said);
        // It may have gone on for long without this world.
        const auto* event = std::get_if<Event>(&entity->said);
        if (event && event->time < Time()) continue;
      }
      out.push_back(std::move(report));
    }
  }

  void send(Time now, EntityInput input) override {
    walk::shift_times(input, links_.now() - now);
    mailbox_->put(std::move(input));
  }

 private:
  EntityLinks& links_;
  std::shared_ptr<Mailbox> mailbox_;
};

EntityLinks::EntityLinks(std::string software, std::string scenario)
    : software_(std::move(software)),
      scenario_(std::move(scenario)),
      session_(session_of_now()),
      endpoints_(*this) {}

EntityLinks::~EntityLinks() {
  stop_ = true;
  endpoints_.wake();
  if (thread_.joinable()) thread_.join();
}

Time EntityLinks::now() const {
  return Time::from_ns(
      std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - begin_)
          .count());
}

Result<std::size_t> EntityLinks::add(const LinkedEntity& entity) {
  const std::string text = transport::text_of(entity.endpoint);
  if (!carries_packets(entity.endpoint))
    return Error{ErrorCode::kBadInput, text, "an agent is met by UDP or TCP only.", ""};
  for (const auto& other : entities_)
    if (other->described.name == entity.name)
      return Error{ErrorCode::kBadInput, text,
                   fmt::format("two entities are called {}.", entity.name), ""};
  std::size_t at = 0;
  while (at < addresses_.size() && transport::text_of(addresses_[at]) != text) ++at;
  if (at == addresses_.size()) addresses_.push_back(entity.endpoint);
  SessionOptions options;
  options.id = session_;
  options.hello = {software_, "", scenario_};
  options.silence = entity.silence;
  entities_.push_back(std::make_unique<Entity>(
      entity, static_cast<transport::EndpointId>(at), std::move(options)));
  return entities_.size() - 1;
}

std::unique_ptr<EntityPort> EntityLinks::port(std::size_t entity) {
  return std::make_unique<Port>(*this, entities_.at(entity)->mailbox);
}

Result<std::vector<std::string>> EntityLinks::start() {
  if (entities_.empty()) return std::vector<std::string>();
  for (const transport::EndpointAddress& address : addresses_)
    if (auto opened = endpoints_.open(address); !opened) return opened.error();
  std::vector<std::string> places = endpoints_.places();
  thread_ = std::thread([this] { run(); });
  return places;
}

void EntityLinks::run() {
  while (!stop_) {
    endpoints_.run_for(kTurn);
    for (const auto& entity : entities_) step(*entity);
  }
  for (const auto& entity : entities_)
    if (entity->channel != 0)
      entity->session.say_bye(now(), "the world has ended", [&](const Packet& packet) {
        send(entity->channel, packet);
      });
  endpoints_.run_for(kTurn);
}

void EntityLinks::step(Entity& entity) {
  for (EntityInput& input : entity.mailbox->take_inputs()) {
    std::vector<std::byte> coded;
    wire::encode(input, coded);
    if (std::holds_alternative<PayloadReadings>(input))
      entity.session.show(coded);
    else if (entity.session.up())
      entity.session.post(coded, now());
  }
  entity.session.step(now(), [&](const Packet& packet) { send(entity.channel, packet); });
  report(entity);
}

void EntityLinks::send(transport::ChannelId channel, const Packet& packet) {
  const auto peer = peers_.find(channel);
  if (peer == peers_.end()) return;
  coded_.clear();
  encode(packet, coded_);
  if (peer->second.connection) coded_ = framed(coded_);
  endpoints_.send(channel, coded_);
}

void EntityLinks::answer(transport::ChannelId channel, const Packet& to,
                         std::optional<Bye> bye) {
  Packet packet;
  packet.session = session_;
  packet.heard_session = bye ? to.session : 0;
  packet.number = 1;
  packet.sent = now();
  packet.bye = std::move(bye);
  send(channel, packet);
}

void EntityLinks::opened(transport::ChannelId channel, transport::EndpointId endpoint,
                         const std::string&) {
  Peer& peer = peers_[channel];
  peer.endpoint = endpoint;
  peer.connection = is_connection(addresses_[endpoint]);
}

void EntityLinks::closed(transport::ChannelId channel, const std::string&) {
  for (const auto& entity : entities_)
    if (entity->channel == channel) entity->channel = 0;
  peers_.erase(channel);
}

void EntityLinks::received(transport::ChannelId channel,
                           std::span<const std::byte> bytes) {
  Peer& peer = peers_.at(channel);
  if (!peer.connection) return take(channel, peer, bytes);
  peer.frames.read(
      bytes, [&](std::span<const std::byte> packet) { take(channel, peer, packet); });
}

void EntityLinks::take(transport::ChannelId channel, Peer& peer,
                       std::span<const std::byte> bytes) {
  const auto packet = decode_packet(bytes);
  if (!packet) return;
  if (packet.value().hello) meet(channel, peer, packet.value());
  if (!peer.entity) {
    // Who is that? It is to say hello.
    if (!packet.value().hello && !packet.value().bye)
      answer(channel, packet.value(), std::nullopt);
    return;
  }
  Session& session = peer.entity->session;
  session.receive(packet.value(), now(),
                  [&](const Delivery& delivery) { deliver(*peer.entity, delivery); });
  if (session.peer() == packet.value().session) peer.entity->channel = channel;
  report(*peer.entity);
}

// Whose agent a peer is, as it says.
void EntityLinks::meet(transport::ChannelId channel, Peer& peer, const Packet& packet) {
  const Hello& hello = *packet.hello;
  peer.entity = nullptr;
  const auto refuse = [&](std::string why) {
    answer(channel, packet, Bye{true, std::move(why)});
  };
  const auto found = std::find_if(entities_.begin(), entities_.end(), [&](const auto& e) {
    return e->described.name == hello.entity && e->endpoint == peer.endpoint;
  });
  if (found == entities_.end())
    return refuse(fmt::format("no agent of \"{}\" is awaited here", hello.entity));
  if (hello.scenario != scenario_)
    return refuse("the world runs another scenario: origin or entities differ");
  if (!(*found)->session.admits(packet.session, now()))
    return refuse("another agent of this entity began later");
  peer.entity = found->get();
}

// What an entity says, onto the clock of the links.
void EntityLinks::deliver(Entity& entity, const Delivery& delivery) {
  auto saying = wire::decode<EntitySaying>(std::as_bytes(delivery.coded));
  if (!saying || !walk::has_sound_numbers(saying.value())) return;
  walk::shift_times(saying.value(), delivery.shift);
  entity.mailbox->put(EntityReport{std::move(saying).value()});
}

void EntityLinks::report(Entity& entity) {
  for (SessionChange& change : entity.session.take_changes()) {
    LinkChange::Kind kind = LinkChange::Kind::kDown;
    if (change.kind == SessionChange::Kind::kUp) kind = LinkChange::Kind::kUp;
    if (change.kind == SessionChange::Kind::kRestarted)
      kind = LinkChange::Kind::kRebooted;
    if (change.kind == SessionChange::Kind::kRefused) kind = LinkChange::Kind::kMismatch;
    entity.mailbox->put(LinkChange{kind, std::move(change.text)});
  }
}

}  // namespace skein::world_link
