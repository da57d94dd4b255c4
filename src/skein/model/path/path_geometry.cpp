// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/path_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::model {
namespace {

// Arc length in [low, high] of the element's point nearest to `p`.
double nearest_on(const PathElement& e, const Vec2& p, double low, double high) {
  const Vec2 along = geo::unit(e.course);
  if (e.curvature == 0) return std::clamp((p - e.start).dot(along), low, high);
  const double radius = 1 / std::abs(e.curvature);
  const double side = e.curvature > 0 ? 1 : -1;
  const Vec2 centre = e.start + side * radius * geo::turned_right(along);
  const Vec2 to_start = e.start - centre;
  const Vec2 to_p = p - centre;
  // Angle flown from the start to the bearing of p, within one turn of the middle of the
  // allowed part: the nearer end wins where p lies outside of it.
  const double turned =
      side * math::atan2(geo::cross(to_start, to_p), to_start.dot(to_p)) * radius;
  const double turn = 2 * geo::kPi * radius;
  const double middle = (low + high) / 2;
  double s = turned + turn * std::round((middle - turned) / turn);
  // An arc may be longer than one turn: the earliest pass counts.
  while (s - turn >= low) s -= turn;
  return std::clamp(s, low, high);
}

}  // namespace

Pose pose_at(const PathElement& e, double s) {
  const double turned = e.curvature * s;
  // Chord of the arc: s sinc(turned/2) at the mean course; exact, also for straights.
  const double half = turned / 2;
  const double chord = std::abs(half) < 1e-8 ? s : s * math::sin(half) / half;
  return {e.start + chord * geo::unit(e.course + half), geo::wrap_pi(e.course + turned)};
}

Pose end_of(const PathElement& element) {
  return pose_at(element, element.length);
}

double length(const Path& path) {
  double sum = 0;
  for (const PathElement& e : path) sum += e.length;
  return sum;
}

Pose pose_at(const Path& path, double s) {
  SKEIN_CHECK(!path.empty());
  if (s <= 0) {
    const PathElement& first = path.front();
    return {first.start + s * geo::unit(first.course), geo::wrap_pi(first.course)};
  }
  for (const PathElement& e : path) {
    if (s <= e.length) return pose_at(e, s);
    s -= e.length;
  }
  const Pose end = end_of(path.back());
  return {end.position + s * geo::unit(end.course), end.course};
}

double curvature_at(const Path& path, double s) {
  if (s < 0) return 0;
  for (const PathElement& e : path) {
    if (s < e.length) return e.curvature;
    s -= e.length;
  }
  return 0;
}

PathProjection project(const Path& path, const Vec2& p, double from, double to) {
  SKEIN_CHECK(!path.empty());
  const double total = length(path);
  from = std::clamp(from, 0.0, total);
  to = std::clamp(to, from, total);

  double best = std::numeric_limits<double>::infinity();
  PathProjection nearest;
  double start = 0;  // of the element, along the path
  for (const PathElement& e : path) {
    const double low = std::max(from - start, 0.0);
    const double high = std::min(to - start, e.length);
    if (low <= high) {
      const double s = nearest_on(e, p, low, high);
      const Pose pose = pose_at(e, s);
      const double distance2 = (p - pose.position).squaredNorm();
      if (distance2 < best) {
        best = distance2;
        nearest.along = start + s;
        nearest.course = pose.course;
        nearest.curvature = e.curvature;
        nearest.cross_track = geo::cross(geo::unit(pose.course), p - pose.position);
      }
    }
    start += e.length;
  }
  nearest.remaining = total - nearest.along;
  return nearest;
}

}  // namespace skein::model
