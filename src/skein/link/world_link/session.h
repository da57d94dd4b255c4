// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/link/autopilot_client/clock_alignment.h"
#include "skein/link/world_link/packet.h"

namespace skein::world_link {

struct SessionOptions {
  std::uint64_t id = 1;  ///< larger than that of its last; from the time of the start
  Hello hello;
  Time silence = Time::from_seconds(2);       ///< after which the other side is lost
  Time keep_alive = Time::from_seconds(0.2);  ///< between packets, at most
  Time lifetime = Time::from_seconds(10);     ///< of a parcel that is not delivered
  std::size_t max_parcels = 1000;             ///< that wait; then the oldest goes
  std::size_t max_bytes = std::size_t{1} << 20;
};

/// What happened to a session.
struct SessionChange {
  enum class Kind : std::uint8_t {
    kUp,         ///< both sides hear each other, at first or again
    kDown,       ///< nothing heard for too long, or the other side has said bye
    kRestarted,  ///< the other side has begun anew
    kRefused,    ///< the other side wants no session
  };
  Kind kind = Kind::kUp;
  std::string text;  ///< for people
};

/// A value that came.
struct Delivery {
  std::span<const std::uint8_t> coded;
  Time shift;  ///< from the sender's clock to this one
};

/// One end of a link between a world and an agent; both ends are alike. Without input or
/// output of its own: packets and times come as arguments.
///
/// Parcels are sent again until they are acknowledged or too old, and come once and in
/// order; of what is shown only the newest comes, or nothing. Of two sessions of the
/// other side the one that began later counts, or the one that is still there. Parcels
/// that wait when the other side begins anew are for the new one.
///
/// Holds a bounded number of bytes, whatever comes.
class Session {
 public:
  using Send = std::function<void(const Packet&)>;
  using Deliver = std::function<void(const Delivery&)>;

  explicit Session(SessionOptions options) : options_(std::move(options)) {}

  /// A value that is sent until it is acknowledged.
  /// @returns  false: it is larger than kMaxValue.
  bool post(const std::vector<std::byte>& coded, Time now);

  /// A value that goes out with the next packet; nothing while the other side is lost.
  void show(const std::vector<std::byte>& coded);

  /// A packet came. Calls `deliver` for each value in it that is new.
  void receive(const Packet& packet, Time now, const Deliver& deliver);

  /// Sends what is due.
  void step(Time now, const Send& send);

  /// Ends the session, for those who have heard of it.
  void say_bye(Time now, const std::string& why, const Send& send);

  /// Both sides hear each other.
  bool up() const { return up_; }
  std::uint64_t id() const { return options_.id; }
  /// The session of the other side; 0: none yet.
  std::uint64_t peer() const { return peer_; }
  /// Whether a packet of this session of the other side would be taken.
  bool admits(std::uint64_t session, Time now) const;

  /// Since the last call.
  std::vector<SessionChange> take_changes();

  std::size_t waiting() const { return parcels_.size(); }
  std::uint64_t dropped() const { return dropped_; }
  double round_trip() const { return alignment_.shortest_round_trip(); }

 private:
  struct Waiting {
    std::vector<std::uint8_t> coded;
    Time posted;
    std::optional<Time> sent;
    bool acknowledged = false;
  };

  bool meet(const Packet& packet, Time now);
  void hear_acknowledgements(const Packet& packet);
  void hear_parcels(const Packet& packet, const Deliver& deliver, Time shift);
  void expire(Time now);
  bool due(const Waiting& parcel, Time now) const;
  bool parcel_due(Time now) const;
  Packet next_packet(Time now);
  void fill(Packet& packet, Time now);
  void drop_oldest();
  void change(SessionChange::Kind kind, std::string text);

  SessionOptions options_;
  std::vector<SessionChange> changes_;
  // The other side.
  std::uint64_t peer_ = 0, ended_ = 0;
  Hello peer_hello_;
  std::string refusal_;  // reported
  Time heard_;           // its last packet
  Time answered_;        // its last packet that knows of this session
  bool knows_us_ = false, up_ = false, greets_ = false;
  std::uint64_t newest_ = 0;  // number of its newest packet
  Time newest_sent_;          // of that, by its clock
  Time newest_heard_;
  autopilot_client::ClockAlignment alignment_;
  // What comes.
  std::uint64_t expected_ = 1;
  std::map<std::uint64_t, std::vector<std::uint8_t>> early_;
  // What goes.
  std::deque<Waiting> parcels_;  // the first has number first_
  std::uint64_t first_ = 1, packets_ = 0, dropped_ = 0;
  std::size_t bytes_ = 0;
  std::vector<std::vector<std::uint8_t>> shown_;
  bool answer_due_ = false;
  std::optional<Time> last_sent_;
};

}  // namespace skein::world_link
