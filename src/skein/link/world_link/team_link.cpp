// SPDX-License-Identifier: Apache-2.0
#include "skein/link/world_link/team_link.h"

#include <utility>

#include "skein/data/describe/walk.h"
#include "skein/data/describe/wire.h"

namespace skein::world_link {
namespace {

const Time kPresence = Time::from_seconds(1);
const Time kSilence = Time::from_seconds(3);
constexpr std::size_t kMaxPeers = 1000;
constexpr std::int64_t kMaxClock = std::int64_t{1} << 55;

}  // namespace

void TeamLink::send(std::optional<Message> message, Time now, const Send& send) {
  TeamPacket packet;
  packet.session = session_;
  packet.from = self_;
  packet.number = ++packets_;
  packet.sent = now;
  packet.message = std::move(message);
  std::vector<std::byte> bytes;
  wire::encode(packet, bytes);
  last_sent_ = now;
  send(bytes);
}

void TeamLink::send(const Message& message, Time now, const Send& out) {
  send(std::optional<Message>(message), now, out);
}

void TeamLink::step(Time now, const Send& out) {
  if (!last_sent_ || now - *last_sent_ >= kPresence) send(std::nullopt, now, out);
}

bool TeamLink::is_new(Peer& peer, std::uint64_t number) {
  if (number > peer.newest) {
    const std::uint64_t by = number - peer.newest;
    peer.before = by < 64 ? (peer.before << by | std::uint64_t{1} << (by - 1)) : 0;
    peer.newest = number;
    return true;
  }
  const std::uint64_t back = peer.newest - number;
  if (back == 0 || back > 64) return false;
  const std::uint64_t bit = std::uint64_t{1} << (back - 1);
  return (std::exchange(peer.before, peer.before | bit) & bit) == 0;
}

void TeamLink::receive(std::span<const std::byte> bytes, Time now,
                       std::vector<Message>& out) {
  auto read = wire::decode<TeamPacket>(bytes);
  if (!read) return;
  TeamPacket& packet = read.value();
  if (packet.protocol != TeamPacket().protocol || packet.from == self_ ||
      packet.sent.ns() > kMaxClock || packet.sent.ns() < -kMaxClock)
    return;
  if (!peers_.contains(packet.from) && peers_.size() >= kMaxPeers) return;
  Peer& peer = peers_[packet.from];
  if (packet.session != peer.session) {
    if (packet.session < peer.session && now - peer.heard <= kSilence) return;
    peer = {packet.session, 0, 0, now, {}};
  }
  if (!is_new(peer, packet.number)) return;
  peer.heard = now;
  peer.alignment.hear(packet.sent, now);
  if (!packet.message || packet.message->to != self_ ||
      !walk::has_sound_numbers(*packet.message))
    return;
  packet.message->from = packet.from;
  walk::shift_times(*packet.message,
                    peer.alignment.to_here(packet.sent, now) - packet.sent);
  out.push_back(std::move(*packet.message));
}

bool TeamLink::hears(EntityId other, Time now) const {
  const auto peer = peers_.find(other);
  return peer != peers_.end() && now - peer->second.heard <= kSilence;
}

}  // namespace skein::world_link
