// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/trajectory/zone_monitor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/layer/reasoning/trajectory/grown_zone.h"
#include "skein/layer/reasoning/trajectory/round_trip.h"

namespace skein::reasoning {
namespace {

constexpr int kRings = 60;       // around a place, on which room to circle is looked for
constexpr int kRingsInRoom = 4;  // of them in the room of a circle
constexpr int kBearings = 32;    // on each
constexpr double kMinRoom = 3;   // from a grown zone to the ends of a path [m]

}  // namespace

bool ZoneMonitor::listen(const AgentInput& in, AgentOutput& out) {
  bool changed = false;
  for (const Message& message : in.inbox) {
    const auto* change = std::get_if<ZoneChange>(&message.content);
    if (!change || !known_.take(*change)) continue;
    changed = true;
    out.events.push_back({in.now, self_,
                          change->on ? EventKind::kZoneOn : EventKind::kZoneOff,
                          fmt::format("{} {}", change->on ? "keeps out of" : "may fly in",
                                      change->zone.name)});
  }
  if (!changed) return false;
  const std::span<const Zone> zones = known_.zones();
  out.zones.emplace(zones.begin(), zones.end());
  avoidance_.set_zones(zones);
  detours_.reset();
  changed_ = true;
  return true;
}

void ZoneMonitor::regard(const NavEstimate& nav, double altitude_msl) {
  if (!avoidance_.regard(nav, altitude_msl)) return;
  detours_.reset();
  changed_ = true;
}

bool ZoneMonitor::take_change() {
  return std::exchange(changed_, false);
}

bool ZoneMonitor::keeps_on_ground(const AgentInput& in, double altitude_msl) {
  if (!in.autopilot.on_ground) return false;
  regard(*in.nav, altitude_msl);
  return avoidance_.distance(geo::horizontal(in.nav->p_N)) < 0;
}

bool ZoneMonitor::blocks(const Vec2& a, const Vec2& b) const {
  const std::vector<Zone> zones = avoidance_.counting();
  return std::any_of(zones.begin(), zones.end(), [&](const Zone& zone) {
    const double between = distance_between(a, b, outline(zone));
    return between <= (known_.heard(zone.name) ? options_.margin : 0);
  });
}

std::vector<Zone> ZoneMonitor::obstacles(const Vec2& from, const Vec2& to) const {
  std::vector<Zone> grown = avoidance_.counting();
  for (Zone& zone : grown) {
    const geo::Ring around = outline(zone);
    const double room =
        std::min(distance_between(from, from, around), distance_between(to, to, around));
    zone = reasoning::grown(zone, std::min(options_.margin, room - kMinRoom),
                            options_.vertical_margin);
  }
  return grown;
}

const DetourPlanner& ZoneMonitor::detours(const NavEstimate& nav) {
  const double needed = options_.margin + avoidance_.circle_radius(nav);
  if (!detours_ || std::abs(needed - clearance_) > kClearanceSlack * clearance_) {
    clearance_ = needed;
    detours_.emplace(avoidance_.counting(), clearance_);
  }
  return *detours_;
}

Vec2 ZoneMonitor::allowed(const Vec2& place, const NavEstimate& nav,
                          double altitude_msl) {
  if (avoidance_.empty()) return place;
  regard(nav, altitude_msl);
  if (avoidance_.distance(place) >= 0) return place;
  return detours(nav).nearest_allowed(place);
}

std::optional<Vec2> ZoneMonitor::place_to_circle(const Vec2& place, double radius,
                                                 const NavEstimate& nav,
                                                 double altitude_msl) {
  const Vec2 first = allowed(place, nav, altitude_msl);
  const double room = radius + options_.margin;
  if (avoidance_.distance(first) >= room) return first;
  // Rings around it, the nearest first.
  for (int ring = 1; ring <= kRings; ++ring) {
    std::optional<Vec2> best;
    double most = room;
    for (int k = 0; k < kBearings; ++k) {
      const Vec2 tried =
          first + ring * room / kRingsInRoom * geo::unit(2 * geo::kPi * k / kBearings);
      if (const double distance = avoidance_.distance(tried); distance >= most) {
        most = distance;
        best = tried;
      }
    }
    if (best) return best;
  }
  return std::nullopt;
}

void ZoneMonitor::look(const AgentInput& in, AgentOutput& out) {
  if (avoidance_.empty() && !inside_) return;
  const bool inside = avoidance_.distance(geo::horizontal(in.nav->p_N)) < 0;
  if (inside != inside_)
    out.events.push_back({in.now, self_, EventKind::kZone,
                          inside ? "is inside a no-fly zone" : "has left the zone"});
  else if (avoidance_.deflecting() && !deflects_ && !inside)
    out.events.push_back(
        {in.now, self_, EventKind::kZone, "turns away from a no-fly zone"});
  inside_ = inside;
  deflects_ = avoidance_.deflecting();
}

}  // namespace skein::reasoning
