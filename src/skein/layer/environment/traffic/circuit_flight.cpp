// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/traffic/circuit_flight.h"

#include <algorithm>
#include <cmath>

namespace skein::environment {
namespace {

double leg(double side, const CircuitOptions& options) {
  return std::max(0.0, side - 2 * options.turn_radius);
}

double circuit_length(const CircuitOptions& o) {
  return 2 * leg(o.length, o) + 2 * leg(o.width, o) + 2 * geo::kPi * o.turn_radius;
}

// The end of an arc or a straight line of this length.
Vec2 moved(const Vec2& begin, double course, double curvature, double length) {
  if (curvature == 0) return begin + length * geo::unit(course);
  return begin +
         1 / curvature *
             geo::turned_left(geo::unit(course + curvature * length) - geo::unit(course));
}

}  // namespace

double circuit_lacks(const CircuitOptions& o) {
  return o.height / o.climb + o.height / o.descent - circuit_length(o) / o.speed;
}

CircuitFlight::CircuitFlight(const Vec3& begin, const CircuitOptions& options,
                             double share)
    : options_(options), altitude_(-begin.z()) {
  const double bend =
      (options.side == CircuitSide::kRight ? 1 : -1) / options.turn_radius;
  const double corner = geo::kPi / 2 * options.turn_radius;
  pieces_.push_back({0, geo::horizontal(begin), options.course, 0});
  for (int k = 0; k < 4; ++k) {
    add(leg(k % 2 == 0 ? options.length : options.width, options), bend);
    add(corner, 0);
  }
  pieces_.pop_back();  // where it begins again
  flown_ = share * length_;
  advance({});
}

// Ends the last piece after a length; the next one bends as said.
void CircuitFlight::add(double length, double curvature) {
  const Piece& last = pieces_.back();
  length_ += length;
  pieces_.push_back({length_, moved(last.begin, last.course, last.curvature, length),
                     last.course + last.curvature * length, curvature});
}

void CircuitFlight::advance(const TrafficView& view) {
  const double along = std::fmod(flown_ + options_.speed * view.now.seconds(), length_);
  const auto next = std::upper_bound(
      pieces_.begin(), pieces_.end(), along,
      [](double distance, const Piece& piece) { return distance < piece.from; });
  const Piece& piece = *std::prev(next);
  const double gone = along - piece.from;
  const Vec2 place = moved(piece.begin, piece.course, piece.curvature, gone);
  const Vec2 ahead = geo::unit(piece.course + piece.curvature * gone);
  const double climbed = options_.climb * along / options_.speed;
  const double to_descend = options_.descent * (length_ - along) / options_.speed;
  const double height = std::min({climbed, to_descend, options_.height});
  double climb = 0;
  if (options_.height > 0 && height < options_.height)
    climb = climbed < to_descend ? options_.climb : -options_.descent;
  state_.p_N = {place.x(), place.y(), -(altitude_ + height)};
  state_.v_N = {options_.speed * ahead.x(), options_.speed * ahead.y(), -climb};
}

}  // namespace skein::environment
