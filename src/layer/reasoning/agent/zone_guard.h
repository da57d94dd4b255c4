#pragma once

#include <span>
#include <vector>

#include "data/autopilot.h"
#include "data/vehicle.h"
#include "data/zone.h"
#include "geo/boundary_index.h"

namespace skein::reasoning {

struct ZoneGuardOptions {
  double margin = 30;    ///< kept from the border, for errors of position and control [m]
  double preview = 2.5;  ///< flight that is looked at before the way out must be open [s]
};

/// Keeps an aircraft out of no-flight zones.
///
/// Invariant: a full circle over ground, left or right of the aircraft and wide enough to
/// be flown in the wind, touches no zone (nor its margin). A course is allowed when the
/// flight of the next seconds ends with such a circle; otherwise the nearest allowed
/// course is taken, on the same side as long as the conflict lasts, so that the aircraft
/// follows the border; when there is none, it flies the circle. In an aircraft that
/// starts within the margin, the way out comes first. Valid: wind changes during one
/// circle are covered by `margin` only.
class ZoneGuard {
 public:
  ZoneGuard(const ZoneGuardOptions& options, const FlightLimits& limits,
            std::span<const Zone> zones);

  bool empty() const { return zones_.empty(); }

  /// What to fly instead of `wanted`, whose course over ground is `course` now.
  decltype(AutopilotCommand::guidance) check(
      const decltype(AutopilotCommand::guidance)& wanted, double course,
      const NavEstimate& nav);

  /// Whether the last check changed what was wanted.
  bool deflecting() const { return deflecting_; }

  /// Distance to the nearest zone [m], negative inside; infinite without zones.
  double distance(const Vec2& p) const;

 private:
  struct State {
    Vec2 position;
    double course;
  };
  struct Escape {
    Circle circle;
    double clearance = 0;  // of the circle to the zones less the margin [m]
  };
  State fly(const NavEstimate& nav, double course, double& nearest) const;
  Escape best_escape(const State& state) const;
  // How well a course keeps the invariant [m]; allowed when not negative.
  double slack(const NavEstimate& nav, double course) const;
  Vec2 nearest_border(const Vec2& p) const;

  ZoneGuardOptions options_;
  FlightLimits limits_;
  std::vector<geo::BoundaryIndex> zones_;
  double radius_ = 0;  // of the escape circle in the wind of the last check [m]
  int side_ = 0;       // of the deflection: +1 right; 0 = none
  bool deflecting_ = false;
};

}  // namespace skein::reasoning
