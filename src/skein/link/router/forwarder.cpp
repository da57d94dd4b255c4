// SPDX-License-Identifier: Apache-2.0
#include "skein/link/router/forwarder.h"

#include <fmt/format.h>

#include "skein/link/mavlink/unsigned_frames.h"

namespace skein::router {
namespace {

constexpr std::size_t kMaxGone = 100;

}  // namespace

void Forwarder::opened(transport::ChannelId channel, transport::EndpointId,
                       const std::string& name) {
  Peer& peer = peers_[channel];
  peer.health.name = name;
  peer.is_local = transport::is_local_channel(name);
  router_.open(channel);
  news_(fmt::format("{} is open", name));
}

void Forwarder::received(transport::ChannelId channel, std::span<const std::byte> bytes) {
  Peer& peer = peers_.at(channel);
  peer.parser.read(bytes, [&](const mavlink::Frame& frame) {
    peer.watch.hear(frame);
    if (tlog_ && !carries_key(frame)) tlog_->write(clock_(), frame);
    if (!unsigned_orders_ && !peer.is_local && !frame.is_signed() &&
        !mavlink::changes_nothing(frame)) {
      if (++refused_orders_ == 1)
        news_(fmt::format("{}: commands without a signature are not handed on",
                          peer.health.name));
      return;
    }
    router_.route(channel, frame, to_);
    for (const Channel to : to_) {
      ChannelHealth& there = peers_.at(to).health;
      ++(endpoints_.send(to, frame.bytes) ? there.out : there.dropped);
    }
  });
}

void Forwarder::closed(transport::ChannelId channel, const std::string& why) {
  const auto peer = peers_.find(channel);
  ChannelHealth health = health_of(channel, peer->second);
  health.open = false;
  news_(fmt::format("{} is closed: {}", health.name, why));
  if (gone_.size() >= kMaxGone) gone_.erase(gone_.begin());
  gone_.push_back(std::move(health));
  router_.close(channel);
  peers_.erase(peer);
}

Result<void> Forwarder::flush() {
  if (!tlog_) return {};
  return tlog_->flush();
}

ChannelHealth Forwarder::health_of(transport::ChannelId channel, const Peer& peer) const {
  ChannelHealth health = peer.health;
  health.in = peer.parser.counts();
  health.lost = peer.watch.lost();
  health.loss = peer.watch.loss();
  health.systems = router_.systems_of(channel);
  return health;
}

std::vector<ChannelHealth> Forwarder::health() const {
  std::vector<ChannelHealth> all = gone_;
  for (const auto& [channel, peer] : peers_) all.push_back(health_of(channel, peer));
  return all;
}

}  // namespace skein::router
