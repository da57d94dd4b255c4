// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "skein/layer/reasoning/perimeter/strategy/boundary_line.h"
#include "skein/layer/reasoning/perimeter/strategy/orders.h"
#include "skein/layer/reasoning/perimeter/strategy/time_to_go.h"
#include "skein/role/monitoring_strategy.h"

namespace skein::perimeter {

struct GusOptions {
  /// Aim at this many standard deviations beyond the boundary: 0.6745 for the 50 %
  /// interval on the normal, 1.1774 for the 50 % ellipse along its axis.
  double aim_sigmas = 0.6745;
  double min_reach = 30;    ///< aim at least this far beyond the boundary [m]
  double separation = 150;  ///< between the targets of two aircraft, at least [m]
  double patience = 120;    ///< an order not done after this time is renewed [s]
  double settle_time = 15;  ///< gus-rate: the constant in J / (t_go + constant) [s]
};

/// Greedy uncertainty suppression: each aircraft in turn flies to the boundary point with
/// the greatest expected uncertainty on arrival,
///
///   J_ij = sigma_i + sigma'_i t_go(i, j),
///
/// or, with `per_second` (gus-rate), the greatest J_ij / (t_go + constant): the
/// uncertainty that a crossing there removes per second of flight. Reference:
/// [Rabinovich18] section 2.7; the rate form is Skein's own.
class GusStrategy : public MonitoringStrategy {
 public:
  GusStrategy(const GusOptions& options, bool per_second);

  std::vector<Assignment> assign(const MonitoringSituation& situation) override;

 private:
  std::optional<Meeting> choose(const BoundaryLine& line, const AircraftStatus& aircraft,
                                std::span<const Zone> zones) const;

  GusOptions options_;
  bool per_second_;
  Orders orders_;
};

/// How much a target is worth: its uncertainty on arrival J [m], or with a settle time
/// [s] J per second of flight.
double target_value(const Meeting& meeting, std::optional<double> settle_time);

/// Why a target was chosen: its uncertainty on arrival, the time to go, and with a settle
/// time what it is worth per second.
std::vector<NamedValue> reasons(const Meeting& meeting,
                                std::optional<double> settle_time);

/// The order to cross the boundary where the aircraft meets it.
FlyTo order_across(const AircraftStatus& aircraft, const Meeting& meeting,
                   const GusOptions& options);

}  // namespace skein::perimeter
