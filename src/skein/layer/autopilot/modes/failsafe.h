// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "skein/base/time.h"
#include "skein/data/vehicle/airframe.h"
#include "skein/data/vehicle/autopilot.h"

namespace skein::autopilot {

/// What has gone wrong, least severe first: the most severe one decides what is done. The
/// battery stands at two places.
enum class Failsafe : std::uint8_t {
  kLink,
  kBatteryLow,
  kGeofence,
  kGnss,  ///< no position: no fix, or the estimator has lost itself
  kBatteryCritical,
  kMotor,
  kImu,  ///< nothing shows the attitude
};
inline constexpr std::size_t kFailsafes = 7;

constexpr FailsafeTrigger trigger_of(Failsafe failsafe) {
  constexpr std::array<FailsafeTrigger, kFailsafes> triggers = {
      FailsafeTrigger::kLink, FailsafeTrigger::kBattery, FailsafeTrigger::kGeofence,
      FailsafeTrigger::kGnss, FailsafeTrigger::kBattery, FailsafeTrigger::kMotor,
      FailsafeTrigger::kImu};
  return triggers[static_cast<std::size_t>(failsafe)];
}

/// A battery does not fill in the air, and a motor that stood once is not trusted again.
constexpr bool lasts(Failsafe failsafe) {
  return failsafe == Failsafe::kBatteryLow || failsafe == Failsafe::kBatteryCritical ||
         failsafe == Failsafe::kMotor;
}

/// What is done about one trigger.
struct FailsafeRule {
  double delay = 0;  ///< for which the condition must hold, or silence last [s]
  FailsafeReaction reaction = FailsafeReaction::kNone;
  /// After this long the second reaction replaces the first [s]; 0: never.
  double escalates_after = 0;
  FailsafeReaction escalates_to = FailsafeReaction::kNone;  ///< a stronger one
  /// When the condition is gone the mission goes on by itself; else it waits for a new
  /// command. Without meaning for battery and motor, which never clear.
  bool resumes = false;
};

struct FailsafeOptions {
  FailsafeRule link{5, FailsafeReaction::kReturn, 0, FailsafeReaction::kNone, true};
  /// Flies home and lands: one that waits above home until its battery is critical may
  /// have too little left to come down.
  FailsafeRule battery_low{3, FailsafeReaction::kLand};
  FailsafeRule battery_critical{3, FailsafeReaction::kLand};
  FailsafeRule geofence{0.2, FailsafeReaction::kReturn};
  FailsafeRule gnss{2, FailsafeReaction::kHold, 60, FailsafeReaction::kDescend, true};
  FailsafeRule motor{0, FailsafeReaction::kDescend};
  FailsafeRule imu{0, FailsafeReaction::kDescend, 0, FailsafeReaction::kNone, true};
  double battery_reserve = 0.15;      ///< low: charge less what it takes to get home
  double battery_critical_at = 0.08;  ///< critical: charge
  double recovery = 2;  ///< for which a condition must be gone before it clears [s]
  int max_clears = 5;   ///< of each trigger in one flight; after that it stays
  double pilot_silence = 0.5;  ///< after which the transmitter counts as silent [s]
  double ground_time = 0.5;    ///< on the ground for this long: landed [s]
};

/// What is wrong with the options, naming the field; none when they can be used.
std::optional<std::string> error_in(const FailsafeOptions& options);

enum class AirframeKind : std::uint8_t { kFixedWing, kMultirotor };

/// A plant that holds its own attitude counts as a fixed wing.
AirframeKind kind_of(const Airframe& airframe);

/// What the vehicle can still do.
struct Abilities {
  AirframeKind airframe = AirframeKind::kFixedWing;
  bool position = true;       ///< it knows where it is
  bool motors = true;         ///< all turn
  bool attitude = true;       ///< it knows which way is down
  bool home_in_reach = true;  ///< on the charge left
};

/// The reaction itself when it can be flown, else the closest one that can.
///
///   no attitude           hold, return, land -> descend (motors off, surfaces at trim)
///   a motor stands        hold, return, land -> descend (a fixed wing glides in circles)
///   no position           land -> descend;  return -> hold (fixed wing, by dead
///                         reckoning);  hold, return -> descend (multirotor, with level
///                         attitude)
///   home is out of reach  land -> descend
///
/// kNone and kDescend can always be done.
FailsafeReaction feasible(FailsafeReaction reaction, const Abilities& abilities);

}  // namespace skein::autopilot
