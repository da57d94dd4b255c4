// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "skein/base/time.h"

namespace skein::autopilot_client {

/// Finds out that two senders speak with the number of one vehicle on one channel: a
/// second vehicle behind the same radio, or somebody who forges its telemetry.
///
/// Two counts: frames of one sender are numbered one after the other, so two numberings
/// that go on side by side are two senders. Two places: a vehicle is not here and, a
/// moment later, far away. What frames lose, overtake or delay looks like neither.
/// Two that count at the same rate, one less than 64 frames behind the other, are not
/// told apart by their counts.
///
/// Times are of one clock that never goes back.
class IdentityWatch {
 public:
  /// Takes in the number of a frame (Frame::sequence()) of the vehicle's autopilot.
  /// @returns  what was found, for people; said once while it lasts.
  std::optional<std::string> take_sequence(std::uint8_t sequence, Time now);

  /// Takes in where the vehicle says to be.
  /// @param latitude_e7, longitude_e7  [1e-7 deg]; 0, 0: unknown.
  /// @param boot  the vehicle's clock.
  /// @returns  what was found, for people, once while it lasts: jumps there and back.
  std::optional<std::string> take_position(std::int32_t latitude_e7,
                                           std::int32_t longitude_e7, Time boot,
                                           Time now);

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
  struct Where {
    std::int32_t latitude_e7 = 0, longitude_e7 = 0;
    Time boot, at;
  };

  void note_switch(Time now);

  std::optional<Count> present_, other_;  // numberings: of the last frame, and before
  int switches_ = 0;                      // between two that both go on
  bool switch_continued_ = false;         // the last one led to a numbering that went on
  Time first_switch_;
  std::optional<Where> where_;
  int jumps_ = 0;
  Time first_jump_;
  std::optional<Time> ambiguous_until_;
};

}  // namespace skein::autopilot_client
