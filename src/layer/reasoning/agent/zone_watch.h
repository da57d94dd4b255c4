#pragma once

#include <span>

#include "base/id.h"
#include "layer/reasoning/agent/zone_guard.h"
#include "role/agent.h"

namespace skein::reasoning {

/// Keeps what an agent commands out of no-flight zones, and tells when the aircraft turns
/// away from one or is inside.
class ZoneWatch {
 public:
  ZoneWatch(const ZoneGuardOptions& options, const FlightLimits& limits,
            std::span<const Zone> zones, EntityId self)
      : guard_(options, limits, zones), self_(self) {}

  /// See ZoneGuard::check.
  decltype(AutopilotCommand::guidance) keep_out(
      const decltype(AutopilotCommand::guidance)& wanted, double course,
      const NavEstimate& nav) {
    return guard_.check(wanted, course, nav);
  }

  /// Tells what has changed since the last call. Needs in.nav.
  void look(const AgentInput& in, AgentOutput& out);

 private:
  ZoneGuard guard_;
  EntityId self_;
  bool inside_ = false, deflects_ = false;
};

}  // namespace skein::reasoning
