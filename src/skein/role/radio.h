// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "skein/data/event/event.h"
#include "skein/data/radio/radio.h"

namespace skein {

/// What the radios of a run did since it was asked for last.
struct RadioStatistics {
  std::vector<RadioUse> radios;  ///< of each entity; empty: there is no medium
  std::vector<LinkUse> links;    ///< that were used, in the order of sender and receiver
};

/// What has become of messages, and what else happened on the air.
struct RadioNews {
  std::vector<MessageOutcome> ended;
  std::vector<Event> events;

  void clear() {
    ended.clear();
    events.clear();
  }
};

/// The radio medium between all entities.
class Radio {
 public:
  virtual ~Radio() = default;

  /// A message leaves its sender. Calls come in entity order.
  virtual void send(const Message& message) = 0;

  /// Whether it takes a message to kEveryone as it is; else each receiver has a copy.
  virtual bool carries_broadcasts() const { return false; }

  /// Appends the messages that have arrived by `now`, in order of arrival, ties in the
  /// order of sending; lost ones among them, when that is certain.
  virtual void deliver(Time now, RadioNews& news) = 0;

  /// Whether an entity takes part and its radio works, from now on; at first all do. One
  /// that is off sends, hears and passes on nothing.
  virtual void turn(EntityId /*id*/, bool /*on*/) {}

  /// The run is over: appends the messages that have neither arrived nor are lost, as
  /// LossCause::kPending. A radio that hands on what it gets has none.
  virtual void end(RadioNews& /*news*/) {}

  /// What the modem of an entity knows at the last `now`. Radios without a medium know of
  /// no load.
  virtual RadioStatus status(EntityId) const { return {}; }

  /// What happened since the last call, the last `now` being the end.
  virtual RadioStatistics take_statistics() { return {}; }
};

}  // namespace skein
