// SPDX-License-Identifier: Apache-2.0
#include "skein/link/vehicle_services/mode_table.h"
#include "skein/link/mavlink/flight_modes.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace skein::vehicle_services {
namespace {

using enum VehicleMode;
using mavlink::StandardMode;

constexpr std::array kPlaneModes = {
    ModeRow{kManual, 0, "MANUAL"},
    ModeRow{kStabilized, 5, "FBWA"},
    ModeRow{kStabilized, 2, "STABILIZE"},
    ModeRow{kHold, 12, "LOITER"},
    ModeRow{kGuided, 15, "GUIDED"},
    ModeRow{kMission, 10, "AUTO", true, StandardMode::kMission},
    ModeRow{kTakeOff, 13, "TAKEOFF", true, StandardMode::kTakeOff},
    ModeRow{kReturn, 11, "RTL", true, StandardMode::kReturn},
    // Of releases after the one that is claimed, which has no mode for it.
    ModeRow{kLand, 26, "AUTOLAND", true, StandardMode::kLand},
    ModeRow{kOther, 16, "INITIALISING", false},
};

// Its take-off is a part of guided flight.
constexpr std::array kCopterModes = {
    ModeRow{kManual, 1, "ACRO"},
    ModeRow{kStabilized, 0, "STABILIZE"},
    ModeRow{kHold, 5, "LOITER"},
    ModeRow{kHold, 17, "BRAKE"},
    ModeRow{kGuided, 4, "GUIDED"},
    ModeRow{kMission, 3, "AUTO", true, StandardMode::kMission},
    ModeRow{kReturn, 6, "RTL", true, StandardMode::kReturn},
    ModeRow{kLand, 9, "LAND", true, StandardMode::kLand},
    ModeRow{kTakeOff, 4, "GUIDED", false},
    ModeRow{kOther, 20, "GUIDED_NOGPS", false},
};

constexpr ModeRow kPx4Shared[] = {
    {kHold, kPx4Hold, "Hold"},
    {kGuided, kPx4Offboard, "Offboard"},
    {kMission, px4_mode(4, 4), "Mission", true, StandardMode::kMission},
    {kTakeOff, px4_mode(4, 2), "Takeoff", true, StandardMode::kTakeOff},
    {kReturn, px4_mode(4, 5), "Return", true, StandardMode::kReturn},
    {kLand, px4_mode(4, 6), "Land", true, StandardMode::kLand},
    {kGuided, kPx4Hold, "Hold", false},  // when it was sent to a place
    {kOther, px4_mode(3), "Position", false},
};

template <std::size_t N>
constexpr auto with_px4_shared(const std::array<ModeRow, N>& own) {
  std::array<ModeRow, N + std::size(kPx4Shared)> rows;
  std::ranges::copy(kPx4Shared, std::ranges::copy(own, rows.begin()).out);
  return rows;
}
constexpr auto kPx4PlaneModes = with_px4_shared(std::array{
    ModeRow{kManual, px4_mode(1), "Manual"},
    ModeRow{kStabilized, px4_mode(7), "Stabilized"},
});
constexpr auto kPx4CopterModes = with_px4_shared(std::array{
    ModeRow{kManual, px4_mode(5), "Acro"},
    ModeRow{kStabilized, px4_mode(7), "Stabilized"},
});

}  // namespace

std::span<const ModeRow> modes_of(Make make, bool hovers) {
  using Rows = std::span<const ModeRow>;
  if (make == Make::kPx4) return hovers ? Rows(kPx4CopterModes) : Rows(kPx4PlaneModes);
  return hovers ? Rows(kCopterModes) : Rows(kPlaneModes);
}

const ModeRow& row_of(VehicleMode mode, Make make, bool hovers) {
  const auto rows = modes_of(make, hovers);
  return *std::ranges::find(rows, mode, &ModeRow::mode);
}

const ModeRow* find_mode(std::uint32_t number, Make make, bool hovers) {
  const auto rows = modes_of(make, hovers);
  const auto row = std::ranges::find(rows, number, &ModeRow::number);
  return row == rows.end() ? nullptr : &*row;
}

const ModeRow& row_of_place(Make make, bool hovers) {
  if (make == Make::kArduPilot) return row_of(kGuided, make, hovers);
  const auto rows = modes_of(make, hovers);
  return *std::ranges::find_if(rows, [](const ModeRow& row) {
    return row.mode == kGuided && row.number == kPx4Hold;
  });
}

std::uint8_t mode_flags_of(VehicleMode mode) {
  using namespace mavlink;
  switch (mode) {
    case kManual:
      return kModeCustom | kModeManualInput;
    case kStabilized:
      return kModeCustom | kModeManualInput | kModeStabilized;
    case kGuided:
      return kModeCustom | kModeStabilized | kModeGuided;
    case kOther:
      return kModeCustom;
    default:
      return kModeCustom | kModeStabilized | kModeGuided | kModeAuto;
  }
}

}  // namespace skein::vehicle_services
