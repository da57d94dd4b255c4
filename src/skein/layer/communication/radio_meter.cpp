// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/radio_meter.h"

#include <algorithm>
#include <utility>

#include "skein/layer/communication/medium/links.h"

namespace skein::communication {
namespace {

constexpr Time kMarkPeriod = Time::from_ns(100'000'000);

double decibel(double ratio) {
  return dbm(ratio) - 30;
}

}  // namespace

RadioMeter::RadioMeter(AccessMethod access, std::size_t nodes)
    : access_(access), nodes_(nodes), links_(nodes) {}

void RadioMeter::frame(const Frame& frame) {
  ++nodes_[frame.from].use.frames;
  nodes_[frame.from].sending += frame.duration;
}

void RadioMeter::queue(NodeIndex node, std::size_t waiting) {
  auto& most = nodes_[node].use.waiting;
  most = std::max(most, static_cast<std::uint32_t>(waiting));
}

void RadioMeter::lost(NodeIndex node, PacketEnd end) {
  RadioUse& use = nodes_[node].use;
  if (end == PacketEnd::kQueueFull) ++use.queue_full;
  if (end == PacketEnd::kRetryLimit) ++use.retry_limit;
  if (end == PacketEnd::kExpired) ++use.expired;
}

void RadioMeter::received(const Frame& data, NodeIndex node, const Reception& reception) {
  ++nodes_[node].use.received;
  LinkSums& sums = link(data.from, node);
  ++sums.frames;
  sums.rssi_dbm += dbm(reception.power);
  sums.sinr_db += decibel(reception.sinr);
}

void RadioMeter::message_arrived(EntityId from, EntityId to, Time delay) {
  LinkSums& sums = link(from.value, to.value);
  ++sums.arrived;
  sums.delay += delay.seconds();
}

void RadioMeter::message_lost(EntityId from, EntityId to) {
  if (from.value < nodes_.size() && to.value < nodes_.size())
    ++link(from.value, to.value).lost;
}

RadioMeter::LinkSums& RadioMeter::link(NodeIndex from, NodeIndex to) {
  auto& links = links_[from];
  const auto place = std::lower_bound(
      links.begin(), links.end(), to,
      [](const LinkSums& sums, NodeIndex node) { return sums.to < node; });
  if (place != links.end() && place->to == to) return *place;
  LinkSums sums;
  sums.to = to;
  return *links.insert(place, sums);
}

void RadioMeter::step(Time now, const std::function<Time(NodeIndex)>& heard) {
  now_ = now;
  if (marks_ > 0 && now < mark_times_[(marks_ - 1) % kMarks] + kMarkPeriod) return;
  const std::size_t place = marks_ % kMarks;
  // The oldest mark: a second ago, or the beginning.
  const std::size_t oldest = marks_ < kMarks ? 0 : (marks_ + 1) % kMarks;
  mark_times_[place] = now;
  ++marks_;
  const Time span = now - mark_times_[oldest];
  for (NodeIndex k = 0; k < nodes_.size(); ++k) {
    Node& node = nodes_[k];
    node.heard = heard(k);
    node.marks[place] = {node.sending, node.heard};
    if (span <= Time()) continue;
    const Mark& old = node.marks[oldest];
    Time used = node.sending - old.sending;
    if (access_ == AccessMethod::kTdma)
      used = used * static_cast<std::int64_t>(nodes_.size());
    else if (access_ == AccessMethod::kDcf)
      used += node.heard - old.heard;
    node.load = std::min(1.0, used.seconds() / span.seconds());
  }
}

RadioStatistics RadioMeter::take() {
  RadioStatistics all;
  const double span = (now_ - std::exchange(taken_, now_)).seconds();
  for (Node& node : nodes_) {
    RadioUse use = std::exchange(node.use, {});
    const Time sending = node.sending - std::exchange(node.taken_sending, node.sending);
    const Time hearing = node.heard - std::exchange(node.taken_heard, node.heard);
    if (span > 0) {
      use.sending_share = sending.seconds() / span;
      use.busy_share = hearing.seconds() / span;
    }
    all.radios.push_back(use);
  }
  for (NodeIndex from = 0; from < links_.size(); ++from) {
    for (const LinkSums& sums : links_[from]) {
      LinkUse use{EntityId{from}, EntityId{sums.to}, sums.arrived, sums.lost, {}, {}, {}};
      if (sums.frames > 0) {
        use.rssi_dbm = sums.rssi_dbm / sums.frames;
        use.sinr_db = sums.sinr_db / sums.frames;
      }
      if (sums.arrived > 0) use.delay = sums.delay / sums.arrived;
      all.links.push_back(use);
    }
    links_[from].clear();
  }
  return all;
}

}  // namespace skein::communication
