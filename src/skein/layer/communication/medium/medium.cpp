// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/medium/medium.h"

#include <algorithm>
#include <utility>

#include "skein/base/check.h"
#include "skein/layer/communication/medium/dcf.h"
#include "skein/layer/communication/medium/direct_access.h"
#include "skein/layer/communication/medium/tdma.h"

namespace skein::communication {
namespace {

std::unique_ptr<Access> make_access(const RadioProfile& profile, Links& links,
                                    Schedule& schedule, PacketStore& packets,
                                    MediumListener& listener, std::uint64_t seed) {
  switch (profile.mac.access) {
    case AccessMethod::kTdma:
      return std::make_unique<Tdma>(profile, links.size(), links.members(), schedule,
                                    packets, listener);
    case AccessMethod::kDirect:
      return std::make_unique<DirectAccess>(profile, links, schedule, packets, listener,
                                            seed);
    case AccessMethod::kDcf:
      break;
  }
  return std::make_unique<Dcf>(profile, links, schedule, packets, listener, seed);
}

}  // namespace

Medium::Medium(const RadioProfile& profile, const Propagation& propagation,
               Links::Nodes nodes, std::uint64_t seed, MediumListener& listener)
    : profile_(profile),
      links_(profile_.phy, propagation, std::move(nodes)),
      expiry_expected_(links_.size()),
      access_(make_access(profile_, links_, schedule_, packets_, listener, seed)),
      channel_(profile_.phy, links_, schedule_, *access_, seed),
      listener_(listener) {
  access_->use(channel_);
}

void Medium::advance(Time until) {
  SKEIN_CHECK(until >= now_);
  while (!schedule_.empty() && schedule_.next_time() < until) {
    const Schedule::Event event = schedule_.take();
    now_ = event.time;
    if (event.kind < ScheduledKind::kAccess)
      channel_.handle(event);
    else if (event.kind < ScheduledKind::kOrder)
      access_->handle(event);
    else if (event.kind == ScheduledKind::kOrder)
      hand_over(event.index);
    else if (event.kind == ScheduledKind::kExpiry)
      drop_expired(event.index);
    else
      channel_.transmit({.from = event.index,
                         .to = kAllNodes,
                         .duration = Time::from_ns(event.stamp),
                         .noise = true},
                        now_);
  }
  now_ = until;
}

void Medium::send_at(Time time, const PacketOrder& order) {
  std::uint32_t place = 0;
  if (free_orders_.empty()) {
    place = static_cast<std::uint32_t>(orders_.size());
    orders_.push_back(order);
  } else {
    place = free_orders_.back();
    free_orders_.pop_back();
    orders_[place] = order;
  }
  schedule_.add(std::max(time, now_), ScheduledKind::kOrder, place);
}

void Medium::send_noise_at(Time time, NodeIndex node, Time duration) {
  const auto length = static_cast<std::uint32_t>(duration.ns());
  SKEIN_CHECK(node < links_.size() && length > 0 && length == duration.ns());
  schedule_.add(std::max(time, now_), ScheduledKind::kNoise, node, length);
}

void Medium::hand_over(std::uint32_t place) {
  const PacketOrder order = orders_[place];
  free_orders_.push_back(place);
  if (!send(order))
    listener_.on_finished({order, now_, 0, 0, false}, PacketEnd::kQueueFull, now_);
}

bool Medium::send(const PacketOrder& order) {
  SKEIN_CHECK(order.from < links_.size() &&
              (order.to < links_.size() || order.to == kAllNodes));
  PacketQueue& queue = access_->queue(order.from);
  if (queue.size() >= profile_.mac.queue_packets) {
    const auto dropped = queue.take_less_urgent(order.urgency);
    if (!dropped) return false;
    const Packet packet = packets_[*dropped];
    packets_.remove(*dropped);
    listener_.on_finished(packet, PacketEnd::kQueueFull, now_);
  }
  access_->enqueue(packets_.add(order, now_), now_);
  expect_expiry(order.from);
  return true;
}

// Sees to it that packets do not wait longer than they live, whether their node ever gets
// to send or not.
void Medium::expect_expiry(NodeIndex node) {
  if (!profile_.mac.queue_lifetime || expiry_expected_[node]) return;
  std::optional<Time> oldest;
  access_->queue(node).look_at_waiting([&](std::uint32_t place) {
    oldest = std::min(oldest.value_or(now_), packets_[place].created);
  });
  if (!oldest) return;
  expiry_expected_[node] = true;
  schedule_.add(std::max(now_, *oldest + *profile_.mac.queue_lifetime) + Time::from_ns(1),
                ScheduledKind::kExpiry, node);
}

void Medium::drop_expired(NodeIndex node) {
  expired_.clear();
  access_->queue(node).take_old(
      [&](std::uint32_t place) {
        return now_ - packets_[place].created > *profile_.mac.queue_lifetime;
      },
      expired_);
  for (const std::uint32_t place : expired_) {
    const Packet packet = packets_[place];
    packets_.remove(place);
    listener_.on_finished(packet, PacketEnd::kExpired, now_);
  }
  expiry_expected_[node] = false;
  expect_expiry(node);
}

bool Medium::reaches(NodeIndex from, NodeIndex to) {
  for (const Link& link : links_.of(from, now_))
    if (link.to == to) return channel_.in_range(link);
  return false;
}

std::vector<NodeIndex> Medium::in_range(NodeIndex from) {
  std::vector<NodeIndex> found;
  for (const Link& link : links_.of(from, now_))
    if (channel_.in_range(link)) found.push_back(link.to);
  return found;
}

}  // namespace skein::communication
