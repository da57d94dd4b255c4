// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "skein/base/outages.h"
#include "skein/base/random.h"
#include "skein/role/radio.h"

namespace skein::communication {

struct IdealRadioOptions {
  double delay = 0;   ///< from sending to arrival [s]
  double jitter = 0;  ///< further delay, uniform between 0 and this [s]
  double loss = 0;    ///< probability that a message is lost
  double range = 0;   ///< messages that go further are lost [m]; 0 = no limit
  /// Times at which an entity's modem neither sends nor receives; each has its own.
  double outages_per_hour = 0;
  double outage_mean = 20;  ///< mean length [s], exponentially distributed
};

/// Where an entity is now [m]; nothing when it has no position.
using PositionLookup = std::function<std::optional<Vec3>(EntityId)>;

/// A radio without a medium: every message arrives after its delay or is lost by chance,
/// by distance, or because one of the two modems is out when it is sent.
///
/// The random numbers of a message are addressed by (seed, sender, its number), and those
/// of outages by (seed, entity), so what happens to it depends on no other message. With
/// jitter, messages may overtake each other.
class IdealRadio final : public Radio {
 public:
  /// @param position  needed with a range only; asked when a message is sent.
  /// Entities without a position send and receive everywhere.
  IdealRadio(const IdealRadioOptions& options, std::uint64_t seed,
             PositionLookup position = {});

  void send(const Message& message) override;
  void deliver(Time now, RadioNews& news) override;
  void end(RadioNews& news) override;

 private:
  struct InFlight {
    Time arrival;
    std::uint64_t order;  // of sending
    LossCause cause;
    Message message;
  };
  static bool later(const InFlight& a, const InFlight& b);
  std::optional<InFlight> take_first(Time until);
  bool out_of_range(const Message& message) const;
  bool is_out(EntityId modem, Time now);
  LossCause cause_of(const Message& message, bool by_chance);

  IdealRadioOptions options_;
  std::uint64_t seed_;
  PositionLookup position_;
  std::uint64_t sent_ = 0;
  std::map<EntityId, Outages> outages_;  // of those that have sent or received
  // Most arrive after all that were sent before: these are a queue; the others are a
  // heap, earliest first.
  std::deque<InFlight> in_order_;
  std::vector<InFlight> overtaking_;
};

}  // namespace skein::communication
