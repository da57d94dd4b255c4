// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/communication/medium/channel.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/layer/communication/medium/error_model.h"

namespace skein::communication {
namespace {

constexpr std::uint32_t kReceptions = 2;  // of a node's random streams for its radio
constexpr Time kHeader = Time::from_ns(48'000);  // what the preamble ends with

}  // namespace

Channel::Channel(const PhyProfile& phy, Links& links, Schedule& schedule,
                 ChannelListener& listener, std::uint64_t seed)
    : phy_(phy),
      links_(links),
      schedule_(schedule),
      listener_(listener),
      noise_(noise_power(phy)),
      decode_threshold_(watts(phy.decode_threshold_dbm)),
      carrier_sense_threshold_(watts(phy.carrier_sense_threshold_dbm)),
      floor_(watts(phy.interference_floor_dbm)),
      lock_ratio_(math::pow(10, phy.lock_sinr_db / 10)),
      errors_of_bits_(phy.error_model ? phy.error_model
                                      : std::make_shared<Dsss2>(phy.rate)),
      preamble_(std::max(Time(), phy.preamble_header - kHeader)),
      receivers_(links.size()) {
  errors_.reserve(links.size());
  for (NodeIndex node = 0; node < links.size(); ++node)
    errors_.emplace_back(seed, node, Purpose::kRadio, kReceptions);
}

Channel::FrameIndex Channel::free_place() {
  if (free_.empty()) {
    on_air_.emplace_back();
    return static_cast<FrameIndex>(on_air_.size() - 1);
  }
  const FrameIndex place = free_.back();
  free_.pop_back();
  return place;
}

void Channel::transmit(const Frame& frame, Time now) {
  Receiver& sender = receivers_[frame.from];
  sender.candidates.clear();
  sender.locked = kNone;
  sender.sending_until = now + frame.duration;

  const FrameIndex index = free_place();
  OnAir& on_air = on_air_[index];
  on_air.frame = frame;
  on_air.start = now;
  on_air.links = links_.of(frame.from, now);
  if (frame.power < 1) {
    for (Link& link : on_air.links) link.power *= frame.power;
    std::erase_if(on_air.links, [&](const Link& link) { return link.power < floor_; });
  }
  on_air.locked.clear();
  on_air.next_arrival = on_air.next_detection = on_air.next_header = on_air.next_end = 0;
  if (on_air.links.empty()) {
    free_.push_back(index);
    return;
  }
  const Time first = now + on_air.links.front().delay;
  schedule_.add(first, ScheduledKind::kArrival, index);
  // A piece of noise may be shorter than the window, and nobody detects it.
  if (!frame.noise)
    schedule_.add(first + phy_.lock_window, ScheduledKind::kDetection, index);
  schedule_.add(first + frame.duration, ScheduledKind::kEnd, index);
}

// Does `step` for the receivers of a frame in turn, each at its own time, until something
// else comes first. True when all have been passed.
template <class LinkOf, class Step>
bool Channel::pass(Schedule::Event event, Time base, std::uint32_t OnAir::*next,
                   const LinkOf& link_of, const Step& step) {
  OnAir& on_air = on_air_[event.index];
  for (;;) {
    step(on_air, on_air.*next, event.time);
    const Link* following = link_of(on_air, ++(on_air.*next));
    if (!following) return true;
    event.time = base + following->delay;
    if (schedule_.has_before(event.time, event.order)) {
      schedule_.put_back(event);
      return false;
    }
  }
}

void Channel::handle(const Schedule::Event& event) {
  const auto all = [](const OnAir& on_air, std::uint32_t k) {
    return k < on_air.links.size() ? &on_air.links[k] : nullptr;
  };
  const FrameIndex index = event.index;
  const Time start = on_air_[index].start;
  switch (event.kind) {
    case ScheduledKind::kArrival:
      pass(event, start, &OnAir::next_arrival, all,
           [&](const OnAir& on_air, std::uint32_t k, Time now) {
             arrive(index, on_air.links[k], now);
           });
      return;
    case ScheduledKind::kDetection:
      pass(event, start + phy_.lock_window, &OnAir::next_detection, all,
           [&](const OnAir&, std::uint32_t k, Time now) { detect(index, k, now); });
      return;
    case ScheduledKind::kHeader:
      pass(
          event, start + phy_.preamble_header, &OnAir::next_header,
          [](const OnAir& on_air, std::uint32_t k) {
            return k < on_air.locked.size() ? &on_air.links[on_air.locked[k]] : nullptr;
          },
          [&](const OnAir& on_air, std::uint32_t k, Time now) {
            finish_header(index, on_air.links[on_air.locked[k]], now);
          });
      return;
    case ScheduledKind::kEnd:
      if (pass(event, start + on_air_[index].frame.duration, &OnAir::next_end, all,
               [&](const OnAir& on_air, std::uint32_t k, Time now) {
                 finish(index, on_air.links[k], now);
               }))
        free_.push_back(index);
      return;
    default:
      SKEIN_CHECK(false);
  }
}

void Channel::arrive(FrameIndex index, const Link& link, Time now) {
  Receiver& receiver = receivers_[link.to];
  const bool receives = receiver.locked != kNone;
  if (receives) judge(receiver, now);
  receiver.signals.push_back({index, link.power, now + on_air_[index].frame.duration});
  receiver.power += link.power;
  hear(receiver, now);
  if (receives || now < receiver.sending_until || on_air_[index].frame.noise)
    sense(link.to, now);
  else
    receiver.candidates.push_back({index, link.power});
}

void Channel::detect(FrameIndex index, std::uint32_t place, Time now) {
  OnAir& on_air = on_air_[index];
  const Link& link = on_air.links[place];
  Receiver& receiver = receivers_[link.to];
  auto& candidates = receiver.candidates;
  auto own = candidates.end(), strongest = candidates.begin();
  for (auto each = candidates.begin(); each != candidates.end(); ++each) {
    if (each->frame == index) own = each;
    if (each->power > strongest->power) strongest = each;
  }
  if (own == candidates.end()) return;  // it sends, or has detected another
  if (strongest != own) {
    candidates.erase(own);
    return;
  }
  const double others = receiver.signals.size() == 1 ? 0 : receiver.power - link.power;
  if (link.power < decode_threshold_ || link.power < lock_ratio_ * (noise_ + others)) {
    candidates.erase(own);
    sense(link.to, now);
    return;
  }
  candidates.clear();
  receiver.locked = index;
  receiver.locked_power = link.power;
  const Time arrival = on_air.start + link.delay;
  receiver.header_begin = arrival + preamble_;
  receiver.payload_begin = arrival + phy_.preamble_header;
  receiver.judged_until = now;
  receiver.least_ratio = std::numeric_limits<double>::infinity();
  receiver.log_header = receiver.log_payload = 0;
  if (on_air.next_header == on_air.locked.size())
    schedule_.add(receiver.payload_begin, ScheduledKind::kHeader, index);
  on_air.locked.push_back(place);
  listener_.on_busy(link.to, now, receiver.payload_begin);
}

void Channel::finish_header(FrameIndex index, const Link& link, Time now) {
  Receiver& receiver = receivers_[link.to];
  if (receiver.locked != index) return;  // it sends
  judge(receiver, now);
  if (is_lost(link.to, receiver.log_header)) {
    receiver.locked = kNone;
    sense(link.to, now);
    return;
  }
  const OnAir& on_air = on_air_[index];
  listener_.on_payload(link.to, now, on_air.start + on_air.frame.duration + link.delay);
}

void Channel::finish(FrameIndex index, const Link& link, Time now) {
  Receiver& receiver = receivers_[link.to];
  const bool was_locked = receiver.locked == index;
  if (receiver.locked != kNone) judge(receiver, now);
  for (Signal& signal : receiver.signals)
    if (signal.frame == index) {
      signal = receiver.signals.back();
      receiver.signals.pop_back();
      break;
    }
  receiver.power = receiver.signals.empty() ? 0 : receiver.power - link.power;
  hear(receiver, now);
  if (!was_locked) return;
  receiver.locked = kNone;
  if (is_lost(link.to, receiver.log_payload))
    listener_.on_payload_lost(link.to, now);
  else
    listener_.on_received(link.to, now, on_air_[index].frame,
                          {link.power, receiver.least_ratio});
  sense(link.to, now);
}

// Takes the time since the last change of interference into account.
void Channel::judge(Receiver& receiver, Time now) {
  const Time since = receiver.judged_until;
  receiver.judged_until = now;
  const double others =
      receiver.signals.size() == 1 ? 0 : receiver.power - receiver.locked_power;
  const double ratio = receiver.locked_power / (noise_ + std::max(0.0, others));
  receiver.least_ratio = std::min(receiver.least_ratio, ratio);
  const Time header_from = std::max(since, receiver.header_begin);
  const Time header_to = std::min(now, receiver.payload_begin);
  if (header_from < header_to)
    receiver.log_header +=
        errors_of_bits_->log_header_success(ratio, (header_to - header_from).seconds());
  const Time payload_from = std::max(since, receiver.payload_begin);
  if (payload_from < now)
    receiver.log_payload +=
        errors_of_bits_->log_payload_success(ratio, (now - payload_from).seconds());
}

// Keeps how long others are heard.
void Channel::hear(Receiver& receiver, Time now) const {
  const bool hears = receiver.power >= carrier_sense_threshold_;
  if (hears == receiver.hears) return;
  receiver.hears = hears;
  if (hears)
    receiver.receives_since = now;
  else
    receiver.heard += now - receiver.receives_since;
}

bool Channel::is_lost(NodeIndex node, double log_success) {
  if (log_success == 0) return false;
  const double success = math::exp(log_success);
  if (phy_.packet_error == PacketError::kHalf) return success <= 0.5;
  return errors_[node].uniform() >= success;
}

// Says until when the sum of the signals that are there now keeps the medium busy.
void Channel::sense(NodeIndex node, Time now) {
  const Receiver& receiver = receivers_[node];
  if (receiver.power < carrier_sense_threshold_) return;
  double left = receiver.power;
  Time until = now;
  // The next end after `until`, until what is left is too weak.
  while (left >= carrier_sense_threshold_) {
    Time next = Time::from_ns(INT64_MAX);
    double ending = 0;
    for (const Signal& signal : receiver.signals) {
      if (signal.end <= until) continue;
      if (signal.end < next) next = signal.end, ending = 0;
      if (signal.end == next) ending += signal.power;
    }
    if (ending == 0) break;
    left -= ending;
    until = next;
  }
  if (until > now) listener_.on_busy(node, now, until);
}

}  // namespace skein::communication
