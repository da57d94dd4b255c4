// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "skein/base/time.h"

namespace skein::communication {

/// What happens next in the medium.
enum class ScheduledKind : std::uint8_t {
  // Of a frame on the air; at each of its receivers, one after the other.
  kArrival,    ///< its first bit arrives
  kDetection,  ///< it is detected, or not
  kHeader,     ///< its header has been received, or not
  kEnd,        ///< its last bit has arrived
  // Of a station.
  kAccess,    ///< its back-off may be over
  kTimeout,   ///< no answer has come
  kResponse,  ///< SIFS after a frame that asks for an answer
  kSent,      ///< a frame without an answer has been sent
  kNavReset,  ///< nothing has followed an RTS of others
  // Of whoever sends.
  kOrder,   ///< a packet is handed to its radio
  kNoise,   ///< a node begins to send noise, of as many nanoseconds as the stamp says
  kExpiry,  ///< a packet of a node may be too old
};

/// Events in order of time; those of one moment in the order in which they were made.
class Schedule {
 public:
  struct Event {
    Time time;
    std::uint64_t order = 0;
    ScheduledKind kind = ScheduledKind::kAccess;
    std::uint32_t index = 0;  ///< of the frame on the air or the station
    std::uint32_t stamp = 0;  ///< tells an event that still counts from one that does not
  };

  bool empty() const { return heap_.empty(); }
  Time next_time() const { return heap_.front().time; }

  void add(Time time, ScheduledKind kind, std::uint32_t index, std::uint32_t stamp = 0) {
    put_back({time, next_order_++, kind, index, stamp});
  }

  /// An event that was taken and goes on later keeps its place among those of its moment.
  void put_back(const Event& event) {
    heap_.push_back(event);
    std::push_heap(heap_.begin(), heap_.end(), later);
  }

  Event take() {
    std::pop_heap(heap_.begin(), heap_.end(), later);
    const Event event = heap_.back();
    heap_.pop_back();
    return event;
  }

  /// Whether something stands before an event of this time and order.
  bool has_before(Time time, std::uint64_t order) const {
    if (heap_.empty()) return false;
    const Event& first = heap_.front();
    return first.time != time ? first.time < time : first.order < order;
  }

 private:
  static bool later(const Event& a, const Event& b) {
    return a.time != b.time ? a.time > b.time : a.order > b.order;
  }

  std::vector<Event> heap_;
  std::uint64_t next_order_ = 0;
};

}  // namespace skein::communication
