// SPDX-License-Identifier: Apache-2.0
#include "app/plan/separation/separation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "skein/base/math.h"

namespace skein::separation {
namespace {

// A flight as it is looked at.
struct Track {
  const FlightPlan* plan = nullptr;
  std::size_t number = 0;
  double begin = 0, end = 0;  // [s]
  double speed = 0;           // over ground and up or down together, at most [m/s]
  double climb = 0;           // up or down at most [m/s]
};

Track track_of(const FlightPlan& plan, std::size_t number) {
  Track track{&plan, number, plan.front().start, plan.back().start + plan.back().duration,
              0,     0};
  for (const FlightElement& e : plan) {
    const double end_climb = e.climb_rate + e.climb_acceleration * e.duration;
    const double climb = std::max(std::abs(e.climb_rate), std::abs(end_climb));
    track.climb = std::max(track.climb, climb);
    track.speed = std::max(track.speed, e.airspeed + e.wind.norm() + climb);
  }
  return track;
}

// Where a flight is: from the begin of the element along the chord of the turn through
// the air, in the direction that the nose has half-way, and with the wind.
Vec3 place_at(const Track& track, double time) {
  const FlightPlan& plan = *track.plan;
  const auto later =
      std::upper_bound(plan.begin(), plan.end(), time,
                       [](double t, const FlightElement& e) { return t < e.start; });
  const FlightElement& e = later == plan.begin() ? *later : *(later - 1);
  const double t = std::clamp(time - e.start, 0.0, e.duration);
  const double half_turn = e.turn_rate * t / 2;
  const double chord = std::abs(half_turn) < 1e-6
                           ? e.airspeed * t
                           : e.airspeed * t * math::sin(half_turn) / half_turn;
  const double direction = e.heading + half_turn;
  return {e.p_N.x() + chord * math::cos(direction) + e.wind.x() * t,
          e.p_N.y() + chord * math::sin(direction) + e.wind.y() * t,
          e.p_N.z() - (e.climb_rate + e.climb_acceleration * t / 2) * t};
}

class Look {
 public:
  explicit Look(const SeparationOptions& options) : options_(options) {
    nearest_room_.distance = kRoomsLookedAt * options.zone.across;
    nearest_.distance = std::numeric_limits<double>::infinity();
  }

  void look_at(const Track& a, const Track& b) {
    ++found_.pairs;
    same_time(a, b);
    const bool a_in_b = room(a, b), b_in_a = room(b, a);
    found_.pairs_in_rooms += a_in_b || b_in_a ? 1 : 0;
  }
  Separation found() const {
    Separation out = found_;
    if (std::isfinite(nearest_.distance)) out.nearest = nearest_;
    if (nearest_room_.a != nearest_room_.b) out.nearest_room = nearest_room_;
    return out;
  }

 private:
  void same_time(const Track& a, const Track& b);
  bool room(const Track& a, const Track& b);
  double level_distance(const Vec3& p, const Track& b, double from, double until) const;

  const SeparationOptions& options_;
  Separation found_;
  NearestPair nearest_, nearest_room_;
};

// The time after `t`: by at least a step, and as long as nothing nearer can come.
double after(double t, double slack, double speed, double step) {
  return t + std::max(step, slack / speed);
}

void Look::same_time(const Track& a, const Track& b) {
  const double begin = std::max(a.begin, b.begin), end = std::min(a.end, b.end);
  for (double t = begin; t <= end;) {
    const double distance = (place_at(a, t) - place_at(b, t)).norm();
    if (distance < nearest_.distance) nearest_ = {a.number, b.number, t, distance};
    if (t == end) return;
    t = std::min(
        end, after(t, distance - nearest_.distance, a.speed + b.speed, options_.step));
  }
}

// Whether a comes into b's room.
bool Look::room(const Track& a, const Track& b) {
  const SafetyZone& zone = options_.zone;
  const double within = zone.across - options_.tolerance;
  const double begin = std::max(a.begin, b.begin - zone.ahead);
  const double end = std::min(a.end, b.end + zone.behind);
  bool inside = false;
  for (double t = begin; t <= end;) {
    const Vec3 p = place_at(a, t);
    // b's times that count, and where it is at the one that is nearest to now.
    const double from = std::max(b.begin, t - zone.behind);
    const double until = std::min(b.end, t + zone.ahead);
    const double now = std::clamp(t, from, until);
    const double reach = std::max(now - from, until - now);
    const Vec3 away = p - place_at(b, now);
    // At none of these times is b in a's height, or near enough to count, while these
    // are positive.
    const double counts = std::max(nearest_room_.distance, within);
    const double up = std::abs(away.z()) - b.climb * reach - options_.height;
    const double level = away.norm() - b.speed * reach - options_.height - counts;
    double next = t + options_.step;
    if (up > 0 || level > 0) {
      const double climbs = a.climb + b.climb, speeds = a.speed + b.speed;
      const double vertical = up > 0 ? up / std::max(climbs, 1e-9) : 0;
      next = std::max({next, t + vertical, t + std::max(level, 0.0) / speeds});
    } else {
      const double distance = level_distance(p, b, from, until);
      inside = inside || distance < within;
      if (distance < nearest_room_.distance)
        nearest_room_ = {a.number, b.number, t, distance};
    }
    if (t == end) break;
    t = std::min(end, next);
  }
  return inside;
}

// From a place to where b is between two times and within the room's height.
double Look::level_distance(const Vec3& p, const Track& b, double from,
                            double until) const {
  double least = std::numeric_limits<double>::infinity();
  const auto steps = static_cast<std::int64_t>(std::ceil((until - from) / options_.step));
  for (std::int64_t i = 0; i <= steps; ++i) {
    const double t = std::min(until, from + static_cast<double>(i) * options_.step);
    const Vec3 away = p - place_at(b, t);
    if (std::abs(away.z()) <= options_.height)
      least = std::min(least, away.head<2>().norm());
  }
  return least;
}

}  // namespace

Separation separation_of(std::span<const FlightPlan> flights,
                         const SeparationOptions& options) {
  std::vector<Track> tracks;
  for (std::size_t i = 0; i < flights.size(); ++i)
    if (!flights[i].empty()) tracks.push_back(track_of(flights[i], i));
  Look look(options);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (options.stop && options.stop()) break;
    for (std::size_t k = 0; k < i; ++k) look.look_at(tracks[k], tracks[i]);
  }
  return look.found();
}

}  // namespace skein::separation
