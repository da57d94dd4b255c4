#include "skein/layer/communication/medium_radio.h"

#include <algorithm>
#include <utility>

#include "skein/base/check.h"

namespace skein::communication {
namespace {

// A node's random streams for its radio.
constexpr std::uint32_t kSpreads = 4, kRelayDelays = 6, kAdvertisementTimes = 7;
constexpr std::uint32_t kPartBytes = 4;   // which part of which message it is
constexpr std::uint32_t kRouteBytes = 8;  // origin, number and hops of a message
constexpr std::uint32_t kAdvertisementBytes = 12;  // identity, address, kind
constexpr std::uint64_t kAdvertisement = ~std::uint64_t{0};         // a tag
constexpr Time kLongestWay = Time::from_ns(1'000'000);  // 300 km at the speed of light
// Where nothing reaches: an entity without a place.
const Vec3 kNowhere(1e9, 1e9, 0);

LossCause cause_of_end(PacketEnd end) {
  switch (end) {
    case PacketEnd::kDone:
      break;
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
                      const PositionLookup& position, NodeAntennas antennas) {
  Links::Nodes nodes;
  nodes.move = false;  // but when places_changed() says so
  nodes.transmit_power_dbm.assign(entities, transmit_power_dbm);
  nodes.place = [position](NodeIndex node, Time) {
    return position(EntityId{node}).value_or(kNowhere);
  };
  nodes.antennas = std::move(antennas);
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
                         std::uint64_t seed)
    : options_(options),
      propagation_(std::move(propagation)),
      entities_(nodes.count),
      position_(std::move(nodes.position)),
      name_(std::move(nodes.name)),
      seed_(seed),
      medium_(options.profile, *propagation_,
              nodes_of(entities_, options.profile.phy.transmit_power_dbm, position_,
                       std::move(nodes.antennas)),
              seed, *this),
      meter_(options.profile.mac.access, entities_),
      knows_neighbours_(options.routing != Routing::kNone ||
                        options.advertisement_period > 0),
      neighbours_(entities_, patience_of(options.advertisement_period)),
      waiting_(entities_, 0) {
  SKEIN_CHECK(options.profile.mac.part_bytes > kPartBytes + kRouteBytes);
  for (std::uint32_t node = 0; node < entities_; ++node) {
    relay_delays_.emplace_back(seed, node, Purpose::kRadio, kRelayDelays);
    advertisement_times_.emplace_back(seed, node, Purpose::kRadio, kAdvertisementTimes);
    if (options.advertisement_period > 0)
      next_advertisements_.push_back(Time::from_seconds(
          options.advertisement_period * advertisement_times_[node].uniform()));
  }
}

void MediumRadio::send(const Message& message) {
  written_.push_back(message);
}

RadioStatus MediumRadio::status(EntityId id) const {
  if (id.value >= entities_) return {};
  return {meter_.load(id.value), waiting_[id.value],
          options_.profile.mac.access != AccessMethod::kDirect};
}

void MediumRadio::deliver(Time now, RadioNews& news) {
  news_ = &news;
  medium_.places_changed();
  collect();
  advertise(now);
  medium_.advance(std::max(now, medium_.now()));
  settle(now);
  meter_.step(now, [this](NodeIndex node) { return medium_.heard(node); });
  for (NodeIndex node = 0; node < entities_; ++node)
    waiting_[node] = static_cast<std::uint32_t>(medium_.waiting(node));
  note_neighbours(now, news.events);
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
  const std::uint32_t index = free_place(transfers_, free_transfers_);
  Transfer& transfer = transfers_[index];
  const Message& message = written_[first];
  transfer.from = message.from.value;
  transfer.to_all = end > first + 1;
  transfer.bytes = static_cast<std::uint32_t>(coded_size(message));
  transfer.urgency = static_cast<std::uint8_t>(urgency_of(message.content));
  transfer.posts = 0;
  transfer.cause = LossCause::kNone;
  transfer.way = {};
  transfer.copies.clear();
  transfer.reached.clear();
  RandomStream random(seed_, message.from.value, Purpose::kRadio, kSpreads);
  random.seek(message.number);
  const Time time = message.sent + Time::from_seconds(options_.spread * random.uniform());
  for (std::size_t i = first; i < end; ++i)
    transfer.copies.push_back({std::move(written_[i])});
  const bool known =
      transfer.from < entities_ &&
      (transfer.to_all || (transfer.copies[0].message.to.value < entities_ &&
                           transfer.copies[0].message.to.value != transfer.from));
  if (!known) {
    transfer.cause = LossCause::kNobody;
    leave(index, time);
    return;
  }
  if (options_.routing == Routing::kFlooding) {
    transfer.reached.assign(entities_, false);
    transfer.reached[transfer.from] = true;
  }
  post(index, transfer.from, 0, time);
}

// Hands the parts of a transfer to the radio of `from`.
void MediumRadio::post(std::uint32_t index, NodeIndex from, std::uint32_t hop,
                       Time time) {
  Transfer& transfer = transfers_[index];
  ++transfer.posts;
  const std::uint32_t place = free_place(posts_, free_posts_);
  transfer.carried.push_back(place);
  Post& post = posts_[place];
  const bool floods = options_.routing == Routing::kFlooding;
  std::uint32_t to = transfer.to_all ? kAllNodes : transfer.copies[0].message.to.value;
  if (floods && to != kAllNodes && !neighbours_.has(from, to, std::max(time, medium_.now())))
    to = kAllNodes;
  const std::uint32_t head = floods ? kRouteBytes : 0;
  const std::uint32_t most = options_.profile.mac.part_bytes - head;
  const std::uint32_t room = most - kPartBytes;
  post.transfer = index;
  post.from = from;
  post.hop = hop;
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
    if (transfer.posts == 0 && transfer.ended + kLongestWay > now) return false;
    transfer.leaves = false;
    if (transfer.posts > 0) return true;  // passed on meanwhile: it leaves again
    for (Transfer::Copy& copy : transfer.copies) {
      if (copy.arrived) continue;
      meter_.message_lost(copy.message.from, copy.message.to);
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
  return medium_.reaches(transfer.from, to.value) ? LossCause::kNotReceived
                                                  : LossCause::kOutOfRange;
}

// Orders the advertisements up to `now`.
void MediumRadio::advertise(Time now) {
  for (NodeIndex node = 0; node < next_advertisements_.size(); ++node) {
    Time& next = next_advertisements_[node];
    while (next <= now) {
      medium_.send_at(next, {node, kAllNodes, kAdvertisementBytes, kAdvertisement,
                             static_cast<std::uint8_t>(Urgency::kCommand)});
      next += Time::from_seconds(options_.advertisement_period *
                                 advertisement_times_[node].uniform(0.9, 1.1));
    }
  }
}

void MediumRadio::note_neighbours(Time now, std::vector<Event>& events) {
  if (!knows_neighbours_ || now < next_check_) return;
  next_check_ = now + Time::from_seconds(1);
  neighbours_.step(now, changes_);
  if (options_.advertisement_period > 0)
    for (const Neighbours::Change& change : changes_)
      events.push_back({now, EntityId{change.node},
                        change.found ? "neighbour-found" : "neighbour-lost",
                        name_(EntityId{change.other})});
  changes_.clear();
}

void MediumRadio::on_frame(const Frame& frame, Time now) {
  meter_.frame(frame);
  if (frame.kind != FrameKind::kData || frame.tag == kAdvertisement) return;
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
  meter_.received(data, receiver, reception);
  if (knows_neighbours_) neighbours_.hear(receiver, data.from, now, changes_);
  if (data.tag == kAdvertisement) return;
  Post& post = posts_[data.tag];
  if (!has_all(post, receiver)) return;
  arrive(transfers_[post.transfer], receiver, post.hop, now);
  pass_on(post.transfer, receiver, post.hop, now);
}

// Whoever gets a message that floods, and is not its end, sends it once.
void MediumRadio::pass_on(std::uint32_t index, NodeIndex node, std::uint32_t hop,
                          Time now) {
  Transfer& transfer = transfers_[index];
  if (transfer.reached.empty() || transfer.reached[node]) return;
  transfer.reached[node] = true;
  const bool is_end = !transfer.to_all && transfer.copies[0].message.to.value == node;
  if (is_end || hop >= options_.hops) return;
  const double wait = options_.relay_delay * relay_delays_[node].uniform();
  post(index, node, hop + 1, now + Time::from_seconds(wait));
}

void MediumRadio::arrive(Transfer& transfer, NodeIndex receiver, std::uint32_t hop,
                         Time now) {
  for (Transfer::Copy& copy : transfer.copies) {
    if (copy.arrived || copy.message.to.value != receiver) continue;
    copy.arrived = true;
    transfer.way.hops = hop;
    meter_.message_arrived(copy.message.from, copy.message.to, now - copy.message.sent);
    // Who it came from is still needed where it is passed on.
    Message arrived = std::move(copy.message);
    copy.message.from = arrived.from;
    copy.message.to = arrived.to;
    news_->ended.push_back({std::move(arrived), LossCause::kNone, transfer.way});
    return;
  }
}

void MediumRadio::on_finished(const Packet& packet, PacketEnd end, Time now) {
  meter_.lost(packet.order.from, end);
  if (end != PacketEnd::kQueueFull)
    meter_.queue(packet.order.from, medium_.waiting(packet.order.from) + 1);
  if (packet.order.tag == kAdvertisement) return;
  end_part(static_cast<std::uint32_t>(packet.order.tag), cause_of_end(end), now);
}

}  // namespace skein::communication
