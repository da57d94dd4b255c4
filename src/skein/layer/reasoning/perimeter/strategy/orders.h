// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>

#include "skein/data/perimeter/monitoring.h"

namespace skein::perimeter {

/// What a strategy remembers of the orders that it gave: where each aircraft is sent, and
/// whether that is settled.
class Orders {
 public:
  /// @param patience  an order older than this is given up [s].
  explicit Orders(double patience) : patience_(patience) {}

  /// Whether the aircraft needs a new order: it has none, has done it, has crossed the
  /// boundary since, or has been at it for too long.
  bool open(const AircraftStatus& aircraft, Time now) const;

  /// Notes that the aircraft was sent to `place` at `now`.
  void give(EntityId aircraft, const Vec2& place, Time now);

  /// Forgets aircraft that are not in `present`.
  void keep_only(std::span<const AircraftStatus> present);

  /// Whether another aircraft than `aircraft` was sent to within `distance` [m] of
  /// `place`.
  bool taken(EntityId aircraft, const Vec2& place, double distance) const;

  /// Where the aircraft was sent, if anywhere.
  std::optional<Vec2> place(EntityId aircraft) const;

 private:
  struct Order {
    Vec2 place = Vec2::Zero();
    Time given;
  };
  double patience_;
  std::map<EntityId, Order> orders_;
};

/// Whether a place lies in a no-fly zone.
bool in_zone(std::span<const Zone> zones, const Vec2& place);

}  // namespace skein::perimeter
