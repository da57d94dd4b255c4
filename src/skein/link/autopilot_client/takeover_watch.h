// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "skein/data/vehicle/vehicle_request.h"

namespace skein::autopilot_client {

/// A set of modes, a bit each.
using ModeSet = std::uint32_t;
constexpr ModeSet mode_set(VehicleMode mode) {
  return ModeSet{1} << static_cast<unsigned>(mode);
}

/// Notices by a vehicle's heartbeats that somebody else chooses its mode while it is sent
/// requests: a pilot, another station, a failsafe of its own.
///
/// A change of mode is the sender's own where the command under way leads to that mode,
/// or one that ended up to three heartbeats ago. A take-off may end in holding by itself
/// (PX4).
/// Valid: a change that is undone before the next heartbeat is not seen.
class TakeoverWatch {
 public:
  /// The command under way leads to these modes.
  void lead_to(ModeSet modes) { modes_ = modes; }
  /// It is over; its modes may show a moment later.
  void end();

  /// Takes in a heartbeat.
  /// @param number  of the mode, as the vehicle's make counts them.
  /// @returns       whether it shows another mode than before that nothing here leads to.
  bool report(VehicleMode mode, std::uint32_t number);

 private:
  ModeSet modes_ = 0, ended_ = 0;
  int ended_kept_ = 0;                   // for so many heartbeats
  std::optional<std::uint32_t> number_;  // of the mode, last
  VehicleMode mode_ = VehicleMode::kOther;
};

}  // namespace skein::autopilot_client
