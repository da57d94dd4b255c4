// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "skein/layer/autopilot/modes/mode_logic.h"

namespace skein::autopilot {

/// The same rules as ModeLogic once more, in the simplest form: counters of milliseconds
/// and tables, everything worked out anew at every step, no short cuts. Steps are
/// `step_ms` apart and all times of the options are whole milliseconds.
class ReferenceModel {
 public:
  struct Answer {
    FlightMode mode;
    Order order;
    ArmingState state;
    FailsafeTrigger trigger;
    FailsafeReaction reaction;
    std::array<bool, kFailsafes> raised;
  };

  ReferenceModel(const FailsafeOptions& options, AirframeKind airframe, long step_ms);

  Answer step(const ModeInput& in);

 private:
  struct Row {
    FailsafeRule rule;
    bool forever = false;
    long bad_ms = -1;     // for which the condition has held; -1: it does not
    long good_ms = 0;     // for which it has not
    long raised_ms = -1;  // -1: not raised
    int clears = 0;
  };
  enum Pilot { kAway, kFlies, kLost };
  enum Body { kStands, kLifts, kAirborne };

  void count(Row& row, bool silent, bool bad, bool released);
  int acting_row() const;
  FailsafeReaction setpoint(const Row& row) const;

  FailsafeOptions options_;
  AirframeKind airframe_;
  long step_ms_;
  std::array<Row, kFailsafes> rows_;
  Pilot pilot_ = kAway;
  Body body_ = kAirborne;
  long ground_ms_ = -1;  // on the ground for
  bool grounded_ = false;
  bool first_ = true;
  bool flown_ = false;
  bool home_lost_ = false;
  CommandKind mission_ = CommandKind::kNone;
  Order order_ = Order::kStand;
};

}  // namespace skein::autopilot
