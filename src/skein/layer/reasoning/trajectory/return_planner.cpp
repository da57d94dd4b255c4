// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/return_planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skein::reasoning {
namespace {

constexpr double kPeriod = 1;         // between looks at the route [s]
constexpr double kHorizon = 600;      // zones of the next time that count [s]
constexpr double kReturnHeight = 60;  // autopilots return this high at least [m]
constexpr double kSamePlace = 1;      // nearer is the same [m]

std::vector<Zone> those(std::span<const Zone> zones, const std::vector<bool>& count) {
  std::vector<Zone> some;
  for (std::size_t k = 0; k < zones.size(); ++k)
    if (count[k]) some.push_back(zones[k]);
  return some;
}

}  // namespace

ReturnPlanner::Counting ReturnPlanner::count(const AgentInput& in, const Vec2& home,
                                             std::span<const Zone> zones) const {
  const double ground = map_.elevation_msl(home), now = in.now.seconds();
  const double high = std::max(-in.nav->p_N.z(), ground + kReturnHeight);
  const double margin = options_.vertical_margin;
  Counting counting;
  for (const Zone& zone : zones) {
    counting.place.push_back(concerns(zone, ground, high + margin, now, now + kHorizon));
    counting.route.push_back(
        concerns(zone, high - margin, high + margin, now, now + kHorizon));
  }
  return counting;
}

void ReturnPlanner::draw(std::span<const Zone> zones, double clearance) {
  clearance_ = clearance;
  places_.emplace(those(zones, counting_.place), clearance);
  detours_.emplace(those(zones, counting_.route), clearance);
  narrow_.emplace(those(zones, counting_.route), options_.margin);
}

void ReturnPlanner::move_home(const AgentInput& in, const Vec2& home, AgentOutput& out) {
  const Vec2 place = places_->nearest_allowed(home);
  // A place that will do is kept: the nearest one moves with the wind.
  if (moved_ && place != home && places_->allows(*moved_)) return;
  std::optional<Vec2> moved;
  if ((place - home).norm() > kSamePlace) moved = place;
  if (moved.has_value() == moved_.has_value() &&
      (!moved || (*moved - *moved_).norm() <= kSamePlace))
    return;
  moved_ = moved;
  out.events.push_back(
      {in.now, self_, EventKind::kReturnMoved,
       moved ? fmt::format("home lies in or at a no-fly zone: returns lead to {:.0f} m "
                           "north, {:.0f} m east",
                           moved->x(), moved->y())
             : std::string("returns lead home again")});
}

// The route that was given is kept while it leads past the zones: a landing is not to be
// broken off because the approach passes one within its circle.
bool ReturnPlanner::still_good(const Vec2& here, const Vec2& goal) const {
  if (reported_.points.empty() || reported_.points.back() != goal) return false;
  return narrow_->allows(here, reported_.points.front());
}

// Whether a corner of the route need not be flown to any more.
bool ReturnPlanner::is_behind(const Vec2& here, const Vec2& corner,
                              const Vec2& next) const {
  return detours_->allows(here, next) ||
         ((here - corner).norm() < clearance_ && narrow_->allows(here, next));
}

void ReturnPlanner::step(const AgentInput& in, const Vec2& home,
                         std::span<const Zone> zones, bool changed, AgentOutput& out) {
  if ((zones.empty() && counting_.place.empty()) || (!changed && in.now < next_)) return;
  next_ = in.now + Time::from_seconds(kPeriod);
  const Counting counting = count(in, home, zones);
  const double needed = options_.margin + avoidance_.circle_radius(*in.nav);
  const bool anew = changed || !places_ || counting != counting_ ||
                    std::abs(needed - clearance_) > kClearanceSlack * clearance_;
  if (anew) {
    counting_ = counting;
    draw(zones, needed);
    move_home(in, home, out);
  }
  const Vec2 here = geo::horizontal(in.nav->p_N), goal = moved_.value_or(home);
  ReturnRoute route = reported_;
  if (!anew && still_good(here, goal)) {
    while (route.points.size() > 1 && is_behind(here, route.points[0], route.points[1]))
      route.points.erase(route.points.begin());
  } else {
    route.points = detours_->detour(here, goal);
  }
  if (route.points.size() == 1 && !moved_) route.points.clear();  // as without zones
  route.ground_msl = route.points.empty() ? 0 : map_.elevation_msl(route.points.back());
  if (route == reported_) return;
  reported_ = route;
  out.return_route = std::move(route);
}

}  // namespace skein::reasoning
