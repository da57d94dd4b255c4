// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/flight_conditions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace skein::reasoning {
namespace {

constexpr double kClearance = 30;  // of ways around zones [m]
constexpr double kVertical = 20;   // zones that are nearer over or under count [m]
constexpr double kLead = 60;       // those count that begin so soon [s]

}  // namespace

void FlightConditions::set_zones(std::span<const Zone> zones, double altitude_msl,
                                 double time) {
  const auto counts = [&](const Zone& zone) {
    return concerns(zone, altitude_msl - kVertical, altitude_msl + kVertical, time,
                    time + kLead);
  };
  std::size_t same = 0;
  bool is_new = false;
  for (const Zone& zone : zones) {
    if (!counts(zone)) continue;
    is_new = is_new || same == zones_.size() || !(zone == zones_[same]);
    if (is_new) break;
    ++same;
  }
  if (!is_new && same == zones_.size()) return;
  zones_.clear();
  std::ranges::copy_if(zones, std::back_inserter(zones_), counts);
  detours_.reset();
  if (!zones_.empty()) detours_.emplace(zones_, kClearance);
}

std::optional<double> FlightConditions::time(const Vec2& from, const Vec2& to,
                                             double speed) const {
  if (!detours_ || detours_->allows(from, to))
    return time_in_wind(to - from, speed, wind_);
  double time = 0;
  Vec2 at = from;
  for (const Vec2& corner : detours_->detour(from, to)) {
    const auto leg = time_in_wind(corner - at, speed, wind_);
    if (!leg) return std::nullopt;
    time += *leg;
    at = corner;
  }
  return time;
}

std::optional<double> time_in_wind(const Vec2& leg, double speed, const Vec2& wind) {
  const double distance = leg.norm();
  if (distance <= 0) return 0;
  const Vec2 along = leg / distance;
  const double across = along.x() * wind.y() - along.y() * wind.x();
  if (std::abs(across) >= speed) return std::nullopt;
  const double over_ground = wind.dot(along) + std::sqrt(speed * speed - across * across);
  if (over_ground <= 0) return std::nullopt;
  return distance / over_ground;
}

}  // namespace skein::reasoning
