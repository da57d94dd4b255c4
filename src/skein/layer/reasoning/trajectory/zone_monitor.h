// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/base/id.h"
#include "skein/data/airspace/zone_set.h"
#include "skein/data/vehicle/agent_step.h"
#include "skein/layer/reasoning/trajectory/detour_planner.h"
#include "skein/layer/reasoning/trajectory/zone_avoidance.h"

namespace skein::reasoning {

/// What one aircraft knows of no-fly zones: receives which come and go, keeps what its
/// agent commands out of them, and reports when the aircraft turns away from one or is
/// inside.
class ZoneMonitor {
 public:
  /// @param zones  in force from the start, copied.
  ZoneMonitor(const ZoneAvoidanceOptions& options, const FlightLimits& limits,
              std::span<const Zone> zones, EntityId self)
      : options_(options),
        known_(zones),
        avoidance_(options, limits, zones),
        self_(self) {}

  /// It flies and turns so from now on.
  void set_limits(const FlightLimits& limits) { avoidance_.set_limits(limits); }

  /// Takes in the changes that have been received, with events "zone-on" and "zone-off",
  /// and says which zones are in force then.
  /// They count from this step on.
  /// @returns  whether zones() has changed.
  bool listen(const AgentInput& in, AgentOutput& out);

  /// See ZoneSet::complete_to.
  std::uint32_t changes_known() const { return known_.complete_to(); }

  std::span<const Zone> zones() const { return known_.zones(); }

  /// Kept from the border of zones [m].
  double margin() const { return options_.margin; }

  /// See ZoneAvoidance::check.
  decltype(AutopilotCommand::guidance) keep_out(
      const decltype(AutopilotCommand::guidance)& setpoint, double course,
      const NavEstimate& nav, double altitude_msl) {
    regard(nav, altitude_msl);
    return avoidance_.check(setpoint, course, nav, altitude_msl);
  }

  /// Finds out which zones count for a flight at this altitude [m]; see ZoneAvoidance.
  void regard(const NavEstimate& nav, double altitude_msl);

  /// Whether other zones count than at the last call.
  bool take_change();

  /// Whether the aircraft stands on the ground, and a climb to this altitude there would
  /// lead into a zone. Regards them first.
  bool keeps_on_ground(const AgentInput& in, double altitude_msl);

  /// Whether the straight path from `a` to `b` leads into a zone that counts, as last
  /// regarded; nearer than the margin to those that were received in flight. A route that
  /// was laid beside a known zone is flown as it was laid.
  bool blocks(const Vec2& a, const Vec2& b) const;

  /// The zones that count, as last regarded, grown by the margin: for a planner of a path
  /// between two places. Neither is within a grown zone unless it is in the zone itself:
  /// beside them the margin is smaller.
  std::vector<Zone> obstacles(const Vec2& from, const Vec2& to) const;

  /// Short detours around the zones that count, for an aircraft that can circle at each
  /// corner, as last regarded.
  const DetourPlanner& detours(const NavEstimate& nav);

  /// The zones that count, as last regarded.
  std::vector<Zone> counting() const { return avoidance_.counting(); }

  /// The place itself unless it lies in a zone that counts; then the nearest place where
  /// the aircraft can circle, with the margin. Regards the zones first.
  Vec2 allowed(const Vec2& place, const NavEstimate& nav, double altitude_msl);

  /// The place itself where a circle around it keeps the margin from all zones that
  /// count; else about the nearest where one does; none within 15 times its room. Regards
  /// the zones first.
  std::optional<Vec2> place_to_circle(const Vec2& place, double radius,
                                      const NavEstimate& nav, double altitude_msl);

  /// Whether a circle there keeps the margin from the zones that count, as last regarded.
  bool may_circle(const Vec2& place, double radius) const {
    return avoidance_.distance(place) >= radius + options_.margin;
  }

  /// Whether the last keep_out changed the request.
  bool deflecting() const { return avoidance_.deflecting(); }

  /// Distance to the nearest zone that counts [m], negative inside; infinite without.
  double distance(const Vec2& p) const { return avoidance_.distance(p); }

  /// Reports what has changed since the last call. Needs in.nav.
  void look(const AgentInput& in, AgentOutput& out);

 private:
  ZoneAvoidanceOptions options_;
  ZoneSet known_;
  ZoneAvoidance avoidance_;
  EntityId self_;
  bool changed_ = false;  // which zones count
  bool inside_ = false, deflects_ = false;
  // Detours around the zones that count, and the clearance they were worked out for.
  std::optional<DetourPlanner> detours_;
  double clearance_ = 0;
};

}  // namespace skein::reasoning
