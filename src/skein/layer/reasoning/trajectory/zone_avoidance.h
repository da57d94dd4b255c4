// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/data/airspace/zone.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/vehicle.h"
#include "skein/geo/boundary_index.h"

namespace skein::reasoning {

struct ZoneAvoidanceOptions {
  double margin = 30;    ///< kept from the border, for errors of position and control [m]
  double preview = 2.5;  ///< flight that is looked at before the escape must be open [s]
  double vertical_margin = 20;  ///< kept from floors and ceilings [m]
  double lead = 60;             ///< kept out of this long before a zone's time begins [s]
};

/// Keeps an aircraft out of no-fly zones.
///
/// Invariant: a full circle over ground, left or right of the aircraft and wide enough to
/// be flown in the wind, touches no zone (nor its margin). A course is allowed when the
/// flight of the next seconds ends with such a circle; otherwise the nearest allowed
/// course is taken, on the same side as long as the conflict lasts, so that the aircraft
/// follows the border; when there is none, it flies the circle. Who is on a circle that
/// keeps the margin stays on it. Wings take time to bank, most from one side to the
/// other: turns begin as its present bank allows. In an aircraft that starts within the
/// margin, leaving it comes first.
/// Valid: wind changes during one circle are covered by `margin` only.
///
/// Only zones count that forbid an altitude between that of the aircraft and the
/// commanded one, `vertical_margin` above and below included, at a time from now to
/// `lead` later. Under a floor that the commanded altitude does not keep, it turns away
/// sideways.
class ZoneAvoidance {
 public:
  ZoneAvoidance(const ZoneAvoidanceOptions& options, const FlightLimits& limits,
                std::span<const Zone> zones);

  /// It flies and turns so from now on.
  void set_limits(const FlightLimits& limits) { limits_ = limits; }

  /// Other zones from now on.
  void set_zones(std::span<const Zone> zones);

  bool empty() const { return zones_.empty(); }

  /// Finds out which zones count now; those of before are forgotten.
  /// @param altitude_msl  commanded [m]; none: the present one.
  /// @returns             whether these are others than before.
  bool regard(const NavEstimate& nav, std::optional<double> altitude_msl);

  /// What to fly instead of `setpoint`, whose course over ground is `course` now. Regards
  /// the zones first.
  decltype(AutopilotCommand::guidance) check(
      const decltype(AutopilotCommand::guidance)& setpoint, double course,
      const NavEstimate& nav, std::optional<double> altitude_msl = std::nullopt);

  /// Whether the last check changed the request.
  bool deflecting() const { return deflecting_; }

  /// Distance to the nearest zone that counted when last regarded, at first any [m];
  /// negative inside; infinite without.
  double distance(const Vec2& p) const;

  /// The zones that counted when last regarded; at first all.
  std::vector<Zone> counting() const;

  /// Of a circle that can be flown over ground in the wind, with room to correct [m].
  double circle_radius(const NavEstimate& nav) const;

 private:
  struct State {
    Vec2 position;
    Vec2 velocity;     // over ground
    double turn_rate;  // [rad/s]
  };
  struct Escape {
    Circle circle;
    double clearance = 0;  // of the circle to the zones less the margin [m]
  };
  double turn_rate(const NavEstimate& nav) const;
  bool stays_on(const Circle& circle, const NavEstimate& nav) const;
  State fly(const NavEstimate& nav, double course, double& nearest) const;
  Escape best_escape(const State& state) const;
  // How well a course keeps the invariant [m]; allowed when not negative.
  double slack(const NavEstimate& nav, double course) const;
  void draw_border();

  ZoneAvoidanceOptions options_;
  FlightLimits limits_;
  std::vector<Zone> zones_;
  std::vector<bool> counts_;   // of zones_
  geo::BoundaryIndex border_;  // around those that count, taken together
  double radius_ = 0;          // of the escape circle in the wind of the last check [m]
  int side_ = 0;               // of the deflection: +1 right; 0 = none
  bool deflecting_ = false;
};

}  // namespace skein::reasoning
