// SPDX-License-Identifier: Apache-2.0
#include "skein/solve/path/test/independent_flights.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <vector>

namespace independent {
namespace {

Point centre_of(Pose pose, int side, Real radius) {
  return pose.at + side * radius * right_of(unit(pose.heading));
}

void keep_shorter(Word& best, std::array<int, 3> turn, std::array<Real, 3> part) {
  const Real length = part[0] + part[1] + part[2];
  if (length < best.length) best = {turn, part, length};
}

void try_straight_between(Word& best, Pose from, Pose to, Real radius, int first,
                          int last) {
  const Point apart = centre_of(to, last, radius) - centre_of(from, first, radius);
  const Real q = (last - first) * radius, square = dot(apart, apart) - q * q;
  if (square < 0) return;
  const Real along = std::sqrt(square);
  Real course = from.heading;  // where the circles are one
  if (dot(apart, apart) > 0) {
    const Point u = along * apart - q * right_of(apart);
    course = std::atan2(u.y, u.x);
  }
  keep_shorter(best, {first, 0, last},
               {radius * wrapped(first * (course - from.heading)), along,
                radius * wrapped(last * (to.heading - course))});
}

void try_three_turns(Word& best, Pose from, Pose to, Real radius, int side) {
  const Point a = centre_of(from, side, radius), b = centre_of(to, side, radius);
  const Real d = length(b - a);
  if (d > 4 * radius || d == 0) return;
  const Real bearing = std::atan2((b - a).y, (b - a).x),
             wide = std::acos(d / (4 * radius));
  for (const int k : {1, -1}) {
    // The middle circle touches both; heading where two circles touch.
    const Point middle = a + 2 * radius * unit(bearing + k * wide);
    const Point first = middle - a, last = b - middle;
    const auto heading = [&](Point out) {
      return std::atan2(out.y, out.x) + side * kPi / 2;
    };
    const Real one = heading(first), two = heading(-1 * last);
    keep_shorter(best, {side, -side, side},
                 {radius * wrapped(side * (one - from.heading)),
                  radius * wrapped(-side * (two - one)),
                  radius * wrapped(side * (to.heading - two))});
  }
}

struct Moved {
  Pose pose;
  Real time = 0;
};

// On by a part of a word, with the wind.
Moved moved(const Air& air, Moved from, int turn, Real part, Real radius) {
  const Real time = part / air.speed;
  Pose next = from.pose;
  if (turn == 0) {
    next.at = next.at + part * unit(next.heading);
  } else {
    const Point centre = centre_of(next, turn, radius);
    next.heading += turn * part / radius;
    next.at = centre - turn * radius * right_of(unit(next.heading));
  }
  next.at = next.at + time * air.wind;
  return {next, from.time + time};
}

// Looks at pieces so short that the curve leaves their chords by less than a millimetre.
bool flies_clear(const Field& field, const Air& air, Moved from, int turn, Real part,
                 Real radius) {
  constexpr Real kSag = 1e-3L;
  const Real longest = std::sqrt(8 * radius * kSag);
  const int pieces = turn == 0 ? 1 : static_cast<int>(std::ceil(part / longest)) + 1;
  Point last = from.pose.at;
  for (int i = 1; i <= pieces; ++i) {
    const Point p = moved(air, from, turn, part * i / pieces, radius).pose.at;
    if (!is_clear(field, last, p, turn == 0 ? 0 : -kSag)) return false;
    last = p;
  }
  return true;
}

class Lattice {
 public:
  Lattice(const Field& field, const Air& air, Pose to, Real radius, Real step)
      : field_(field), air_(air), to_(to), radius_(radius), step_(step * radius) {}

  Real search(Pose from, int states) {
    push({from, 0});
    while (!open_.empty() && states-- > 0) {
      const Open next = open_.top();
      open_.pop();
      if (soonest(next.at) >= best_) continue;
      finish(next.at);
      for (const int turn : {0, 1, -1})
        for (const Real part : {step_, step_ / 3}) {
          if (!flies_clear(field_, air_, next.at, turn, part, radius_)) continue;
          push(moved(air_, next.at, turn, part, radius_));
        }
    }
    return best_;
  }

 private:
  struct Open {
    Real rank;
    Moved at;
    bool operator<(const Open& other) const { return rank > other.rank; }
  };

  Real soonest(const Moved& at) const {
    return at.time + straight_time(air_, to_.at - at.pose.at);
  }

  void push(const Moved& at) {
    const auto cell = [](Real x) { return static_cast<std::int64_t>(std::floor(x)); };
    const Real size = step_ / 3;
    Real& known = known_
                      .try_emplace({cell(at.pose.at.x / size), cell(at.pose.at.y / size),
                                    cell(wrapped(at.pose.heading) * radius_ / size)},
                                   kNone)
                      .first->second;
    if (at.time >= known) return;
    known = at.time;
    constexpr Real kHaste = 0.3L;  // what is nearer to the goal is looked at first
    const Real arrival = soonest(at);
    if (arrival < best_) open_.push({arrival + kHaste * (arrival - at.time), at});
  }

  void finish(const Moved& at) {
    const Point left = to_.at - at.pose.at;
    if (length(left) > 4 * radius_ &&
        !independent::is_clear(field_, at.pose.at, to_.at, 0))
      return;
    const auto meeting = earliest_meeting(air_, at.pose, to_, radius_);
    if (!meeting || at.time + meeting->time >= best_) return;
    Moved now = at;
    for (std::size_t i = 0; i < 3; ++i) {
      const int turn = meeting->word.turn[i];
      const Real part = meeting->word.part[i];
      if (!flies_clear(field_, air_, now, turn, part, radius_)) return;
      now = moved(air_, now, turn, part, radius_);
    }
    if (length(now.pose.at - to_.at) < 1e-6L * radius_) best_ = now.time;
  }

  const Field& field_;
  const Air& air_;
  Pose to_;
  Real radius_, step_, best_ = kNone;
  std::priority_queue<Open> open_;
  std::map<std::array<std::int64_t, 3>, Real> known_;
};

}  // namespace

Word shortest_word(Pose from, Pose to, Real radius) {
  Word best;
  best.length = kNone;
  for (const int first : {1, -1}) {
    for (const int last : {1, -1})
      try_straight_between(best, from, to, radius, first, last);
    try_three_turns(best, from, to, radius, first);
  }
  return best;
}

std::optional<Meeting> earliest_meeting(const Air& air, Pose from, Pose to, Real radius) {
  const auto word_at = [&](Real time) {
    return shortest_word(from, {to.at - time * air.wind, to.heading}, radius);
  };
  // Before this time no straight arrives; a word then is at least as long as the time.
  Real low = straight_time(air, to.at - from.at),
       high = std::max(low, radius / air.speed);
  while (word_at(high).length > air.speed * high) {
    low = high;
    high *= 2;
  }
  for (int i = 0; i < 100 && low < high; ++i) {
    const Real middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    (word_at(middle).length > air.speed * middle ? low : high) = middle;
  }
  Meeting meeting{word_at(high), high, true};
  if (std::abs(meeting.word.length - air.speed * high) > 1e-9L * radius) return {};
  // The goal moves along a straight: the least distance from the start.
  const Point apart = to.at - from.at;
  const Real square = dot(air.wind, air.wind);
  const Real nearest =
      square == 0 ? 0 : std::clamp(dot(apart, air.wind) / square, Real(0), high);
  meeting.regular =
      square == 0 || length(apart - nearest * air.wind) > 4 * radius * (1 + 1e-12L);
  return meeting;
}

Real lattice_time(const Field& field, const Air& air, Pose from, Pose to, Real radius,
                  Real step, int states) {
  return Lattice(field, air, to, radius, step).search(from, states);
}

}  // namespace independent
