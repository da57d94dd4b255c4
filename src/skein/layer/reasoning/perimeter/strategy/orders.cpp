// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/perimeter/strategy/orders.h"

#include <algorithm>

#include "skein/geo/polygon.h"

namespace skein::perimeter {

bool Orders::open(const AircraftStatus& aircraft, Time now) const {
  const auto found = orders_.find(aircraft.id);
  if (found == orders_.end() || aircraft.task_done) return true;
  const Order& order = found->second;
  if (aircraft.has_crossed && aircraft.last_crossing > order.given) return true;
  return (now - order.given).seconds() > patience_;
}

void Orders::give(EntityId aircraft, const Vec2& place, Time now) {
  orders_[aircraft] = {place, now};
}

void Orders::keep_only(std::span<const AircraftStatus> present) {
  std::erase_if(orders_, [&](const auto& entry) {
    return std::none_of(present.begin(), present.end(),
                        [&](const AircraftStatus& a) { return a.id == entry.first; });
  });
}

bool Orders::taken(EntityId aircraft, const Vec2& place, double distance) const {
  return std::any_of(orders_.begin(), orders_.end(), [&](const auto& entry) {
    return entry.first != aircraft && (entry.second.place - place).norm() < distance;
  });
}

std::optional<Vec2> Orders::place(EntityId aircraft) const {
  const auto found = orders_.find(aircraft);
  if (found == orders_.end()) return std::nullopt;
  return found->second.place;
}

bool in_zone(std::span<const Zone> zones, const Vec2& place) {
  return std::any_of(zones.begin(), zones.end(),
                     [&](const Zone& zone) { return covers(zone, place); });
}

}  // namespace skein::perimeter
