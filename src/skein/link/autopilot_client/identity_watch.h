// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "skein/base/time.h"

namespace skein::autopilot_client {

/// Where a vehicle says to be, and when.
struct ReportedPlace {
  std::int32_t latitude_e7 = 0, longitude_e7 = 0;  ///< [1e-7 deg]; 0, 0: unknown
  double speed = 0;                                ///< over ground [m/s]
  Time boot;                                       ///< the vehicle's clock
};

/// What a vehicle's heartbeat says of what it is.
struct ReportedKind {
  std::uint8_t type = 0, autopilot = 0;  ///< MAV_TYPE, MAV_AUTOPILOT
  bool operator==(const ReportedKind&) const = default;
};

/// Finds out that two senders speak with the number of one vehicle on one channel: a
/// second vehicle behind the same radio, or somebody who forges its telemetry. What they
/// report is looked at for what one vehicle does not do:
///
///   counts    frames of one sender are numbered one after the other; two numberings that
///             go on side by side are two senders
///   places    a vehicle is not here and, a moment later, far away and back; nor does it
///             fly on two tracks at once, more than 20 m apart
///   kinds     its type and make of autopilot do not change to and fro
///   hardware  nor do the numbers of its board (AUTOPILOT_VERSION)
///
/// What frames lose, overtake, repeat or delay looks like none of these, nor does one
/// vehicle of which a router sends all frames twice, nor one that begins again.
/// Valid: two that count at the same rate, one less than 64 frames behind the other, are
///        not told apart by their counts, nor by tracks with less than three places a
///        second of both together; two that fly within 20 m, are of one kind and report
///        no numbers of their boards are not told apart at all.
///
/// Times are of one clock that never goes back.
class IdentityWatch {
 public:
  /// Takes in the number of a frame (Frame::sequence()) of the vehicle's autopilot.
  /// @returns  what was found, for people; said once while it lasts.
  std::optional<std::string> take_sequence(std::uint8_t sequence, Time now);

  /// Takes in where the vehicle says to be.
  /// @returns  what was found, for people, once while it lasts: jumps there and back, two
  ///           tracks.
  std::optional<std::string> take_place(const ReportedPlace& place, Time now);

  /// Takes in a heartbeat.
  std::optional<std::string> take_kind(const ReportedKind& kind, Time now);

  /// Takes in a number made of what the vehicle's board says of itself; 0: nothing.
  std::optional<std::string> take_hardware(std::uint64_t number, Time now);

  /// What somebody with the number of the vehicle reports on another channel: the same
  /// vehicle by another link, or another vehicle. Links differ by seconds at most.
  /// @returns  how it differs from this one, for people; empty: it may be this one.
  std::string difference(const ReportedKind& kind) const;
  std::string difference(const ReportedPlace& place, Time now);

  /// Two have spoken in turn within the last seconds: whatever they report, nobody can
  /// tell whose it is.
  bool is_ambiguous(Time now) const {
    return ambiguous_until_ && now < *ambiguous_until_;
  }

  /// Another session begins: the link was down, or the vehicle has rebooted.
  void forget();

 private:
  struct Count {
    std::uint8_t last = 0;
    Time at;
  };
  struct Where : ReportedPlace {
    Time at;
  };
  // A value that goes to and fro.
  struct Alternation {
    std::optional<std::uint64_t> last;
    int switches = 0;
    Time first;
    bool take(std::uint64_t value, Time window, Time now);
  };

  // Between two that both go on.
  struct Switches {
    int count = 0;
    Time first;
    int add(Time now);
  };

  bool note_jump(const Where& before, const Where& place, double moved);
  bool note_track(const Where& place);
  // Says it, unless it has been said.
  std::optional<std::string> found(std::string what, Time now, Time lasts);

  std::optional<Count> present_, other_;  // numberings: of the last frame, and before
  Switches switches_;
  bool switch_continued_ = false;  // the last one led to a numbering that went on
  std::optional<Where> where_;
  int jumps_ = 0;
  Time first_jump_;
  std::optional<Where> track_, other_track_;  // of the last place, and before
  Switches track_switches_;
  bool track_continued_ = false;
  std::array<Time, 32> boots_ = {};  // of places of late
  std::size_t next_boot_ = 0;
  Alternation kinds_, hardware_;
  std::optional<Time> differs_since_;  // of another channel, without a break
  std::optional<Time> ambiguous_until_;
};

}  // namespace skein::autopilot_client
