// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "skein/layer/autopilot/modes/mode_logic.h"

namespace skein::autopilot {

/// Steps mode logic at 100 Hz for tests, and keeps link, satellites and transmitter up
/// unless set otherwise.
class Cockpit {
 public:
  explicit Cockpit(bool on_ground = false, const FailsafeOptions& options = {},
                   AirframeKind airframe = AirframeKind::kFixedWing)
      : rules_(options, airframe), logic_(rules_) {
    in.on_ground = on_ground;
    step();
  }
  Cockpit(const Cockpit&) = delete;
  Cockpit& operator=(const Cockpit&) = delete;

  const Decision& step() {
    in.now += Time::from_ns(10'000'000);
    if (link) in.link_heard = in.now;
    if (gnss) in.gnss_fix = in.now;
    if (in.pilot && transmitter) in.pilot->time = in.now;
    const Decision& decision = logic_.step(in);
    in.command = CommandKind::kNone;
    return decision;
  }

  const Decision& run(double seconds) {
    for (long k = 0; k < std::lround(seconds * 100); ++k) step();
    return logic_.decision();
  }

  const Decision& command(CommandKind kind) {
    in.command = kind;
    return step();
  }

  const Decision& pilot(bool takes_over, FlightMode mode = FlightMode::kStabilized) {
    in.pilot = PilotInput{.time = in.now, .takes_over = takes_over, .mode = mode};
    return step();
  }

  const Decision& now() const { return logic_.decision(); }

  ModeInput in;
  bool link = true, gnss = true, transmitter = true;

 private:
  ModeRules rules_;
  ModeLogic logic_;
};

}  // namespace skein::autopilot
