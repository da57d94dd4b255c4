// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/radio/message.h"
#include "skein/link/modem/datagram.h"

namespace skein::modem {

struct PacedQueueOptions {
  double rate = 0;             ///< that the modem can carry [bit/s]; 0: no limit
  std::size_t capacity = 100;  ///< datagrams that may wait
  Time lifetime = Time::from_seconds(5);  ///< of one that waits
};

/// What waits to go out by a modem.
struct Waiting {
  Address origin, to;
  Carried carried;
  Urgency urgency = Urgency::kReport;
  bool injected = false;       ///< for nobody: others are to feel its load
  std::vector<std::byte> key;  ///< of what is said, when and by whom
  Time since = {};
};

/// What became of datagrams that did not go out.
struct QueueLosses {
  std::uint64_t full = 0;     ///< no room, or it was needed for more urgent ones
  std::uint64_t expired = 0;  ///< waited too long
};

/// Datagrams wait for their turn: the most urgent first, those of equal urgency in order,
/// injected ones last. No more goes out than the modem carries:
///
///   next = max(next, now - 10 ms) + 8 bytes / rate
///
/// 10 ms being how exactly its user keeps to due(). In any time T at most
/// rate (T + 10 ms) bits and one datagram.
class PacedQueue {
 public:
  explicit PacedQueue(const PacedQueueOptions& options);

  /// Adds a datagram. One that says the same, from the same sender and moment, goes to
  /// the receivers of both. In a full queue those that have waited too long go first;
  /// then it takes the place of the youngest of those that are less urgent, if there are
  /// any.
  void put(Waiting waiting);

  /// When something may go out; it need not wait.
  Time due() const { return next_; }
  bool empty() const { return size() == 0; }
  std::size_t size() const;

  /// The next to go out; none: nothing waits, or it is too early.
  std::optional<Waiting> take(Time now);

  /// So much has gone out.
  void went(std::size_t bytes, Time now);

  const QueueLosses& losses() const { return losses_; }

 private:
  static constexpr std::size_t kRanks = 4;  // injected, then by urgency
  static std::size_t rank(const Waiting& waiting);
  bool merge(const Waiting& waiting);
  void drop_expired(Time now);
  bool make_room(std::size_t rank, Time now);

  PacedQueueOptions options_;
  std::array<std::deque<Waiting>, kRanks> ranks_;
  QueueLosses losses_;
  Time next_;
};

}  // namespace skein::modem
