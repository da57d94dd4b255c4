// SPDX-License-Identifier: Apache-2.0
#include "skein/link/impairment/impaired_channel.h"

#include <algorithm>
#include <cmath>

namespace skein::impairment {
namespace {

// Pieces of a stream that are transmitted at a rate: small, so that they flow.
constexpr std::size_t kPiece = 256;
// Packets that are larger do not keep their memory.
constexpr std::size_t kKeptBytes = 2048;
constexpr double kLongest = 1e9;  // transmission [s]: longer than anything runs

double bits_of(std::size_t bytes) {
  return 8 * static_cast<double>(bytes);
}

}  // namespace

ChannelCounts& ChannelCounts::operator+=(const ChannelCounts& other) {
  packets_in += other.packets_in;
  bytes_in += other.bytes_in;
  packets_out += other.packets_out;
  bytes_out += other.bytes_out;
  lost_by_chance += other.lost_by_chance;
  lost_queue_full += other.lost_queue_full;
  lost_in_outage += other.lost_in_outage;
  duplicated += other.duplicated;
  reordered += other.reordered;
  delay_sum += other.delay_sum;
  delay_max = std::max(delay_max, other.delay_max);
  return *this;
}

ImpairedChannel::ImpairedChannel(Traffic traffic, const Impairment& impairment,
                                 const RandomStream& chance, const Outages& outages)
    : traffic_(traffic), impairment_(impairment), chance_(chance), outages_(outages) {}

void ImpairedChannel::set(const Impairment& impairment, Time now) {
  advance(now);
  if (sending_) {
    bits_left_ =
        std::max(0.0, bits_left_ - impairment_.rate * (now - sent_from_).seconds());
    sent_from_ = now;
  }
  if (traffic_ == Traffic::kPackets && impairment.delay != impairment_.delay)
    last_arrival_ = now;
  impairment_ = impairment;
  blocked_until_ = now;
  advance(now);
}

void ImpairedChannel::cut(Time now, Time until) {
  advance(now);
  cut_until_ = until;
  blocked_until_ = now;
  advance(now);
}

void ImpairedChannel::put(std::span<const std::byte> bytes, Time now) {
  advance(now);
  ++counts_.packets_in;
  counts_.bytes_in += bytes.size();
  if (traffic_ == Traffic::kPackets) {
    if (impairment_.cut || outage_end(now)) {
      ++counts_.lost_in_outage;
      return;
    }
    if (is_full(bytes.size())) {
      ++counts_.lost_queue_full;
      return;
    }
    enqueue(hold(bytes, now));
  } else {
    const std::size_t piece = impairment_.rate > 0 ? kPiece : bytes.size();
    for (; !bytes.empty(); bytes = bytes.subspan(std::min(piece, bytes.size())))
      enqueue(hold(bytes.first(std::min(piece, bytes.size())), now));
  }
  advance(now);
}

std::optional<Time> ImpairedChannel::next() const {
  std::optional<Time> at;
  if (!under_way_.empty()) at = under_way_.front().arrival;
  if (waiting_.packets == 0) return at;
  if (!sending_ && impairment_.cut) return at;
  const Time event =
      sending_ ? transmission_end()
               : std::max({slots_[waiting_.first].came, idle_from_, blocked_until_});
  return at ? std::min(*at, event) : event;
}

std::optional<std::span<const std::byte>> ImpairedChannel::take(Time now) {
  advance(now);
  if (taken_ != kNone) free(taken_);
  taken_ = kNone;
  if (under_way_.empty() || under_way_.front().arrival > now) return std::nullopt;
  std::pop_heap(under_way_.begin(), under_way_.end(), later);
  const Flight flight = under_way_.back();
  under_way_.pop_back();
  taken_ = flight.slot;
  const Slot& slot = slots_[flight.slot];
  ++counts_.packets_out;
  counts_.bytes_out += slot.bytes.size();
  if (flight.order < highest_out_) ++counts_.reordered;
  highest_out_ = std::max(highest_out_, flight.order);
  counts_.delay_sum += now - slot.came;
  counts_.delay_max = std::max(counts_.delay_max, now - slot.came);
  return std::span(slot.bytes);
}

std::size_t ImpairedChannel::room() const {
  const std::size_t packets = waiting_.packets + under_way_.size();
  if (packets >= kMaxPackets || held_bytes_ >= kMaxBytes) return 0;
  if (waiting_.bytes >= impairment_.queue_bytes) return 0;
  return std::min({kMaxBytes - held_bytes_, impairment_.queue_bytes - waiting_.bytes,
                   (kMaxPackets - packets) * kPiece});
}

bool ImpairedChannel::later(const Flight& a, const Flight& b) {
  return a.arrival > b.arrival || (a.arrival == b.arrival && a.order > b.order);
}

// Transmits what is due, each packet at its own moment.
void ImpairedChannel::advance(Time now) {
  while (waiting_.packets > 0) {
    if (!sending_) {
      const Slot& slot = slots_[waiting_.first];
      const Time start = std::max({slot.came, idle_from_, blocked_until_});
      if (start > now || impairment_.cut) return;
      if (const auto end = outage_end(start)) {
        blocked_until_ = *end;
        continue;
      }
      sending_ = true;
      sent_from_ = start;
      bits_left_ = bits_of(slot.bytes.size());
    }
    const Time end = transmission_end();
    if (end > now) return;
    sending_ = false;
    idle_from_ = end;
    launch(dequeue(), end);
  }
}

// When the outage at `now` ends that has a time; none when there is none.
std::optional<Time> ImpairedChannel::outage_end(Time now) {
  auto end = outages_.until(now);
  if (cut_until_ > now) end = end ? std::max(*end, cut_until_) : cut_until_;
  return end;
}

Time ImpairedChannel::transmission_end() const {
  if (impairment_.rate <= 0) return sent_from_;
  const double seconds = std::min(bits_left_ / impairment_.rate, kLongest);
  return sent_from_ + Time::from_ns(static_cast<std::int64_t>(std::ceil(seconds * 1e9)));
}

bool ImpairedChannel::holds_enough(std::size_t bytes) const {
  return waiting_.packets + under_way_.size() >= kMaxPackets ||
         held_bytes_ + bytes > kMaxBytes;
}

bool ImpairedChannel::is_full(std::size_t bytes) const {
  return holds_enough(bytes) ||
         (waiting_.packets > 0 && waiting_.bytes + bytes > impairment_.queue_bytes);
}

std::uint32_t ImpairedChannel::hold(std::span<const std::byte> bytes, Time came) {
  if (free_.empty()) {
    free_.push_back(static_cast<std::uint32_t>(slots_.size()));
    slots_.emplace_back();
  }
  const std::uint32_t index = free_.back();
  free_.pop_back();
  Slot& slot = slots_[index];
  slot.came = came;
  slot.bytes.assign(bytes.begin(), bytes.end());
  slot.next = kNone;
  held_bytes_ += bytes.size();
  return index;
}

void ImpairedChannel::free(std::uint32_t index) {
  Slot& slot = slots_[index];
  held_bytes_ -= slot.bytes.size();
  slot.bytes.clear();
  if (slot.bytes.capacity() > kKeptBytes) slot.bytes.shrink_to_fit();
  free_.push_back(index);
}

void ImpairedChannel::enqueue(std::uint32_t index) {
  (waiting_.packets == 0 ? waiting_.first : slots_[waiting_.last].next) = index;
  waiting_.last = index;
  ++waiting_.packets;
  waiting_.bytes += slots_[index].bytes.size();
}

std::uint32_t ImpairedChannel::dequeue() {
  const std::uint32_t index = waiting_.first;
  waiting_.first = slots_[index].next;
  --waiting_.packets;
  waiting_.bytes -= slots_[index].bytes.size();
  return index;
}

// A packet has been transmitted.
void ImpairedChannel::launch(std::uint32_t index, Time sent) {
  if (traffic_ == Traffic::kBytes) return fly(index, sent);
  const bool lost = chance_.uniform() < impairment_.loss;
  const bool twice = chance_.uniform() < impairment_.duplicate;
  if (lost) {
    ++counts_.lost_by_chance;
    return free(index);
  }
  fly(index, sent);
  if (!twice || holds_enough(slots_[index].bytes.size())) return;
  ++counts_.duplicated;
  // hold() may move the slots, not the bytes of this one.
  const std::span<const std::byte> bytes(slots_[index].bytes);
  const Time came = slots_[index].came;
  fly(hold(bytes, came), sent);
}

void ImpairedChannel::fly(std::uint32_t index, Time sent) {
  const bool held_back =
      traffic_ == Traffic::kPackets && chance_.uniform() < impairment_.reorder;
  Time arrival = sent + draw_delay();
  if (held_back) {
    arrival += Time::from_seconds(impairment_.reorder_delay);
  } else {
    arrival = std::max(arrival, last_arrival_);
    last_arrival_ = arrival;
  }
  under_way_.push_back({arrival, ++launched_, index});
  std::push_heap(under_way_.begin(), under_way_.end(), later);
}

Time ImpairedChannel::draw_delay() {
  double delay = impairment_.delay;
  if (impairment_.jitter > 0)
    delay += impairment_.jitter * (impairment_.jitter_kind == JitterKind::kUniform
                                       ? chance_.uniform()
                                       : chance_.normal());
  return Time::from_seconds(std::max(0.0, delay));
}

}  // namespace skein::impairment
