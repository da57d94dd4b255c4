// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/medium/tdma.h"

#include "skein/base/check.h"

namespace skein::communication {

Tdma::Tdma(const RadioProfile& profile, std::size_t nodes, std::size_t members,
           Schedule& schedule, PacketStore& packets, MediumListener& listener)
    : mac_(profile.mac),
      phy_(profile.phy),
      schedule_(schedule),
      packets_(packets),
      listener_(listener),
      slots_(static_cast<std::int64_t>(members)),
      stations_(nodes) {}

Time Tdma::airtime(std::uint32_t bytes) const {
  return phy_.airtime(bytes + mac_.data_overhead_bytes);
}

// The next beginning of the node's slot that is not before `now`.
Time Tdma::next_slot(NodeIndex node, Time now) const {
  const std::int64_t slot = mac_.slot.ns();
  const std::int64_t frame = slot * slots_;
  const std::int64_t begin = slot * (node % slots_);
  if (now.ns() <= begin) return Time::from_ns(begin);
  const std::int64_t frames = (now.ns() - begin + frame - 1) / frame;
  return Time::from_ns(begin + frames * frame);
}

void Tdma::enqueue(std::uint32_t packet, Time now) {
  const NodeIndex node = packets_[packet].order.from;
  Station& station = stations_[node];
  station.queue.push(packet, packets_[packet].order.urgency);
  if (station.awake) return;
  station.awake = true;
  schedule_.add(next_slot(node, now), ScheduledKind::kAccess, node);
}

void Tdma::handle(const Schedule::Event& event) {
  const NodeIndex node = event.index;
  if (event.kind == ScheduledKind::kSent) finish(node, PacketEnd::kDone, event.time);
  use_slot(node, event.time);
}

// Sends the next packet if what is left of the slot holds it.
void Tdma::use_slot(NodeIndex node, Time now) {
  Station& station = stations_[node];
  while (!station.queue.empty()) {
    Packet& packet = packets_[station.queue.front()];
    const Time duration = airtime(packet.order.bytes);
    if (duration > mac_.slot) {
      finish(node, PacketEnd::kTooLong, now);
      continue;
    }
    const Time slot = next_slot(node, now);
    const Time frame_end =
        slot == now ? now + mac_.slot : slot + mac_.slot - mac_.slot * slots_;
    if (now + duration > frame_end) {
      schedule_.add(slot, ScheduledKind::kAccess, node);
      return;
    }
    ++packet.transmissions;
    station.queue.serve_front();
    const Frame data{.kind = FrameKind::kData,
                     .from = node,
                     .to = packet.order.to,
                     .packet = station.queue.front(),
                     .tag = packet.order.tag,
                     .mac_bytes = packet.order.bytes + mac_.data_overhead_bytes,
                     .duration = duration};
    listener_.on_frame(data, now);
    channel_->transmit(data, now);
    schedule_.add(now + duration, ScheduledKind::kSent, node);
    return;
  }
  station.awake = false;
}

void Tdma::on_received(NodeIndex node, Time now, const Frame& frame,
                       const Reception& reception) {
  if (frame.to == node || frame.to == kAllNodes)
    listener_.on_delivered(frame, node, now, reception);
  else
    listener_.on_overheard(frame, node, now);
}

void Tdma::finish(NodeIndex node, PacketEnd end, Time now) {
  Station& station = stations_[node];
  const std::uint32_t place = station.queue.front();
  station.queue.pop_front();
  const Packet packet = packets_[place];
  packets_.remove(place);
  listener_.on_finished(packet, end, now);
}

}  // namespace skein::communication
