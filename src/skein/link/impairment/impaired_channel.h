// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "skein/base/outages.h"
#include "skein/base/random.h"
#include "skein/base/time.h"
#include "skein/link/impairment/channel_counts.h"
#include "skein/link/impairment/impairment.h"

namespace skein::impairment {

enum class Traffic : std::uint8_t {
  kPackets,  ///< datagrams: all impairments apply
  kBytes,    ///< a stream: nothing is lost, doubled or reordered; bytes wait instead
};

/// One direction of a bad connection, without sockets and clocks: what comes in when, and
/// from that what goes out when. The same seed, arrivals and changes give the same
/// result.
///
/// A packet waits in the queue, is transmitted at the rate, and arrives after its delay.
/// Packets that come in during an outage are lost; nothing is transmitted meanwhile, and
/// what is under way arrives. A packet that finds the queue empty is taken whatever its
/// size. A new rate counts for the packet that is being transmitted too. What is under
/// way keeps its delay; when the delay becomes shorter, later packets may overtake it.
///
/// Holds at most kMaxBytes and kMaxPackets, waiting and under way together; more is lost
/// as by a full queue. Does not allocate once it has held as much before.
///
/// Times of calls never go back.
class ImpairedChannel {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{16} << 20;
  static constexpr std::size_t kMaxPackets = 65'536;

  /// @param chance  for delays and losses.
  /// @param outages  of the plan.
  ImpairedChannel(Traffic traffic, const Impairment& impairment,
                  const RandomStream& chance, const Outages& outages);

  /// Another impairment counts from now on.
  void set(const Impairment& impairment, Time now);

  /// An outage from now on until then, besides all others; `until` = now ends it.
  void cut(Time now, Time until);

  /// Something comes in. Of kBytes no more than room().
  void put(std::span<const std::byte> bytes, Time now);

  /// When to call take() again; none: only after the next change or packet.
  std::optional<Time> next() const;

  /// What goes out by now: a packet or piece; valid until the next call. Call it until
  /// there is none.
  std::optional<std::span<const std::byte>> take(Time now);

  /// Bytes that put() may bring without any being lost.
  std::size_t room() const;

  /// Nothing waits and nothing is under way.
  bool empty() const { return waiting_.packets == 0 && under_way_.empty(); }

  const ChannelCounts& counts() const { return counts_; }
  /// That wait for transmission.
  std::size_t waiting_packets() const { return waiting_.packets; }
  std::size_t waiting_bytes() const { return waiting_.bytes; }
  /// That are transmitted and have not arrived.
  std::size_t under_way() const { return under_way_.size(); }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  struct Slot {
    Time came;
    std::vector<std::byte> bytes;
    std::uint32_t next = kNone;  // in the queue
  };
  struct Queue {
    std::uint32_t first = kNone, last = kNone;
    std::size_t packets = 0, bytes = 0;
  };
  struct Flight {
    Time arrival;
    std::uint64_t order;
    std::uint32_t slot;
  };
  static bool later(const Flight& a, const Flight& b);

  void advance(Time now);
  std::optional<Time> outage_end(Time now);
  Time transmission_end() const;
  bool holds_enough(std::size_t bytes) const;
  bool is_full(std::size_t bytes) const;
  std::uint32_t hold(std::span<const std::byte> bytes, Time came);
  void free(std::uint32_t slot);
  void enqueue(std::uint32_t slot);
  std::uint32_t dequeue();
  void launch(std::uint32_t slot, Time sent);
  void fly(std::uint32_t slot, Time sent);
  Time draw_delay();

  Traffic traffic_;
  Impairment impairment_;
  RandomStream chance_;
  Outages outages_;
  Time cut_until_;
  ChannelCounts counts_;

  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_;
  std::uint32_t taken_ = kNone;
  std::size_t held_bytes_ = 0;

  // The transmitter.
  Queue waiting_;
  bool sending_ = false;  // the first of the queue
  Time sent_from_;        // since when, at the rate in force
  double bits_left_ = 0;  // at that moment
  Time idle_from_;        // it has nothing to send
  Time blocked_until_;    // by an outage

  // Under way: a heap, the next arrival first.
  std::vector<Flight> under_way_;
  Time last_arrival_;  // which those that keep their order do not pass
  std::uint64_t launched_ = 0;
  std::uint64_t highest_out_ = 0;  // order of the last one that arrived in order
};

}  // namespace skein::impairment
