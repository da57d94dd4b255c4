// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/data/event/event_kind.h"

// The rows of the kinds of event, by subject. Others ask event_groups() and row_of().

namespace skein::event_tables {

inline constexpr bool kAnnounced = true;

/// Whether rows stand in the order of their kinds, none left out.
template <std::size_t N>
consteval bool in_order(const std::array<EventKindRow, N>& rows) {
  for (std::size_t k = 0; k < N; ++k)
    if (static_cast<std::size_t>(rows[k].kind) !=
        static_cast<std::size_t>(rows[0].kind) + k)
      return false;
  return true;
}

extern const EventGroup kFlight, kGuidance, kTask, kMission, kZone, kFire, kTeam,
    kProtocol, kTraffic, kRadio, kVehicle, kProgram, kMemory, kPlugin;

}  // namespace skein::event_tables
