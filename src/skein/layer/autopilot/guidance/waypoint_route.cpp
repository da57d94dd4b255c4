// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/guidance/waypoint_route.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"
#include "skein/model/path/path_geometry.h"

namespace skein::autopilot {
namespace {

constexpr double kNoLeg = 1e-3;   // points nearer than this are one [m]
constexpr double kNoTurn = 1e-6;  // [rad]
constexpr double kOther = 0.1;    // of a radius: a corner is laid out anew
constexpr double kNear = 0.3;     // of a radius: it is too late for that

}  // namespace

void WaypointRoute::begin(const FlyWaypoints& command, const Vec3& from,
                          const CornerRule& rule) {
  SKEIN_CHECK(!command.points.empty() && command.laps >= 1, command.laps);
  points_ = command.points;
  from_ = {geo::horizontal(from), -from.z()};
  rule_ = rule;
  leg_ = 0;
  legs_ = static_cast<long>(points_.size()) * command.laps;
  before_ = {};
  along_ = 0;
  lay_out();
}

void WaypointRoute::set_rule(const CornerRule& rule) {
  rule_ = rule;
  const Corner corner = corner_after(leg_);
  if (std::abs(corner.radius - after_.radius) <= kOther * after_.radius) return;
  // Not once the arc is near, or the line would jump aside.
  const double begins = straight_ + std::min(after_.tangent - corner.tangent, 0.0);
  if (along_ < begins - kNear * corner.radius) lay_out();
}

FlyWaypoints::Waypoint WaypointRoute::point(long leg) const {
  if (leg < 0) return from_;
  return points_[static_cast<std::size_t>(leg) % points_.size()];
}

WaypointRoute::Corner WaypointRoute::corner_after(long leg) const {
  Corner corner;
  if (leg + 1 >= legs_ || (rule_.radius <= 0 && rule_.cut <= 0)) return corner;
  const Vec2 in = point(leg).point - point(leg - 1).point;
  const Vec2 out = point(leg + 1).point - point(leg).point;
  if (in.norm() < kNoLeg || out.norm() < kNoLeg) return corner;
  const double angle = math::atan2(geo::cross(in, out), in.dot(out));
  const double half = std::abs(angle) / 2;
  const double room = std::min(in.norm(), out.norm()) / 2;
  // Nearly straight back: no arc of any use.
  if (half < kNoTurn || half > 0.49 * geo::kPi) return corner;
  const double tangent = math::tan(half);
  corner.radius = rule_.radius > 0 ? rule_.radius : rule_.cut / (1 / math::cos(half) - 1);
  if (corner.radius * tangent > room) {
    if (rule_.radius > 0) return {};
    corner.radius = room / tangent;
  }
  corner.tangent = corner.radius * tangent;
  corner.length = corner.radius * 2 * half;
  corner.side = angle < 0 ? -1 : 1;
  return corner;
}

void WaypointRoute::lay_out() {
  const auto leg_of = [&](long leg) -> Vec2 {
    return point(leg).point - point(leg - 1).point;
  };
  // Points that lie on one another make no leg.
  while (leg_ + 1 < legs_ && leg_of(leg_).norm() < kNoLeg) ++leg_;
  after_ = corner_after(leg_);

  layout_.clear();
  Corner from = before_;
  for (int i = 0; i < 2 && leg_ + i < legs_; ++i) {
    const long k = leg_ + i;
    const Vec2 leg = leg_of(k);
    const double length = leg.norm();
    if (i > 0 && length < kNoLeg) break;
    const Corner to = i == 0 ? after_ : corner_after(k);
    const double course = geo::bearing(leg);
    const Vec2 start = point(k - 1).point + from.tangent * geo::unit(course);
    const double straight = length - from.tangent - to.tangent;
    layout_.push_back({start, course, straight, 0});
    const double with_arcs = from.length / 2 + straight + to.length / 2;
    (i == 0 ? leg_length_ : leg_length_next_) = with_arcs;
    if (i == 0) straight_ = straight;
    if (to.length <= 0) break;  // a sharp corner is flown up to, not around
    const model::Pose at = model::end_of(layout_.back());
    layout_.push_back({at.position, course, to.length, to.side / to.radius});
    from = to;
  }
  cursor_.assign(layout_);

  // What is left after this leg, corners counted as sharp.
  double lap = 0, part = 0;
  const long n = static_cast<long>(points_.size());
  for (long k = leg_ + 1; k <= leg_ + n; ++k) {
    const double length = leg_of(k).norm();
    lap += length;
    if (k - leg_ <= (legs_ - 1 - leg_) % n) part += length;
  }
  const long whole_laps = (legs_ - 1 - leg_) / n;
  beyond_ = part + lap * static_cast<double>(whole_laps);
}

WaypointRoute::Place WaypointRoute::project(const Vec2& p, double window) {
  Place place;
  place.on_path = cursor_.project(p, along_ - window, along_ + 5 * window);
  along_ = place.on_path.along;
  const double end = straight_ + after_.length;
  // The end of a sharp leg has been passed when the vehicle is beyond it.
  const bool passed =
      along_ >= end &&
      (after_.length > 0 ||
       (p - place.on_path.point.position).dot(place.on_path.point.tangent) >= 0);
  if (passed && on_last_leg()) {
    place.done = true;
    place.altitude_msl = last().altitude_msl;
    return place;
  }
  if (passed) {
    along_ -= end;
    before_ = after_;
    ++leg_;
    lay_out();
    place.on_path = cursor_.project(p, along_ - window, along_ + window);
    along_ = place.on_path.along;
  }
  const double flown = before_.length / 2 + along_;
  const bool next = flown > leg_length_;
  const double length = next ? leg_length_next_ : leg_length_;
  const double share =
      length > 0 ? std::clamp((next ? flown - leg_length_ : flown) / length, 0.0, 1.0)
                 : 1.0;
  const long leg = leg_ + (next ? 1 : 0);
  const double low = point(leg - 1).altitude_msl, high = point(leg).altitude_msl;
  place.altitude_msl = low + share * (high - low);
  place.slope = length > 0 && share < 1 ? (high - low) / length : 0;
  place.remaining = std::max(leg_length_ - flown, 0.0) + beyond_;
  if (next) place.remaining = std::max(beyond_ - (flown - leg_length_), 0.0);
  return place;
}

}  // namespace skein::autopilot
