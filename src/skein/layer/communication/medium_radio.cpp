// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/medium_radio.h"

#include <algorithm>
#include <utility>

#include "skein/base/check.h"
#include "skein/data/describe/wire.h"
#include "skein/layer/communication/routing/no_routing.h"

namespace skein::communication {
namespace {

// A node's random streams for its radio.
constexpr std::uint32_t kSpreads = 4, kAdvertisementTimes = 7;
constexpr std::uint32_t kPartBytes = 4;            // which part of which message it is
constexpr std::uint32_t kAdvertisementBytes = 12;  // identity, address, kind
// Tags of what is no message; those of messages are places in posts_.
constexpr std::uint64_t kAdvertisement = ~std::uint64_t{0}, kFlood = kAdvertisement - 1;

LossCause cause_of_end(PacketEnd end) {
  switch (end) {
    case PacketEnd::kDone:
      break;
    case PacketEnd::kTooLong:  // none: radio files are refused whose parts no slot holds
    case PacketEnd::kRetryLimit:
      return LossCause::kRetryLimit;
    case PacketEnd::kExpired:
      return LossCause::kExpired;
    case PacketEnd::kQueueFull:
      return LossCause::kQueueFull;
  }
  return LossCause::kNone;
}

Links::Nodes nodes_of(std::size_t entities, double transmit_power_dbm,
                      const PositionLookup& position, const std::vector<bool>& on,
                      const std::vector<EntityId>& reached_at, NodeAntennas antennas,
                      const Attackers& attackers) {
  Links::Nodes nodes;
  nodes.move = false;  // but when places_changed() says so
  nodes.transmit_power_dbm.assign(entities, transmit_power_dbm);
  nodes.outsiders = attackers.size();
  std::vector<Vec3> places;  // of attackers
  for (std::size_t k = 0; k < attackers.size(); ++k) {
    nodes.transmit_power_dbm.push_back(attackers[k].power_dbm);
    places.push_back(attackers[k].place);
  }
  nodes.place = [position, entities, places](NodeIndex node, Time) -> Vec3 {
    if (node >= entities) return places[node - entities];
    return position(EntityId{node}).value_or(Vec3::Zero());
  };
  nodes.is_on = [position, entities, &on, &reached_at](NodeIndex node) {
    if (node >= entities) return true;
    const bool has_one = reached_at.empty() || reached_at[node].value == node;
    return has_one && on[node] && position(EntityId{node});
  };
  nodes.antennas = std::move(antennas);
  // Those of attackers are alike in all directions.
  if (!nodes.antennas.of.empty())
    nodes.antennas.of.resize(nodes.transmit_power_dbm.size());
  return nodes;
}

Time patience_of(double advertisement_period) {
  return Time::from_seconds(3 * (advertisement_period > 0 ? advertisement_period : 1));
}

// A place in a list whose entries are used again.
template <class T>
std::uint32_t free_place(std::vector<T>& all, std::vector<std::uint32_t>& unused) {
  if (unused.empty()) {
    all.emplace_back();
    return static_cast<std::uint32_t>(all.size() - 1);
  }
  const std::uint32_t place = unused.back();
  unused.pop_back();
  return place;
}

}  // namespace

MediumRadio::MediumRadio(const MediumRadioOptions& options,
                         std::unique_ptr<Propagation> propagation, RadioNodes nodes,
                         std::uint64_t seed, std::unique_ptr<Routing> routing)
    : options_(options),
      propagation_(std::move(propagation)),
      entities_(nodes.count),
      position_(std::move(nodes.position)),
      name_(std::move(nodes.name)),
      seed_(seed),
      attackers_(options.attacks, static_cast<NodeIndex>(entities_), position_,
                 options.authentication.has_value(), seed),
      routing_(routing ? std::move(routing) : std::make_unique<NoRouting>()),
      on_(entities_, true),
      reached_at_(std::move(nodes.reached_at)),
      medium_(options.profile, *propagation_,
              nodes_of(entities_, options.profile.phy.transmit_power_dbm, position_, on_,
                       reached_at_, std::move(nodes.antennas), attackers_),
              seed, *this),
      meter_(options.profile.mac.access, entities_),
      neighbours_(entities_, patience_of(options.advertisement_period)),
      waiting_(entities_, 0) {
  SKEIN_CHECK(options.profile.mac.part_bytes > part_head(*routing_));
  SKEIN_CHECK(reached_at_.empty() || reached_at_.size() == entities_, entities_);
  if (options.authentication) authenticity_.emplace(*options.authentication, entities_);
  for (std::uint32_t node = 0; node < entities_; ++node) {
    advertisement_times_.emplace_back(seed, node, Purpose::kRadio, kAdvertisementTimes);
    if (options.advertisement_period > 0)
      next_advertisements_.push_back(Time::from_seconds(
          options.advertisement_period * advertisement_times_[node].uniform()));
  }
}

std::uint32_t MediumRadio::part_head(const Routing& routing) {
  return kPartBytes + routing.head_bytes();
}

void MediumRadio::send(const Message& message) {
  written_.push_back(message);
}

RadioStatus MediumRadio::status(EntityId id) const {
  if (id.value >= entities_) return {};
  const NodeIndex node = node_of(id);
  return {meter_.load(node), waiting_[node],
          options_.profile.mac.access != AccessMethod::kDirect};
}

void MediumRadio::turn(EntityId id, bool on) {
  on_.at(id.value) = on;
}

bool MediumRadio::has_node(EntityId id) const {
  return reached_at_.empty() || reached_at_[id.value] == id;
}

// Of an entity, or of an attacker.
NodeIndex MediumRadio::node_of(EntityId id) const {
  const bool own = reached_at_.empty() || id.value >= entities_;
  return own ? id.value : reached_at_[id.value].value;
}

void MediumRadio::deliver(Time now, RadioNews& news) {
  news_ = &news;
  medium_.places_changed();
  collect();
  advertise(now);
  attack(now);
  medium_.advance(std::max(now, medium_.now()));
  settle(now);
  meter_.step(now, [this](NodeIndex node) { return medium_.heard(node); });
  for (NodeIndex node = 0; node < entities_; ++node) {
    waiting_[node] = static_cast<std::uint32_t>(medium_.waiting(node));
    meter_.queue(node, waiting_[node]);
  }
  note_neighbours(now, news.events);
  news_ = nullptr;
}

void MediumRadio::end(RadioNews& news) {
  news_ = &news;
  collect();
  for (Transfer& transfer : transfers_) {
    for (Transfer::Copy& copy : transfer.copies)
      if (!copy.arrived)
        news.ended.push_back(
            {std::move(copy.message), LossCause::kPending, transfer.way});
    transfer.copies.clear();
  }
  news_ = nullptr;
}

// A message with the copies that follow it is one.
void MediumRadio::collect() {
  for (std::size_t i = 0; i < written_.size();) {
    std::size_t end = i + 1;
    while (end < written_.size() && written_[end].copy &&
           written_[end].from == written_[i].from)
      ++end;
    begin(i, end);
    i = end;
  }
  written_.clear();
}

// Makes a transfer of what was written from `first` to `end`.
void MediumRadio::begin(std::size_t first, std::size_t end) {
  const Message& message = written_[first];
  RandomStream random(seed_, message.from.value, Purpose::kRadio, kSpreads);
  random.seek(message.number);
  const Time time = message.sent + Time::from_seconds(options_.spread * random.uniform());
  const NodeIndex from = node_of(message.from);
  const std::uint32_t index =
      new_transfer(from, std::span(written_).subspan(first, end - first));
  if (from < entities_) seal(transfers_[index]);
  // What is for somebody at the same node is there at once.
  if (!reached_at_.empty() && from < entities_)
    arrive(transfers_[index], from, 0, LossCause::kNone, time);
  launch(index, time);
}

// A message with its copies, which are moved from.
std::uint32_t MediumRadio::new_transfer(NodeIndex from, std::span<Message> copies) {
  const std::uint32_t index = free_place(transfers_, free_transfers_);
  Transfer& transfer = transfers_[index];
  transfer.from = from;
  transfer.to_all = copies.size() > 1;
  transfer.bytes = static_cast<std::uint32_t>(coded_size(copies[0]));
  transfer.urgency = static_cast<std::uint8_t>(urgency_of(copies[0].content));
  transfer.posts = 0;
  transfer.cause = LossCause::kNone;
  transfer.way = {};
  transfer.copies.clear();
  transfer.sealed.clear();
  for (Message& copy : copies) transfer.copies.push_back({std::move(copy)});
  return index;
}

// Seals what its sender says, in the form in which it is on the air once.
void MediumRadio::seal(Transfer& transfer) {
  if (!authenticity_) return;
  Message& message = transfer.copies[0].message;
  const EntityId to = message.to;
  if (transfer.to_all) message.to = kEveryone;
  wire::encode(message, transfer.sealed);
  message.to = to;
  authenticity_->seal(message.from, transfer.sealed);
  transfer.bytes = static_cast<std::uint32_t>(transfer.sealed.size());
}

// Hands a transfer to the radio of its sender.
void MediumRadio::launch(std::uint32_t index, Time time) {
  Transfer& transfer = transfers_[index];
  const EntityId from = transfer.copies[0].message.from;
  const EntityId to_one = transfer.copies[0].message.to;
  const bool to_itself = to_one == from && node_of(from) == transfer.from;
  const bool known = transfer.from < entities_ + attackers_.size() &&
                     (transfer.to_all || (to_one.value < entities_ && !to_itself));
  if (!known) {
    transfer.cause = LossCause::kNobody;
    leave(index, time);
    return;
  }
  const bool is_there = !transfer.to_all && node_of(to_one) == transfer.from;
  transfer.reached.assign(entities_ + attackers_.size(), is_there);
  transfer.reached[transfer.from] = true;
  if (is_there) {  // nobody takes it, but one of the two has a radio elsewhere
    post(index, transfer.from, kAllNodes, 0, time);
    return;
  }
  const auto to = way_from(transfer, transfer.from, 0);
  if (!to) {
    transfer.cause = LossCause::kNobody;
    leave(index, time);
    return;
  }
  post(index, transfer.from, *to, 0, time);
}

// What a routing knows of a transfer.
RoutedMessage MediumRadio::routed(const Transfer& transfer, std::uint32_t hop) const {
  const Message& said = transfer.copies[0].message;
  return {EntityId{node_of(said.from)},
          transfer.to_all ? kEveryone : EntityId{node_of(said.to)}, hop};
}

// To whom a node sends a transfer that `hop` radios have passed on, itself among them.
std::optional<std::uint32_t> MediumRadio::way_from(const Transfer& transfer,
                                                   NodeIndex node, std::uint32_t hop) {
  const Time now = medium_.now();
  // An attacker acts as whom it pretends to be, and knows nobody.
  const bool attacker = node >= entities_;
  const auto hears = [this, now, attacker](EntityId one, EntityId other) {
    return !attacker && neighbours_.has(one.value, other.value, now);
  };
  const RoutedMessage message = routed(transfer, hop);
  const EntityId self = attacker ? message.origin : EntityId{node};
  const auto next = routing_->next(self, message, hears, now);
  if (!next) return std::nullopt;
  return *next == kEveryone ? kAllNodes : next->value;
}

// Hands the parts of a transfer to the radio of `from`.
void MediumRadio::post(std::uint32_t index, NodeIndex from, std::uint32_t to,
                       std::uint32_t hop, Time time) {
  Transfer& transfer = transfers_[index];
  ++transfer.posts;
  const std::uint32_t place = free_place(posts_, free_posts_);
  transfer.carried.push_back(place);
  Post& post = posts_[place];
  const std::uint32_t head = routing_->head_bytes();
  const std::uint32_t most = options_.profile.mac.part_bytes - head;
  const std::uint32_t room = most - kPartBytes;
  post.transfer = index;
  post.from = from;
  post.hop = hop;
  post.again = false;
  post.parts = transfer.bytes <= most ? 1 : (transfer.bytes + room - 1) / room;
  post.parts_ended = 0;
  post.received.clear();
  std::uint32_t left = transfer.bytes;
  for (std::uint32_t part = 0; part < post.parts; ++part) {
    const std::uint32_t here = post.parts == 1 ? left : std::min(left, room);
    left -= here;
    const std::uint32_t size = head + here + (post.parts == 1 ? 0 : kPartBytes);
    medium_.send_at(time, {from, to, size, place, transfer.urgency});
  }
}

void MediumRadio::end_part(std::uint32_t index, LossCause cause, Time now) {
  Post& post = posts_[index];
  Transfer& transfer = transfers_[post.transfer];
  if (transfer.cause == LossCause::kNone) transfer.cause = cause;
  if (++post.parts_ended < post.parts) return;
  if (--transfer.posts == 0) leave(post.transfer, now);
}

// Nothing sends it any more, but what was sent may still be on the way.
void MediumRadio::leave(std::uint32_t index, Time now) {
  Transfer& transfer = transfers_[index];
  transfer.ended = now;
  if (!std::exchange(transfer.leaves, true)) leaving_.push_back(index);
}

// What has not arrived by now never will.
void MediumRadio::settle(Time now) {
  std::erase_if(leaving_, [&](std::uint32_t index) {
    Transfer& transfer = transfers_[index];
    if (transfer.posts == 0 && transfer.ended + medium_.longest_delay() >= now)
      return false;
    transfer.leaves = false;
    if (transfer.posts > 0) return true;  // passed on meanwhile: it leaves again
    for (Transfer::Copy& copy : transfer.copies) {
      if (copy.arrived) continue;
      if (!copy.message.forged) meter_.message_lost(copy.message.from, copy.message.to);
      const LossCause cause = cause_of(transfer, copy.message.to);
      news_->ended.push_back({std::move(copy.message), cause, transfer.way});
    }
    transfer.copies.clear();
    free_posts_.insert(free_posts_.end(), transfer.carried.begin(),
                       transfer.carried.end());
    transfer.carried.clear();
    free_transfers_.push_back(index);
    return true;
  });
}

// What was sent and not acknowledged was too weak there, or disturbed.
LossCause MediumRadio::cause_of(const Transfer& transfer, EntityId to) {
  if (transfer.cause != LossCause::kNone) return transfer.cause;
  if (to.value >= entities_) return LossCause::kNobody;
  return medium_.reaches(transfer.from, node_of(to)) ? LossCause::kNotReceived
                                                     : LossCause::kOutOfRange;
}

// Orders the advertisements up to `now`.
void MediumRadio::advertise(Time now) {
  for (NodeIndex node = 0; node < next_advertisements_.size(); ++node) {
    Time& next = next_advertisements_[node];
    while (next <= now) {
      if (on_[node] && has_node(EntityId{node}))
        medium_.send_at(next, {node, kAllNodes, kAdvertisementBytes, kAdvertisement,
                               static_cast<std::uint8_t>(Urgency::kCommand)});
      next += Time::from_seconds(options_.advertisement_period *
                                 advertisement_times_[node].uniform(0.9, 1.1));
    }
  }
}

void MediumRadio::note_neighbours(Time now, std::vector<Event>& events) {
  if (now < next_check_) return;
  next_check_ = now + Time::from_seconds(1);
  neighbours_.step(now, changes_);
  if (options_.advertisement_period > 0)
    for (const Neighbours::Change& change : changes_)
      if (on_[change.node])
        events.push_back(
            {now,
             EntityId{change.node},
             change.found ? EventKind::kNeighbourFound : EventKind::kNeighbourLost,
             name_(EntityId{change.other}),
             {.other = EntityId{change.other}}});
  changes_.clear();
}

void MediumRadio::on_frame(const Frame& frame, Time now) {
  if (frame.from < entities_) meter_.frame(frame);
  if (frame.kind != FrameKind::kData || frame.tag >= kFlood) return;
  MessageWay& way = transfers_[posts_[frame.tag].transfer].way;
  if (!way.on_air) way.on_air = now;
  ++way.transmissions;
}

// Whether a receiver has all parts now that it has got one more.
bool MediumRadio::has_all(Post& post, NodeIndex receiver) {
  if (post.parts == 1) return true;
  for (auto& [node, parts] : post.received)
    if (node == receiver) return ++parts == post.parts;
  post.received.emplace_back(receiver, 1);
  return false;
}

void MediumRadio::on_delivered(const Frame& data, NodeIndex receiver, Time now,
                               const Reception& reception) {
  if (receiver >= entities_) return on_overheard(data, receiver, now);
  if (data.from < entities_) {
    meter_.received(data, receiver, reception);
    neighbours_.hear(receiver, data.from, now, changes_);
  }
  if (data.tag >= kFlood) return;
  Post& post = posts_[data.tag];
  if (!has_all(post, receiver)) return;
  Transfer& transfer = transfers_[post.transfer];
  const std::uint32_t hop = post.hop;
  const bool refused = refuses(transfer, receiver, now);
  arrive(transfer, receiver, hop, refused ? LossCause::kRefused : LossCause::kNone, now);
  if (refused) return;
  if (data.from < entities_)
    routing_->learn(EntityId{receiver}, EntityId{data.from}, routed(transfer, hop), now);
  pass_on(post.transfer, receiver, hop, now);
}

// Whoever gets a message for others sends it once, if the routing says so.
void MediumRadio::pass_on(std::uint32_t index, NodeIndex node, std::uint32_t hop,
                          Time now) {
  Transfer& transfer = transfers_[index];
  if (transfer.reached[node]) return;
  transfer.reached[node] = true;
  const bool is_end = !transfer.to_all && node_of(transfer.copies[0].message.to) == node;
  if (is_end) return;
  if (const auto to = way_from(transfer, node, hop + 1)) {
    const double wait = routing_->delay(EntityId{node});
    post(index, node, *to, hop + 1, now + Time::from_seconds(wait));
  }
}

// What a radio on the way has not acknowledged goes to all who hear it, once.
void MediumRadio::try_again(const Packet& packet, Time now) {
  const std::uint32_t to = packet.order.to;
  const auto place = static_cast<std::uint32_t>(packet.order.tag);
  const NodeIndex from = posts_[place].from;
  if (to >= entities_ || from >= entities_) return;
  if (!routing_->failed(EntityId{from}, EntityId{to})) return;
  if (std::exchange(posts_[place].again, true)) return;
  post(posts_[place].transfer, from, kAllNodes, posts_[place].hop, now);
}

// Whether a receiver finds that a message is not authentic, where it must be. What has
// reached it before it has judged before.
bool MediumRadio::refuses(Transfer& transfer, NodeIndex receiver, Time now) {
  if (!authenticity_ || transfer.reached[receiver]) return false;
  const EntityId self{receiver}, sender = transfer.copies[0].message.from;
  const Verdict verdict = authenticity_->judge(self, sender, transfer.sealed);
  if (verdict == Verdict::kAuthentic) return false;
  const bool refused = authenticity_->is_required();
  if (auto event = refusals_.note(now, self, sender, verdict, refused, name_(sender)))
    news_->events.push_back(*std::move(event));
  if (refused) transfer.reached[receiver] = true;
  return refused;
}

// Does what attackers do up to `now`.
void MediumRadio::attack(Time now) {
  attack_orders_.clear();
  attackers_.step(now, attack_orders_, news_->events);
  for (const AttackOrders::Noise& noise : attack_orders_.noise)
    medium_.send_noise_at(noise.time, noise.node, noise.duration);
  for (const AttackOrders::Packet& packet : attack_orders_.packets)
    medium_.send_at(packet.time, {packet.node, packet.to, packet.bytes, kFlood, 0});
  for (AttackOrders::Forgery& forgery : attack_orders_.forgeries) {
    const std::uint32_t index = new_transfer(forgery.node, forgery.message.copies);
    Transfer& transfer = transfers_[index];
    transfer.sealed = std::move(forgery.message.sealed);
    if (authenticity_)
      transfer.bytes = static_cast<std::uint32_t>(transfer.sealed.size());
    launch(index, forgery.time);
  }
}

void MediumRadio::on_overheard(const Frame& data, NodeIndex receiver, Time now) {
  const bool attacker = receiver >= entities_;
  if (!attacker && data.from < entities_)
    neighbours_.hear(receiver, data.from, now, changes_);
  if (data.tag >= kFlood) return;
  const Post& post = posts_[data.tag];
  const Transfer& transfer = transfers_[post.transfer];
  if (!attacker) {
    if (data.from < entities_)
      routing_->overhear(EntityId{receiver}, EntityId{data.from}, EntityId{data.to},
                         routed(transfer, post.hop), now);
    return;
  }
  if (!attackers_.listen() || post.parts > 1) return;
  overheard_.clear();
  for (const Transfer::Copy& copy : transfer.copies) overheard_.push_back(copy.message);
  attackers_.overhear(receiver, overheard_, transfer.sealed, now);
}

void MediumRadio::arrive(Transfer& transfer, NodeIndex receiver, std::uint32_t hop,
                         LossCause cause, Time now) {
  for (Transfer::Copy& copy : transfer.copies) {
    const EntityId to = copy.message.to;
    if (copy.arrived || node_of(to) != receiver || !on_[to.value]) continue;
    copy.arrived = true;
    transfer.way.hops = hop;
    if (!copy.message.forged && cause == LossCause::kNone)
      meter_.message_arrived(copy.message.from, copy.message.to, now - copy.message.sent);
    else if (!copy.message.forged)
      meter_.message_lost(copy.message.from, copy.message.to);
    // Attackers may still hear it.
    Message arrived = attackers_.listen() ? copy.message : std::move(copy.message);
    // Who it came from is still needed where it is passed on.
    copy.message.from = arrived.from;
    copy.message.to = arrived.to;
    news_->ended.push_back({std::move(arrived), cause, transfer.way});
    if (reached_at_.empty()) return;
  }
}

void MediumRadio::on_finished(const Packet& packet, PacketEnd end, Time now) {
  if (packet.order.from < entities_) {
    meter_.lost(packet.order.from, end);
    if (end != PacketEnd::kQueueFull)
      meter_.queue(packet.order.from, medium_.waiting(packet.order.from) + 1);
  }
  if (packet.order.tag >= kFlood) return;
  if (end == PacketEnd::kRetryLimit) try_again(packet, now);
  end_part(static_cast<std::uint32_t>(packet.order.tag), cause_of_end(end), now);
}

}  // namespace skein::communication
