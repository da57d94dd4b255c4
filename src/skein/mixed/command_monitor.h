// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>

#include "skein/base/time.h"
#include "skein/data/vehicle/setpoint.h"
#include "skein/data/vehicle/vehicle_report.h"

namespace skein::mixed {

/// Whether a vehicle in the air can be commanded: it says where it is, is in the mode
/// that it is led in, climbs when it takes off, and goes where its setpoints lead.
///
/// What fails for 15 s on end (a position that has jumped: 3 s) is the reason why it is
/// to be brought back; 30 s of a climb that stops, and of setpoints once it has obeyed
/// some: wind too keeps it from its place.
class CommandMonitor {
 public:
  struct Inputs {
    bool leads = false;       ///< it flies, its link is up, nobody else has it
    bool taking_off = false;  ///< else it is to be in the guided mode
    bool guided = false;      ///< it is
    bool position = false;    ///< it says where it is
    bool jumped = false;      ///< its position has, since it took off
    double position_age = 0;  ///< [s]
    std::string mode_name;
    double altitude_msl = 0;  ///< [m]
    double climbs_to = 0;     ///< the altitude of the take-off [m]
  };

  /// Once a step of the run.
  /// @returns  why it cannot be commanded, for people; empty: it can, or it is not known.
  std::string step(Time now, const Inputs& in);

  /// It was sent a setpoint while it moves so.
  void sent(Time now, const TrackSetpoint& setpoint, const VehicleMotion& motion);
  void sent(Time now, const BankSetpoint& setpoint, const VehicleMotion& motion);

  /// Another flight begins.
  void forget() { *this = {}; }

 private:
  // How long each has lasted.
  enum Reason : std::size_t { kPosition, kJump, kMode, kClimb, kReasons };
  bool lasts(Reason reason, bool fails, Time now, double limit);
  void follows(bool follows, Time now);

  std::array<std::optional<Time>, kReasons> since_;
  double highest_ = -1e9;  // of a climb [m]
  bool obeyed_ = false;    // setpoints, once
  double astray_ = 0;      // for so long it has not done what they say [s]
  Time judged_;            // last
};

}  // namespace skein::mixed
