#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "skein/base/id.h"
#include "skein/base/random.h"
#include "skein/base/time.h"
#include "skein/data/message.h"
#include "skein/link/autopilot_client/clock_alignment.h"
#include "skein/link/modem/datagram.h"
#include "skein/link/modem/duplicates.h"
#include "skein/link/modem/gateway.h"
#include "skein/link/modem/neighbour_table.h"
#include "skein/link/modem/paced_queue.h"

namespace skein::modem {

struct ModemPeerOptions {
  std::uint32_t hw = 1;  ///< of this modem
  std::uint64_t session =
      1;  ///< larger than that of its last; from the time of the start
  std::uint32_t scenario = 0;  ///< fingerprint of what all must have in common
  /// Who is reached through it; the first is whose modem it is: for the others it is the
  /// gateway.
  std::vector<EntityId> identities;
  std::size_t entities = 0;  ///< of the scenario
  GatewayMethod method = GatewayMethod::kFixed;
  bool overhears = false;  ///< takes in what is for other modems too
  Time advertisement_period = Time::from_seconds(1);  ///< 10 % earlier or later
  PacedQueueOptions queue;
};

/// What a modem did so far.
struct ModemStatistics {
  std::uint64_t sent = 0, sent_bytes = 0;    ///< datagrams that went out
  std::uint64_t injected = 0;                ///< of these: for nobody
  std::uint64_t heard = 0, heard_bytes = 0;  ///< that came in, each once
  std::uint64_t duplicates = 0;              ///< came again, or were its own
  std::uint64_t unknown = 0;      ///< no datagrams, or of somebody who takes no part
  std::uint64_t unreachable = 0;  ///< messages to somebody who is not heard
  QueueLosses dropped;            ///< instead of being sent
  std::size_t waiting = 0;
  Time delay_sum, delay_most;  ///< in the queue, of what was sent from it
  std::uint64_t delayed = 0;   ///< how many that were

  /// Mean time in the queue [s].
  double mean_delay() const {
    return delayed > 0 ? delay_sum.seconds() / static_cast<double>(delayed) : 0;
  }
};

/// One end of a radio modem: the ground station's, which is the gateway of all that is
/// simulated, or a real entity's. Without input or output of its own: bytes and times
/// come as arguments.
///
/// It says every second who is reached through it, knows by the same word of others who
/// is there, and takes each datagram once. Messages are of those behind it: what came in
/// by the modem never goes out by it again.
///
/// Clocks are aligned by the fastest datagram of each modem: times that come are late by
/// the time that this one took.
class ModemPeer {
 public:
  using Send = std::function<void(std::span<const std::byte>)>;

  explicit ModemPeer(ModemPeerOptions options);

  /// A message of somebody behind this modem to somebody on the other side, or to
  /// kEveryone. It waits for its turn; to somebody who is not heard it is dropped. What
  /// is not of somebody behind it is not sent.
  /// @param message  times are of this end's clock
  void send(const Message& message, Time now);

  /// A message between two behind this modem, of which the others are to feel the load.
  void inject(const Message& message, Time now);

  /// Something came; appends the message in it if there is one for somebody behind this
  /// modem, or for anybody where it overhears. `to` is the receiver; of a message to all
  /// it is kEveryone where there are several behind it.
  void receive(std::span<const std::byte> bytes, Time now, std::vector<Message>& out);

  /// Sends what may go out now.
  void step(Time now, const Send& send);

  /// When step() has something to do, if nothing happens before.
  Time next() const;

  /// Who was found and lost since the last call.
  std::vector<NeighbourChange> take_changes();

  /// Whether somebody on the other side is heard.
  bool hears(EntityId other) const { return neighbours_.find(other).has_value(); }

  ModemStatistics statistics() const;

 private:
  struct Clock {
    std::uint64_t session = 0;
    autopilot_client::ClockAlignment alignment;
  };

  EntityId own() const { return options_.identities.front(); }
  bool is_here(EntityId who) const {
    return who.value < here_.size() && here_[who.value];
  }
  bool is_for_us(const Datagram& datagram, const Carried& carried) const;
  std::optional<Address> address_of(const Message& message) const;
  void note(const std::vector<NeighbourChange>& changes);
  void take(const Datagram& datagram, const Advertisement& said, Time now);
  void take(const Datagram& datagram, const Carried& said, Time now,
            std::vector<Message>& out);
  std::size_t put_out(Datagram datagram, Time now, const Send& send);
  Time shift_of(const Datagram& datagram, Time now);

  ModemPeerOptions options_;
  std::vector<bool> here_;  // by identity
  NeighbourTable neighbours_;
  Gateway gateway_;
  Duplicates duplicates_;
  PacedQueue queue_;
  RandomStream jitter_;
  std::map<std::uint32_t, Clock> clocks_;  // of modems
  Time next_advertisement_;
  std::uint64_t datagrams_ = 0;
  std::vector<NeighbourChange> changes_;
  ModemStatistics statistics_;
  std::vector<std::byte> coded_;  // used again for each datagram
};

}  // namespace skein::modem
