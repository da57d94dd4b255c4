// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/path_cursor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::model {

void PathCursor::assign(const Path& path) {
  elements_.clear();
  elements_.reserve(path.size());
  length_ = 0;
  current_ = 0;
  for (const PathElement& e : path) {
    const Vec2 tangent = geo::unit(e.course);
    const double radius = e.curvature == 0 ? 0 : 1 / std::abs(e.curvature);
    const double side = e.curvature < 0 ? -1 : 1;
    elements_.push_back({e.start, tangent,
                         e.start + side * radius * geo::turned_right(tangent), radius,
                         side, e.curvature, e.course, e.length, length_});
    length_ += e.length;
  }
}

// The nearest point with arc length in [low, high] of the element, unless it is clear
// that its squared distance is not below `best`: then some point not below it.
PathCursor::Candidate PathCursor::nearest_on(const Element& e, const Vec2& p, double low,
                                             double high, double best) {
  if (e.radius == 0) {
    const double s = std::clamp((p - e.start).dot(e.tangent), low, high);
    return {s, (p - e.start - s * e.tangent).squaredNorm(), false};
  }
  const Vec2 to_p = p - e.centre;
  const double off = to_p.norm() - e.radius;
  if (off * off >= best) return {low, off * off, false};
  const Vec2 to_start = e.start - e.centre;
  const double turned =
      e.side * math::atan2(geo::cross(to_start, to_p), to_start.dot(to_p)) * e.radius;
  // Within one turn of the middle of the allowed part: the nearer end wins where p lies
  // outside of it. An arc may be longer than one turn: the earliest pass counts.
  const double turn = 2 * geo::kPi * e.radius;
  double s = turned + turn * std::round(((low + high) / 2 - turned) / turn);
  if (s - turn >= low) s -= turn * std::floor((s - low) / turn);
  if (s >= low && s <= high) return {s, off * off, true};
  s = std::clamp(s, low, high);
  return {s, (p - point_of(e, s).position).squaredNorm(), false};
}

TrackPoint PathCursor::point_of(const Element& e, double s) {
  if (e.radius == 0) return {e.start + s * e.tangent, e.tangent, 0};
  const double turned = e.curvature * s;
  const double c = math::cos(turned), sine = math::sin(turned);
  const Vec2 tangent(c * e.tangent.x() - sine * e.tangent.y(),
                     sine * e.tangent.x() + c * e.tangent.y());
  return {e.centre - e.side * e.radius * geo::turned_right(tangent), tangent,
          e.curvature};
}

PathCursor::Place PathCursor::project(const Vec2& p, double from, double to) {
  SKEIN_CHECK(!elements_.empty());
  from = std::clamp(from, 0.0, length_);
  to = std::clamp(to, from, length_);

  // The last element first: its distance rules most others out at once.
  std::size_t best_index = current_;
  Candidate best{0, std::numeric_limits<double>::infinity(), false};
  const auto look_at = [&](std::size_t i) {
    const Element& e = elements_[i];
    const double low = std::max(from - e.begin, 0.0);
    const double high = std::min(to - e.begin, e.length);
    if (low > high) return;
    const Candidate found = nearest_on(e, p, low, high, best.distance2);
    // Of equal points the earliest counts.
    if (found.distance2 < best.distance2 ||
        (found.distance2 == best.distance2 && i < best_index)) {
      best = found;
      best_index = i;
    }
  };
  look_at(current_);
  for (std::size_t i = current_; i > 0; --i) {
    if (elements_[i].begin < from) break;
    look_at(i - 1);
  }
  for (std::size_t i = current_ + 1; i < elements_.size(); ++i) {
    if (elements_[i].begin > to) break;
    look_at(i);
  }
  current_ = best_index;

  const Element& e = elements_[best_index];
  Place place;
  place.along = e.begin + best.s;
  place.remaining = length_ - place.along;
  place.course = e.course + e.curvature * best.s;
  const Vec2 out = p - e.centre;
  const double distance = out.norm();
  if (best.beside && distance > 0) {
    // The direction to p is that of the nearest point: no angle functions.
    place.point = {e.centre + e.radius / distance * out,
                   e.side / distance * geo::turned_right(out), e.curvature};
  } else {
    place.point = point_of(e, best.s);
  }
  place.cross_track = geo::cross(place.point.tangent, p - place.point.position);
  return place;
}

std::size_t PathCursor::index_at(double s) const {
  std::size_t i = current_;
  while (i > 0 && s < elements_[i].begin) --i;
  while (i + 1 < elements_.size() && s >= elements_[i + 1].begin) ++i;
  return i;
}

TrackPoint PathCursor::at(double s) const {
  SKEIN_CHECK(!elements_.empty());
  if (s <= 0) {
    const Element& first = elements_.front();
    return {first.start + s * first.tangent, first.tangent, s < 0 ? 0 : first.curvature};
  }
  const Element& e = elements_[index_at(s)];
  if (s < e.begin + e.length) return point_of(e, s - e.begin);
  TrackPoint end = point_of(e, e.length);
  end.position += (s - length_) * end.tangent;
  end.curvature = 0;
  return end;
}

double PathCursor::curvature_at(double s) const {
  if (s < 0 || s >= length_) return 0;
  return elements_[index_at(s)].curvature;
}

double PathCursor::tightest(double from, double to) const {
  double max = 0;
  if (elements_.empty()) return max;
  for (std::size_t i = index_at(from); i < elements_.size(); ++i) {
    const Element& e = elements_[i];
    if (e.begin > to) break;
    if (e.begin + e.length > from) max = std::max(max, std::abs(e.curvature));
  }
  return max;
}

double PathCursor::speed_limit(double along, double lateral, double braking,
                               double max) const {
  double square = max * max;
  for (std::size_t i = index_at(along); i < elements_.size(); ++i) {
    const Element& e = elements_[i];
    const double braked = 2 * braking * std::max(e.begin - along, 0.0);
    if (braked > square) break;
    if (e.curvature != 0 && e.begin + e.length > along)
      square = std::min(square, lateral / std::abs(e.curvature) + braked);
  }
  return std::sqrt(square);
}

}  // namespace skein::model
