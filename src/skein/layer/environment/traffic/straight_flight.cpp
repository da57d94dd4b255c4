// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/environment/traffic/straight_flight.h"

namespace skein::environment {

StraightFlight::StraightFlight(const Vec3& begin, const StraightFlightOptions& options)
    : speed_(options.speed) {
  pieces_.push_back({0, begin, options.course, 0, options.climb});
  for (const TurnAside& aside : options.asides) {
    const double climb = aside.climb.value_or(pieces_.back().climb);
    add(aside.from, aside.turn_rate, climb);
    add(aside.from + aside.length, 0, climb);
  }
  advance({});
}

void StraightFlight::add(double time, double turn_rate, double climb) {
  Piece next = after(pieces_.back(), time);
  next.turn_rate = turn_rate;
  next.climb = climb;
  pieces_.push_back(next);
}

StraightFlight::Piece StraightFlight::after(const Piece& piece, double time) const {
  const double dt = time - piece.from;
  Piece next = piece;
  next.from = time;
  next.course += piece.turn_rate * dt;
  Vec2 gone = speed_ * dt * geo::unit(piece.course);
  if (piece.turn_rate != 0)
    gone = speed_ / piece.turn_rate *
           geo::turned_left(geo::unit(next.course) - geo::unit(piece.course));
  next.p_N += Vec3(gone.x(), gone.y(), -piece.climb * dt);
  return next;
}

void StraightFlight::advance(const TrafficView& view) {
  const double now = view.now.seconds();
  while (piece_ + 1 < pieces_.size() && pieces_[piece_ + 1].from <= now) ++piece_;
  const Piece here = after(pieces_[piece_], now);
  const Vec2 along = speed_ * geo::unit(here.course);
  state_.p_N = here.p_N;
  state_.v_N = {along.x(), along.y(), -here.climb};
}

}  // namespace skein::environment
