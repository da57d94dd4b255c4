// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/medium/dcf.h"

#include <algorithm>

#include "skein/base/check.h"

namespace skein::communication {
namespace {

constexpr std::uint32_t kBackoffs = 1;  // of a node's random streams for its radio

}  // namespace

Dcf::Dcf(const RadioProfile& profile, const Links& links, Schedule& schedule,
         PacketStore& packets, MediumListener& listener, std::uint64_t seed)
    : mac_(profile.mac),
      phy_(profile.phy),
      schedule_(schedule),
      packets_(packets),
      listener_(listener),
      ack_airtime_(phy_.airtime(kAckBytes)),
      cts_airtime_(phy_.airtime(kCtsBytes)),
      // [802.11] 10.3.2.4: what follows an RTS has begun by then.
      nav_reset_delay_(mac_.sifs * 2 + cts_airtime_ + phy_.preamble_header +
                       mac_.slot * 2),
      stations_(links.size()) {
  if (mac_.adaptive_power) power_.emplace(profile, links);
  backoffs_.reserve(links.size());
  for (NodeIndex node = 0; node < links.size(); ++node) {
    backoffs_.emplace_back(seed, node, Purpose::kRadio, kBackoffs);
    stations_[node].window = mac_.cw_min;
    draw_backoff(node, Time());
  }
}

bool Dcf::is_busy(const Station& station, Time now) const {
  return std::max({station.rx_end, station.busy_end, station.tx_end, station.nav_end}) >
         now;
}

// When slots begin to count: a DIFS after the last thing that kept the medium busy.
Time Dcf::access_start(const Station& station, Time now) const {
  const Time quiet = std::max({station.rx_end, station.busy_end, station.tx_end,
                               station.nav_end, station.timeout_end}) +
                     mac_.difs;
  const Time after_loss = station.last_payload_lost && station.rx_end <= now
                              ? station.rx_end + mac_.eifs
                              : Time();
  return std::max({station.backoff_start, quiet, after_loss});
}

// Takes the whole slots that have been idle off the back-off.
void Dcf::count_slots(Station& station, Time now) {
  if (station.backoff_slots == 0) return;
  const Time start = access_start(station, now);
  if (start >= now) return;
  const auto idle = (now - start).ns() / mac_.slot.ns();
  const auto counted =
      static_cast<std::uint32_t>(std::min<std::int64_t>(idle, station.backoff_slots));
  station.backoff_slots -= counted;
  station.backoff_start = start + mac_.slot * counted;
}

void Dcf::draw_backoff(NodeIndex node, Time now) {
  Station& station = stations_[node];
  station.backoff_start = now;
  station.backoff_slots = mac_.backoff_slots
                              ? *mac_.backoff_slots
                              : static_cast<std::uint32_t>(backoffs_[node].uniform() *
                                                           (station.window + 1.0));
}

void Dcf::enqueue(std::uint32_t packet, Time now) {
  const NodeIndex node = packets_[packet].order.from;
  Station& station = stations_[node];
  if (station.queue.empty() && !station.in_service) {
    count_slots(station, now);
    if (station.backoff_slots == 0) {
      if (is_busy(station, now))
        draw_backoff(node, now);
      else
        station.backoff_start = now + mac_.difs;
    }
  }
  station.queue.push(packet, packets_[packet].order.urgency);
  expect_access(node, now);
}

// Sees to it that the end of the back-off is not missed.
void Dcf::expect_access(NodeIndex node, Time now) {
  Station& station = stations_[node];
  if (station.queue.empty() || station.in_service) return;
  count_slots(station, now);
  const Time at =
      std::max(now, access_start(station, now) + mac_.slot * station.backoff_slots);
  if (station.access_expected && station.access_at <= at) return;
  station.access_expected = true;
  station.access_at = at;
  schedule_.add(at, ScheduledKind::kAccess, node, ++station.access_stamp);
}

void Dcf::on_access(NodeIndex node, Time now) {
  Station& station = stations_[node];
  station.access_expected = false;
  if (station.queue.empty() || station.in_service) return;
  count_slots(station, now);
  if (access_start(station, now) + mac_.slot * station.backoff_slots > now)
    return expect_access(node, now);
  station.in_service = true;
  station.queue.serve_front();
  Packet& packet = packets_[station.queue.front()];
  const std::uint32_t bytes = packet.order.bytes + mac_.data_overhead_bytes;
  if (packet.order.to == kAllNodes || bytes <= mac_.rts_threshold_bytes)
    return send_data(node, now);
  ++packet.rts_sent;
  const Frame rts{
      .kind = FrameKind::kRts,
      .from = node,
      .to = packet.order.to,
      .tag = packet.order.tag,
      .mac_bytes = kRtsBytes,
      .duration = phy_.airtime(kRtsBytes),
      .reserved = mac_.sifs * 3 + cts_airtime_ + phy_.airtime(bytes) + ack_airtime_};
  send(rts, now);
  await(node, Waiting::kCts, now + rts.duration + mac_.ack_timeout);
}

double Dcf::power_to(NodeIndex node, NodeIndex to) const {
  return power_ && to != kAllNodes ? power_->share(node, to) : 1;
}

void Dcf::send_data(NodeIndex node, Time now) {
  Station& station = stations_[node];
  const std::uint32_t place = station.queue.front();
  Packet& packet = packets_[place];
  ++packet.transmissions;
  const std::uint32_t bytes = packet.order.bytes + mac_.data_overhead_bytes;
  const bool to_all = packet.order.to == kAllNodes;
  const Frame data{.kind = FrameKind::kData,
                   .from = node,
                   .to = packet.order.to,
                   .packet = place,
                   .tag = packet.order.tag,
                   .mac_bytes = bytes,
                   .duration = phy_.airtime(bytes),
                   .reserved = to_all ? Time() : mac_.sifs + ack_airtime_,
                   .power = power_to(node, packet.order.to)};
  send(data, now);
  if (to_all) {
    station.waiting = Waiting::kSending;
    schedule_.add(now + data.duration, ScheduledKind::kSent, node);
  } else {
    await(node, Waiting::kAck, now + data.duration + mac_.ack_timeout);
  }
}

void Dcf::send(const Frame& frame, Time now) {
  Station& station = stations_[frame.from];
  station.last_payload_lost = false;
  station.rx_end = std::min(station.rx_end, now);
  count_slots(station, now);
  station.tx_end = now + frame.duration;
  listener_.on_frame(frame, now);
  channel_->transmit(frame, now);
}

void Dcf::await(NodeIndex node, Waiting what, Time until) {
  Station& station = stations_[node];
  station.waiting = what;
  station.timeout_end = until;
  station.timeout_at = until;
  schedule_.add(until, ScheduledKind::kTimeout, node, ++station.timeout_stamp);
}

void Dcf::respond(NodeIndex node, const Frame& frame, Time now) {
  stations_[node].response = frame;
  schedule_.add(now + mac_.sifs, ScheduledKind::kResponse, node);
}

void Dcf::handle(const Schedule::Event& event) {
  const NodeIndex node = event.index;
  Station& station = stations_[node];
  const Time now = event.time;
  switch (event.kind) {
    case ScheduledKind::kAccess:
      if (event.stamp == station.access_stamp) on_access(node, now);
      return;
    case ScheduledKind::kTimeout:
      if (event.stamp == station.timeout_stamp) on_timeout(node, now);
      return;
    case ScheduledKind::kResponse:
      if (station.response.kind == FrameKind::kData)
        send_data(node, now);
      else
        send(station.response, now);
      return;
    case ScheduledKind::kSent:
      finish(node, PacketEnd::kDone, now);
      return;
    case ScheduledKind::kNavReset:
      if (!station.nav_may_reset || event.stamp != station.nav_stamp) return;
      station.nav_may_reset = false;
      station.nav_end = now;
      expect_access(node, now);
      return;
    default:
      SKEIN_CHECK(false);
  }
}

void Dcf::on_busy(NodeIndex node, Time now, Time until) {
  Station& station = stations_[node];
  count_slots(station, now);
  station.busy_end = until;
}

void Dcf::on_payload(NodeIndex node, Time now, Time until) {
  Station& station = stations_[node];
  count_slots(station, now);
  station.last_payload_lost = false;
  station.rx_end = until;
  station.nav_may_reset = false;
  if (station.waiting == Waiting::kCts || station.waiting == Waiting::kAck) {
    // The answer may be in it: the time-out waits for its end.
    station.timeout_at = until + Time::from_ns(1);
    schedule_.add(station.timeout_at, ScheduledKind::kTimeout, node,
                  ++station.timeout_stamp);
  }
}

void Dcf::on_payload_lost(NodeIndex node, Time now) {
  Station& station = stations_[node];
  station.last_payload_lost = true;
  station.rx_end = now;
}

void Dcf::on_received(NodeIndex node, Time now, const Frame& frame,
                      const Reception& reception) {
  Station& station = stations_[node];
  if (power_) power_->heard(node, frame.from, reception.power, frame.power);
  if (frame.to != node && frame.to != kAllNodes) {
    if (frame.kind == FrameKind::kData) listener_.on_overheard(frame, node, now);
    return reserve(node, frame, now);
  }
  switch (frame.kind) {
    case FrameKind::kData: {
      if (frame.to == kAllNodes)
        return listener_.on_delivered(frame, node, now, reception);
      respond(node,
              {.kind = FrameKind::kAck,
               .from = node,
               .to = frame.from,
               .mac_bytes = kAckBytes,
               .duration = ack_airtime_,
               .power = power_to(node, frame.from)},
              now);
      Packet& packet = packets_[frame.packet];
      if (packet.delivered) return;
      packet.delivered = true;
      listener_.on_delivered(frame, node, now, reception);
      return;
    }
    case FrameKind::kRts: {
      if (station.nav_end > now) return;
      const Time rest = frame.reserved - mac_.sifs - cts_airtime_;
      respond(node,
              {.kind = FrameKind::kCts,
               .from = node,
               .to = frame.from,
               .mac_bytes = kCtsBytes,
               .duration = cts_airtime_,
               .reserved = rest},
              now);
      return;
    }
    case FrameKind::kCts:
      if (station.waiting != Waiting::kCts) return;
      station.waiting = Waiting::kSending;
      ++station.timeout_stamp;
      station.timeout_end = now;
      station.rts_failures = 0;
      respond(node, Frame{}, now);
      return;
    case FrameKind::kAck:
      if (station.waiting != Waiting::kAck) return;
      if (power_) power_->succeeded(node, frame.from);
      ++station.timeout_stamp;
      station.timeout_end = now;
      finish(node, PacketEnd::kDone, now);
      return;
  }
}

// Others have the medium for what they asked for.
void Dcf::reserve(NodeIndex node, const Frame& frame, Time now) {
  Station& station = stations_[node];
  const Time until = now + frame.reserved;
  if (until <= station.nav_end) return;
  count_slots(station, now);
  station.nav_end = until;
  if (frame.kind != FrameKind::kRts) return;
  station.nav_may_reset = true;
  schedule_.add(now + nav_reset_delay_, ScheduledKind::kNavReset, node,
                ++station.nav_stamp);
}

void Dcf::on_timeout(NodeIndex node, Time now) {
  Station& station = stations_[node];
  const Packet& packet = packets_[station.queue.front()];
  const bool announced = packet.rts_sent > 0;
  bool give_up = false;
  if (power_ && station.waiting == Waiting::kAck) power_->failed(node, packet.order.to);
  if (station.waiting == Waiting::kCts)
    give_up = ++station.rts_failures >= mac_.short_retry_limit;
  else
    give_up = ++station.data_failures >=
              (announced ? mac_.long_retry_limit : mac_.short_retry_limit);
  if (give_up) return finish(node, PacketEnd::kRetryLimit, now);
  station.window = std::min(2 * station.window + 1, mac_.cw_max);
  release(node, now);
}

void Dcf::finish(NodeIndex node, PacketEnd end, Time now) {
  Station& station = stations_[node];
  station.rts_failures = station.data_failures = 0;
  station.window = mac_.cw_min;
  const std::uint32_t place = station.queue.front();
  station.queue.pop_front();
  const Packet packet = packets_[place];
  packets_.remove(place);
  release(node, now);
  listener_.on_finished(packet, end, now);
}

// The medium is free for others: a back-off begins.
void Dcf::release(NodeIndex node, Time now) {
  Station& station = stations_[node];
  station.in_service = false;
  station.waiting = Waiting::kNothing;
  draw_backoff(node, now);
  expect_access(node, now);
}

}  // namespace skein::communication
