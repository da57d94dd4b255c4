// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/dubins.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/model/path/direction.h"
#include "skein/model/path/path_geometry.h"

namespace skein::model {
namespace {

// Turns this near to a full one are none: rounding of the angles is about 1e-15, that of
// the positions enters divided by the distance of the turning centres.
constexpr double kFullTurnSnap = 1e-11;
constexpr double kTurn = 2 * geo::kPi;
constexpr double kSameCircle = 1e-12;  // centres this near have no direction [radii]
constexpr double kTouching = 1e-12;    // squared distance by which circles may overlap

// Everything below is in turn radii, seen from the start, whose course is the x axis;
// turns are counted positive, so that words beginning with the other turn are mirror
// images.
struct Reduced {
  double x, y;  // of the goal
  double phi;   // course there, in [0, 2 pi)
  double sine, cosine;

  Reduced mirrored() const { return {x, -y, phi == 0 ? 0 : kTurn - phi, -sine, cosine}; }
};

// `angle` less whole turns, in [0, 2 pi).
double positive_turn(double angle) {
  const double turns = angle * (1 / kTurn), nearest = nearest_whole(turns);
  const double a = angle - kTurn * (nearest > turns ? nearest - 1 : nearest);
  return a > kTurn - kFullTurnSnap ? 0 : a;
}

// From the first turning centre to the last.
struct Centres {
  double x, y, distance2;
};
Centres equal_centres(const Reduced& g) {
  const double x = g.x - g.sine, y = g.y + g.cosine - 1;
  return {x, y, x * x + y * y};
}
Centres opposite_centres(const Reduced& g) {
  const double x = g.x + g.sine, y = g.y - g.cosine - 1;
  return {x, y, x * x + y * y};
}

// Two equal turns turn by phi, or by a full turn more when the straight's direction is
// not passed in between. Asked without an angle function.
double equal_length(const Reduced& g, const Centres& c, double straight) {
  if (straight < kSameCircle) return straight + g.phi;
  const double slack = -kFullTurnSnap * straight;
  const double after_start = c.y, before_end = c.x * g.sine - c.y * g.cosine;
  const double ahead = c.x * (1 + g.cosine) + c.y * g.sine;
  const bool passed = g.phi <= geo::kPi
                          ? after_start >= slack && before_end >= slack && ahead >= slack
                          : !(after_start < slack && before_end < slack);
  return straight + g.phi + (passed ? 0 : kTurn);
}

std::array<double, 3> equal_parts(const Reduced& g, const Centres& c, double straight,
                                  double length) {
  const double turns = length - straight;
  if (straight < kSameCircle) return {g.phi, straight, 0};
  const double first = std::min(positive_turn(direction(c.x, c.y)), turns);
  return {first, straight, turns - first};
}

struct Best {
  double length = math::kInfinity;
  DubinsWord word = DubinsWord::kLSL;
  std::array<double, 3> parts{};

  void take(DubinsWord tried, const std::array<double, 3>& with) {
    const double sum = with[0] + with[1] + with[2];
    if (sum < length) *this = {sum, tried, with};
  }
};

void try_opposite(const Reduced& g, DubinsWord word, Best& best) {
  const Centres c = opposite_centres(g);
  if (c.distance2 < 4 - kTouching) return;
  const double straight = std::sqrt(std::max(0.0, c.distance2 - 4));
  // One turn undoes the other but for phi.
  if (straight + std::min(g.phi, kTurn - g.phi) >= best.length) return;
  const double course = direction(straight * c.x - 2 * c.y, straight * c.y + 2 * c.x);
  best.take(word, {positive_turn(course), straight, positive_turn(course - g.phi)});
}

void try_turns(const Reduced& g, const Centres& c, DubinsWord word, Best& best) {
  // The middle circle touches both others: an isosceles triangle with sides 2, 2, d.
  if (c.distance2 > 16) return;
  const double distance = std::sqrt(c.distance2);
  // acos x >= sqrt(2 - 2 x), which is quicker.
  if (geo::kPi + 2 * std::sqrt(2 - distance / 2) >= best.length) return;
  const double half = direction(distance, std::sqrt(16 - c.distance2));
  const double middle = geo::kPi + 2 * half;
  const double axis = direction(c.x, c.y);
  const double first = positive_turn(axis + half + geo::kPi / 2);
  if (first + middle >= best.length) return;
  best.take(word, {first, middle, positive_turn(g.phi - axis + half + geo::kPi / 2)});
}

}  // namespace

DubinsPath dubins(const Pose& from, const Pose& to, double radius) {
  const Vec2 start = geo::unit(from.course), end = geo::unit(to.course);
  const Vec2 offset = (to.position - from.position) / radius;
  const Reduced right{start.dot(offset), geo::cross(start, offset),
                      positive_turn(to.course - from.course), geo::cross(start, end),
                      start.dot(end)};
  const Reduced left = right.mirrored();
  const Centres rights = equal_centres(right), lefts = equal_centres(left);
  const double straight_right = std::sqrt(rights.distance2);
  const double straight_left = std::sqrt(lefts.distance2);
  const double rsr = equal_length(right, rights, straight_right);
  const double lsl = equal_length(left, lefts, straight_left);

  Best best;
  best.length = std::min(rsr, lsl);
  const double equal = best.length;
  try_opposite(right, DubinsWord::kRSL, best);
  try_opposite(left, DubinsWord::kLSR, best);
  try_turns(right, rights, DubinsWord::kRLR, best);
  try_turns(left, lefts, DubinsWord::kLRL, best);
  if (best.length < equal) return {best.word, best.parts, radius};
  if (rsr <= lsl)
    return {DubinsWord::kRSR, equal_parts(right, rights, straight_right, rsr), radius};
  return {DubinsWord::kLSL, equal_parts(left, lefts, straight_left, lsl), radius};
}

std::array<int, 3> sides_of(DubinsWord word) {
  constexpr std::array<std::array<int, 3>, 6> kSides = {
      {{-1, 0, -1}, {-1, 0, +1}, {+1, 0, -1}, {+1, 0, +1}, {-1, +1, -1}, {+1, -1, +1}}};
  return kSides[static_cast<std::size_t>(word)];
}

std::string_view name_of(DubinsWord word) {
  constexpr std::array<std::string_view, 6> kNames = {"LSL", "LSR", "RSL",
                                                      "RSR", "LRL", "RLR"};
  return kNames[static_cast<std::size_t>(word)];
}

Path to_path(const DubinsPath& dubins, const Pose& from) {
  const std::array<int, 3> sides = sides_of(dubins.word);
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
