// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/medium/direct_access.h"

#include "skein/base/check.h"

namespace skein::communication {
namespace {

constexpr std::uint32_t kLosses = 5;  // of a node's random streams for its radio

}  // namespace

DirectAccess::DirectAccess(const RadioProfile& profile, Links& links, Schedule& schedule,
                           PacketStore& packets, MediumListener& listener,
                           std::uint64_t seed)
    : mac_(profile.mac),
      phy_(profile.phy),
      decode_threshold_(watts(profile.phy.decode_threshold_dbm)),
      noise_(noise_power(profile.phy)),
      links_(links),
      schedule_(schedule),
      packets_(packets),
      listener_(listener),
      stations_(links.size()) {
  losses_.reserve(links.size());
  for (NodeIndex node = 0; node < links.size(); ++node)
    losses_.emplace_back(seed, node, Purpose::kRadio, kLosses);
}

void DirectAccess::enqueue(std::uint32_t packet, Time now) {
  const NodeIndex node = packets_[packet].order.from;
  stations_[node].queue.push(packet, packets_[packet].order.urgency);
  if (stations_[node].queue.size() == 1) begin(node, now);
}

void DirectAccess::begin(NodeIndex node, Time now) {
  Station& station = stations_[node];
  if (station.queue.empty()) return;
  const std::uint32_t place = station.queue.front();
  Packet& packet = packets_[place];
  ++packet.transmissions;
  station.queue.serve_front();
  const std::uint32_t bytes = packet.order.bytes + mac_.data_overhead_bytes;
  const Frame data{.kind = FrameKind::kData,
                   .from = node,
                   .to = packet.order.to,
                   .packet = place,
                   .tag = packet.order.tag,
                   .mac_bytes = bytes,
                   .duration = phy_.airtime(bytes)};
  station.on_the_way.push_back(data);
  listener_.on_frame(data, now);
  schedule_.add(now + data.duration, ScheduledKind::kSent, node);
  schedule_.add(now + data.duration + mac_.latency, ScheduledKind::kResponse, node);
}

void DirectAccess::handle(const Schedule::Event& event) {
  const NodeIndex node = event.index;
  if (event.kind == ScheduledKind::kResponse) return arrive(node, event.time);
  SKEIN_CHECK(event.kind == ScheduledKind::kSent);
  // Whoever waits for its end hears of it when it has arrived.
  stations_[node].queue.pop_front();
  begin(node, event.time);
}

// The oldest that is on the way is there.
void DirectAccess::arrive(NodeIndex node, Time now) {
  Station& station = stations_[node];
  const Frame data = station.on_the_way.front();
  station.on_the_way.pop_front();
  for (const Link& link : links_.of(node, now)) {
    if (data.to != kAllNodes && data.to != link.to) continue;
    if (link.power < decode_threshold_) continue;
    if (mac_.loss > 0 && losses_[node].uniform() < mac_.loss) continue;
    listener_.on_delivered(data, link.to, now, {link.power, link.power / noise_});
  }
  const Packet packet = packets_[data.packet];
  packets_.remove(data.packet);
  listener_.on_finished(packet, PacketEnd::kDone, now);
}

}  // namespace skein::communication
