#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "skein/base/random.h"
#include "skein/role/radio.h"

namespace skein::communication {

struct IdealRadioOptions {
  double delay = 0;   ///< from sending to arrival [s]
  double jitter = 0;  ///< further delay, uniform between 0 and this [s]
  double loss = 0;    ///< probability that a message is lost
  double range = 0;   ///< messages that go further are lost [m]; 0 = no limit
};

/// Where an entity is now [m]; nothing when it has no position.
using PositionLookup = std::function<std::optional<Vec3>(EntityId)>;

/// A radio without a medium: every message arrives after its delay or is lost by chance.
///
/// The random numbers of a message are addressed by (seed, sender, its number), so what
/// happens to it depends on no other message. With jitter, messages may overtake each
/// other.
class IdealRadio final : public Radio {
 public:
  /// @param position  needed with a range only; asked when a message is sent.
  /// Entities without a position send and receive everywhere.
  IdealRadio(const IdealRadioOptions& options, std::uint64_t seed,
             PositionLookup position = {});

  void send(const Message& message) override;
  void deliver(Time now, std::vector<Message>& arrived,
               std::vector<Message>& lost) override;

 private:
  struct InFlight {
    Time arrival;
    std::uint64_t order;  // of sending
    bool lost;
    Message message;
  };
  static bool later(const InFlight& a, const InFlight& b);
  bool out_of_range(const Message& message) const;

  IdealRadioOptions options_;
  std::uint64_t seed_;
  PositionLookup position_;
  std::uint64_t sent_ = 0;
  std::vector<InFlight> in_flight_;  // a heap, earliest first
};

}  // namespace skein::communication
