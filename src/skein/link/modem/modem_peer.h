// SPDX-License-Identifier: Apache-2.0
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
#include "skein/data/radio/message.h"
#include "skein/link/autopilot_client/clock_alignment.h"
#include "skein/link/modem/alerts.h"
#include "skein/link/modem/datagram.h"
#include "skein/link/modem/datagram_seal.h"
#include "skein/link/modem/duplicates.h"
#include "skein/link/modem/load_meter.h"
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
  std::size_t entities = 0;          ///< of the scenario
  std::optional<DatagramSeal> seal;  ///< none: datagrams are neither sealed nor judged
  bool overhears = false;            ///< takes in what is for other modems too
  Time advertisement_period = Time::from_seconds(1);  ///< 10 % earlier or later
  PacedQueueOptions queue;
};

/// What a modem did so far.
struct ModemStatistics {
  std::uint64_t sent = 0, sent_bytes = 0;    ///< datagrams that went out
  std::uint64_t injected = 0;                ///< of these: for nobody
  std::uint64_t heard = 0, heard_bytes = 0;  ///< that came in, each once
  /// That came again, were its own, or of a session of their modem that does not count.
  std::uint64_t duplicates = 0;
  std::uint64_t unknown = 0;      ///< no datagrams, or of somebody who takes no part
  std::uint64_t unauthentic = 0;  ///< without a valid seal, where one is wanted
  std::uint64_t clashes = 0;      ///< advertisements of another modem with its address
  std::uint64_t unreachable = 0;  ///< messages to somebody who is not heard
  std::uint64_t unsent = 0;       ///< datagrams that no line or socket took
  std::uint64_t too_long = 0;     ///< messages that no datagram has room for
  QueueLosses dropped;            ///< instead of being sent
  std::uint64_t damaged = 0;      ///< frames on a line or connection
  std::uint64_t put_full = 0;     ///< messages handed over faster than they are taken
  std::uint64_t take_full = 0;    ///< messages that came, and nobody took in time
  std::size_t waiting = 0;
  Time delay_sum, delay_most;  ///< in the queue, of what was sent from it
  std::uint64_t delayed = 0;   ///< how many that were
  double load = 0;             ///< of the air, as LoadMeter has it

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
/// by the modem never goes out by it again. Others are addressed by the modem through
/// which they are heard; those behind this one need no address of it.
///
/// With a seal nobody without the key makes up or alters a datagram, and none counts
/// twice. One that was never heard counts when somebody brings it later, until its modem
/// begins another session. Without a seal a modem that goes on counts, not who takes its
/// address.
///
/// Clocks are aligned by the fastest datagram of each modem: times that come are late by
/// the time that this one took.
class ModemPeer {
 public:
  /// Sends bytes; whether anything took them.
  using Send = std::function<bool(std::span<const std::byte>)>;

  explicit ModemPeer(ModemPeerOptions options);

  /// A message of somebody behind this modem to somebody on the other side, or to
  /// kEveryone. It waits for its turn; to somebody who is not heard it is dropped. What
  /// is not of somebody behind it is not sent.
  /// @param message  times are of this end's clock
  void send(const Message& message, Time now);

  /// A message between two behind this modem, of which the others are to feel the load.
  void inject(const Message& message, Time now);

  /// Something came; appends the message in it if there is one for somebody behind this
  /// modem, or for anybody where it overhears. `to` is the receiver, of several each in a
  /// message of its own; of a message to all it is kEveryone where several are behind it.
  void receive(std::span<const std::byte> bytes, Time now, std::vector<Message>& out);

  /// Sends what may go out now.
  void step(Time now, const Send& send);

  /// When step() has something to do, if nothing happens before.
  Time next() const;

  /// Who was found and lost since the last call.
  std::vector<NeighbourChange> take_changes();

  /// What else was found, of each kind at most once a minute.
  std::vector<Alert> take_alerts() { return alerts_.take(); }

  /// Whether somebody on the other side is heard.
  bool hears(EntityId other) const { return neighbours_.find(other).has_value(); }

  ModemStatistics statistics(Time now) const;

 private:
  struct Clock {
    std::uint64_t session = 0;
    autopilot_client::ClockAlignment alignment;
  };

  EntityId own() const { return options_.identities.front(); }
  bool is_here(EntityId who) const {
    return who.value < here_.size() && here_[who.value];
  }
  std::optional<Datagram> open(std::span<const std::byte> bytes, Time now);
  bool is_of_team(const Datagram& datagram) const;
  bool is_for_us(const Datagram& datagram, const Carried& carried) const;
  std::optional<Address> address_of(const Message& message) const;
  void hear_own_address(const Datagram& datagram, Time now);
  void advertise(Time now, const Send& send);
  void note(const std::vector<NeighbourChange>& changes);
  void take(const Datagram& datagram, const Advertisement& said, Time now);
  void take(const Datagram& datagram, const Carried& said, Time now,
            std::vector<Message>& out);
  bool put_out(Datagram datagram, Time now, const Send& send);
  Time shift_of(const Datagram& datagram, Time now);

  ModemPeerOptions options_;
  std::vector<bool> here_;  // by identity
  NeighbourTable neighbours_;
  Duplicates duplicates_;
  PacedQueue queue_;
  LoadMeter load_;
  RandomStream jitter_;
  std::map<std::uint32_t, Clock> clocks_;  // of modems
  Time next_advertisement_;
  std::uint64_t datagrams_ = 0;
  std::vector<NeighbourChange> changes_;
  AlertLog alerts_;
  ModemStatistics statistics_;
  std::vector<std::byte> coded_;  // used again for each datagram
};

}  // namespace skein::modem
