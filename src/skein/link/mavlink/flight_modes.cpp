// SPDX-License-Identifier: Apache-2.0
#include "skein/link/mavlink/flight_modes.h"

#include <fmt/format.h>

#include <span>
#include <string_view>

namespace skein::mavlink {
namespace {

struct ModeRow {
  std::uint32_t number;
  std::string_view name;
  VehicleMode mode;
};

// Where several numbers are one mode, the first is what is asked for.
constexpr ModeRow kPlaneModes[] = {
    {0, "MANUAL", VehicleMode::kManual},        {5, "FBWA", VehicleMode::kStabilized},
    {2, "STABILIZE", VehicleMode::kStabilized}, {3, "TRAINING", VehicleMode::kStabilized},
    {4, "ACRO", VehicleMode::kManual},          {6, "FBWB", VehicleMode::kStabilized},
    {7, "CRUISE", VehicleMode::kStabilized},    {8, "AUTOTUNE", VehicleMode::kStabilized},
    {10, "AUTO", VehicleMode::kMission},        {11, "RTL", VehicleMode::kReturn},
    {12, "LOITER", VehicleMode::kHold},         {1, "CIRCLE", VehicleMode::kHold},
    {13, "TAKEOFF", VehicleMode::kTakeOff},     {14, "AVOID_ADSB", VehicleMode::kOther},
    {15, "GUIDED", VehicleMode::kGuided},       {16, "INITIALISING", VehicleMode::kOther},
    {24, "THERMAL", VehicleMode::kOther},
};
constexpr ModeRow kCopterModes[] = {
    {0, "STABILIZE", VehicleMode::kStabilized}, {1, "ACRO", VehicleMode::kManual},
    {2, "ALT_HOLD", VehicleMode::kStabilized},  {3, "AUTO", VehicleMode::kMission},
    {4, "GUIDED", VehicleMode::kGuided},        {5, "LOITER", VehicleMode::kHold},
    {6, "RTL", VehicleMode::kReturn},           {21, "SMART_RTL", VehicleMode::kReturn},
    {7, "CIRCLE", VehicleMode::kHold},          {9, "LAND", VehicleMode::kLand},
    {11, "DRIFT", VehicleMode::kStabilized},    {13, "SPORT", VehicleMode::kStabilized},
    {16, "POSHOLD", VehicleMode::kStabilized},  {17, "BRAKE", VehicleMode::kHold},
    {19, "AVOID_ADSB", VehicleMode::kOther},
};

// The main mode in bits 16 to 23, of AUTO the sub-mode above it.
constexpr std::uint32_t px4(std::uint32_t main, std::uint32_t sub = 0) {
  return main << 16 | sub << 24;
}
constexpr ModeRow kPx4Modes[] = {
    {px4(1), "MANUAL", VehicleMode::kManual},
    {px4(7), "STABILIZED", VehicleMode::kStabilized},
    {px4(2), "ALTCTL", VehicleMode::kStabilized},
    {px4(3), "POSCTL", VehicleMode::kStabilized},
    {px4(5), "ACRO", VehicleMode::kManual},
    {px4(6), "OFFBOARD", VehicleMode::kGuided},
    {px4(4, 3), "AUTO.LOITER", VehicleMode::kHold},
    {px4(4, 1), "AUTO.READY", VehicleMode::kHold},
    {px4(4, 2), "AUTO.TAKEOFF", VehicleMode::kTakeOff},
    {px4(4, 4), "AUTO.MISSION", VehicleMode::kMission},
    {px4(4, 5), "AUTO.RTL", VehicleMode::kReturn},
    {px4(4, 6), "AUTO.LAND", VehicleMode::kLand},
};

std::span<const ModeRow> rows_of(Make make, bool hovers) {
  switch (make) {
    case Make::kArduPilot:
      return hovers ? std::span<const ModeRow>(kCopterModes)
                    : std::span<const ModeRow>(kPlaneModes);
    case Make::kPx4:
      return kPx4Modes;
    case Make::kOther:
      return {};
  }
  return {};
}

const ModeRow* find_row(Make make, bool hovers, std::uint32_t number) {
  for (const ModeRow& row : rows_of(make, hovers))
    if (row.number == number) return &row;
  return nullptr;
}

}  // namespace

VehicleMode mode_of(Make make, bool hovers, std::uint32_t custom_mode) {
  const ModeRow* row = find_row(make, hovers, custom_mode);
  return row ? row->mode : VehicleMode::kOther;
}

std::string mode_name(Make make, bool hovers, std::uint32_t custom_mode) {
  const ModeRow* row = find_row(make, hovers, custom_mode);
  return row ? std::string(row->name) : fmt::format("mode {}", custom_mode);
}

std::optional<std::uint32_t> custom_mode_of(Make make, bool hovers, VehicleMode mode) {
  for (const ModeRow& row : rows_of(make, hovers))
    if (row.mode == mode && mode != VehicleMode::kOther) return row.number;
  return std::nullopt;
}

}  // namespace skein::mavlink
