#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/base/id.h"
#include "skein/data/agent_step.h"
#include "skein/data/zone_book.h"
#include "skein/layer/reasoning/agent/ways_around.h"
#include "skein/layer/reasoning/agent/zone_guard.h"

namespace skein::reasoning {

/// What one aircraft knows of no-flight zones: hears which come and go, keeps what its
/// agent commands out of them, and tells when the aircraft turns away from one or is
/// inside.
class ZoneWatch {
 public:
  /// @param zones  in force from the start, copied.
  ZoneWatch(const ZoneGuardOptions& options, const FlightLimits& limits,
            std::span<const Zone> zones, EntityId self)
      : options_(options), book_(zones), guard_(options, limits, zones), self_(self) {}

  /// Takes in the changes that have been heard of, with events "zone-on" and "zone-off".
  /// They count from this step on.
  /// @returns  whether zones() has changed.
  bool listen(const AgentInput& in, AgentOutput& out);

  /// See ZoneBook::complete_to.
  std::uint32_t changes_known() const { return book_.complete_to(); }

  std::span<const Zone> zones() const { return book_.zones(); }

  /// See ZoneGuard::check.
  decltype(AutopilotCommand::guidance) keep_out(
      const decltype(AutopilotCommand::guidance)& wanted, double course,
      const NavEstimate& nav, double altitude_msl) {
    regard(nav, altitude_msl);
    return guard_.check(wanted, course, nav, altitude_msl);
  }

  /// Finds out which zones count for a flight at this altitude [m]; see ZoneGuard.
  void regard(const NavEstimate& nav, double altitude_msl);

  /// Whether other zones count than at the last call.
  bool take_change();

  /// Whether the aircraft stands on the ground, and a climb to this altitude there would
  /// lead into a zone. Regards them first.
  bool keeps_on_ground(const AgentInput& in, double altitude_msl);

  /// Whether the straight way from `a` to `b` leads into a zone that counts, as last
  /// regarded; nearer than the margin to those that were heard of in flight. A route that
  /// was laid beside a known zone is flown as it was laid.
  bool blocks(const Vec2& a, const Vec2& b) const;

  /// The zones that count, as last regarded, grown by the margin: for a planner of a way
  /// between two places. Neither is within a grown zone unless it is in the zone itself:
  /// beside them the margin is smaller.
  std::vector<Zone> obstacles(const Vec2& from, const Vec2& to) const;

  /// Short ways around the zones that count, for an aircraft that can circle at each
  /// corner, as last regarded.
  const WaysAround& ways(const NavEstimate& nav);

  /// The zones that count, as last regarded.
  std::vector<Zone> counting() const { return guard_.counting(); }

  /// The place itself unless it lies in a zone that counts; then the nearest place where
  /// the aircraft can circle, with the margin. Regards the zones first.
  Vec2 allowed(const Vec2& place, const NavEstimate& nav, double altitude_msl);

  /// Whether the last keep_out changed what was wanted.
  bool deflecting() const { return guard_.deflecting(); }

  /// Distance to the nearest zone that counts [m], negative inside; infinite without.
  double distance(const Vec2& p) const { return guard_.distance(p); }

  /// Tells what has changed since the last call. Needs in.nav.
  void look(const AgentInput& in, AgentOutput& out);

 private:
  ZoneGuardOptions options_;
  ZoneBook book_;
  ZoneGuard guard_;
  EntityId self_;
  bool changed_ = false;  // which zones count
  bool inside_ = false, deflects_ = false;
  // Ways around the zones that count, and the clearance they were worked out for.
  std::optional<WaysAround> ways_;
  double clearance_ = 0;
};

}  // namespace skein::reasoning
