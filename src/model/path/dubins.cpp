#include "model/path/dubins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/path/path_geometry.h"

namespace skein::model {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Rounding of the angles is about 1e-15; the positions' enters divided by the distance
// of the turning centres. Turns this near to a full one are none.
constexpr double kFullTurnSnap = 1e-9;

struct Turns {
  double first, last;  // +1 right, -1 left
  bool straight;       // in the middle; otherwise a turn against the others
};

Turns turns_of(DubinsWord word) {
  switch (word) {
    case DubinsWord::kLSL:
      return {-1, -1, true};
    case DubinsWord::kLSR:
      return {-1, +1, true};
    case DubinsWord::kRSL:
      return {+1, -1, true};
    case DubinsWord::kRSR:
      return {+1, +1, true};
    case DubinsWord::kLRL:
      return {-1, -1, false};
    case DubinsWord::kRLR:
      return {+1, +1, false};
  }
  return {};
}

// Angle of a turn in direction `side` (+1 right) from course `a` to course `b`.
double turn_angle(double side, double a, double b) {
  const double angle = geo::wrap_2pi(side * (b - a));
  return angle > 2 * geo::kPi - kFullTurnSnap ? 0 : angle;
}

Vec2 turn_centre(const Pose& pose, double side, double radius) {
  return pose.position + side * radius * geo::turned_right(geo::unit(pose.course));
}

}  // namespace

DubinsPath dubins_word(DubinsWord word, const Pose& from, const Pose& to, double radius) {
  const Turns turns = turns_of(word);
  const Vec2 between =
      (turn_centre(to, turns.last, radius) - turn_centre(from, turns.first, radius)) /
      radius;
  const double distance = between.norm();
  // Centres that all but coincide have no direction of their own; the first turn may then
  // end anywhere, so let it be the whole turn.
  const bool same_circle = distance < 1e-12;
  const double axis = same_circle ? from.course : geo::bearing(between);
  DubinsPath path{word, {kInfinity, 0, 0}, radius};

  if (!turns.straight) {
    if (distance > 4) return path;
    // The middle circle touches both others: an isosceles triangle with sides 2, 2, d.
    const double half = std::acos(std::clamp(distance / 4, 0.0, 1.0));
    // The middle arc is over pi when its centre lies on the axis' side of the outer
    // turns. Where circles touch, the course is across the line between their centres.
    const double side = turns.first;
    const double to_middle = axis + side * half;
    const double from_middle =
        axis + geo::kPi - side * half;  // last centre to middle centre
    const double course1 = to_middle + side * geo::kPi / 2;
    const double course2 = from_middle + side * geo::kPi / 2;
    path.parts = {turn_angle(side, from.course, course1),
                  turn_angle(-side, course1, course2),
                  turn_angle(side, course2, to.course)};
    return path;
  }
  if (turns.first == turns.last) {
    const double course = axis;
    path.parts = {turn_angle(turns.first, from.course, course), distance,
                  turn_angle(turns.last, course, to.course)};
    if (same_circle) path.parts = {turn_angle(turns.first, from.course, to.course), 0, 0};
    return path;
  }
  if (distance < 2 - 1e-12) return path;  // touching circles may overlap by rounding
  const double straight = std::sqrt(std::max(0.0, distance * distance - 4));
  const double course = axis + turns.first * std::atan2(2, straight);
  path.parts = {turn_angle(turns.first, from.course, course), straight,
                turn_angle(turns.last, course, to.course)};
  return path;
}

DubinsPath dubins(const Pose& from, const Pose& to, double radius) {
  DubinsPath best{DubinsWord::kLSL, {kInfinity, 0, 0}, radius};
  for (const DubinsWord word : kDubinsWords) {
    const DubinsPath path = dubins_word(word, from, to, radius);
    if (path.length() < best.length()) best = path;
  }
  return best;
}

Path to_path(const DubinsPath& dubins, const Pose& from) {
  const Turns turns = turns_of(dubins.word);
  const std::array<double, 3> sides = {turns.first, turns.straight ? 0 : -turns.first,
                                       turns.last};
  Path path;
  Pose pose = from;
  for (std::size_t i = 0; i < 3; ++i) {
    if (dubins.parts[i] <= 0) continue;
    path.push_back({pose.position, pose.course, dubins.parts[i] * dubins.radius,
                    sides[i] / dubins.radius});
    pose = end_of(path.back());
  }
  return path;
}

}  // namespace skein::model
