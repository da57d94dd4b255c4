// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/task/edge/local_edge.h"

#include <Eigen/Cholesky>

#include <algorithm>

#include "skein/base/math.h"

namespace skein::reasoning {
namespace {

constexpr double kMarkSd = 8;    // of a crossing: 20 m between readings / sqrt(12) [m]
constexpr double kForget = 150;  // distance over which that grows e times [m]
constexpr double kCurvatureSd = 0.003;  // of edges: 330 m radius [1/m]
constexpr double kLargest = 1.0 / 120;  // curvature that can be followed at all [1/m]
constexpr double kBehind = 100, kAhead = 200;  // how far the arc is believed [m]

double along_of(const LocalEdge& edge, const Vec2& p) {
  return std::clamp((p - edge.point).dot(geo::unit(edge.course)), -kBehind, kAhead);
}

}  // namespace

double LocalEdge::course_at(const Vec2& p) const {
  return geo::wrap_pi(course + curvature * along_of(*this, p));
}

double LocalEdge::right_of(const Vec2& p) const {
  // From the point of the arc beside p, across the arc there.
  const double s = along_of(*this, p);
  const Vec2 axis = geo::unit(course);
  const Vec2 beside = point + s * axis + curvature * s * s / 2 * geo::turned_right(axis);
  return geo::cross(geo::unit(course + curvature * s), p - beside);
}

LocalEdge fit_edge(const std::deque<Mark>& marks, double course, double course_sd) {
  const Vec2 origin = marks.back().point;
  const Vec2 axis = geo::unit(course);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Vec3 right = Vec3::Zero();
  normal(1, 1) = 1 / math::squared(math::tan(std::min(course_sd, 1.4)));
  normal(2, 2) = 1 / (kCurvatureSd * kCurvatureSd);
  for (const Mark& mark : marks) {
    const Vec2 d = mark.point - origin;
    const double x = d.dot(axis);
    const double y = geo::cross(axis, d);
    const double sd = kMarkSd * math::exp(d.norm() / kForget);
    const Vec3 row{1, x, x * x / 2};
    normal += row * row.transpose() / (sd * sd);
    right += row * (y / (sd * sd));
  }
  const Vec3 fit = normal.ldlt().solve(right);
  LocalEdge edge;
  edge.point = origin + fit[0] * geo::turned_right(axis);
  edge.course = geo::wrap_pi(course + math::atan(fit[1]));
  edge.curvature = std::clamp(fit[2], -kLargest, kLargest);
  return edge;
}

}  // namespace skein::reasoning
