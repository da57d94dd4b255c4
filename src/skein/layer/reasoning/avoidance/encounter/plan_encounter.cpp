// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"

#include <algorithm>
#include <cmath>

#include "skein/layer/reasoning/avoidance/encounter/plan_parts.h"
#include "skein/layer/reasoning/avoidance/encounter/relative_motion.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr double kChordError = 0.03;  // of each flight [m]
constexpr double kJoin = 1e-9;        // spans that are nearer are one [s]

// Largest distance of an element from its chord over a time h [m].
double chord_error(const FlightElement& e, double h) {
  return std::max(e.airspeed * std::abs(e.turn_rate), std::abs(e.climb_acceleration)) *
         h * h / 8;
}

// Fastest up or down [m/s].
double climb_speed(const FlightElement& e) {
  return std::abs(e.climb_rate) + std::abs(e.climb_acceleration) * e.duration;
}

// Two elements in the time that both last, looked at in the order of time.
class Meeting {
 public:
  explicit Meeting(const Separation& separation) : separation_(separation) {}

  // False once the first encounter is over.
  bool look(const FlightElement& a, const FlightElement& b, double begin, double end) {
    return halve(a, b, {begin, at(a, begin), at(b, begin)},
                 {end, at(a, end), at(b, end)});
  }

  std::optional<PlanEncounter> result() const { return found_; }

 private:
  struct Moment {
    double time;
    Vec3 a, b;
    Vec3 apart() const { return b - a; }
  };

  static Vec3 at(const FlightElement& e, double time) {
    return model::position(e, time - e.start);
  }
  bool far(const FlightElement& a, const FlightElement& b, const Moment& begin,
           const Moment& end) const;
  bool halve(const FlightElement& a, const FlightElement& b, const Moment& begin,
             const Moment& end);
  bool take(const Moment& begin, const Moment& end);

  Separation separation_;
  std::optional<PlanEncounter> found_;
};

// Whether they cannot come near between two moments, however they turn there: from each
// of the two they get away by half of the time at most.
bool Meeting::far(const FlightElement& a, const FlightElement& b, const Moment& begin,
                  const Moment& end) const {
  const double h = end.time - begin.time;
  const double speed = a.airspeed + b.airspeed + (a.wind - b.wind).norm();
  const double nearest =
      std::min(begin.apart().head<2>().norm(), end.apart().head<2>().norm());
  if (nearest - speed * h / 2 > separation_.horizontal) return true;
  const double height = std::min(std::abs(begin.apart().z()), std::abs(end.apart().z()));
  return height - (climb_speed(a) + climb_speed(b)) * h / 2 > separation_.vertical;
}

bool Meeting::halve(const FlightElement& a, const FlightElement& b, const Moment& begin,
                    const Moment& end) {
  if (far(a, b, begin, end)) return !found_;
  const double h = end.time - begin.time;
  if (std::max(chord_error(a, h), chord_error(b, h)) <= kChordError)
    return take(begin, end);
  const double middle = begin.time + h / 2;
  const Moment half{middle, at(a, middle), at(b, middle)};
  return halve(a, b, begin, half) && halve(a, b, half, end);
}

bool Meeting::take(const Moment& begin, const Moment& end) {
  const double h = end.time - begin.time;
  if (!(h > 0)) return true;
  const RelativeMotion motion{begin.apart(), (end.apart() - begin.apart()) / h};
  const auto within = time_within(motion, h, separation_);
  if (!within) return !found_;
  if (found_ && begin.time + within->begin > found_->end + kJoin) return false;
  const Closest nearest = closest(motion, *within, separation_);
  if (!found_) found_ = PlanEncounter{begin.time + within->begin, 0, 2, 0};
  found_->end = begin.time + within->end;
  if (nearest.ratio < found_->min_ratio) {
    found_->min_ratio = nearest.ratio;
    found_->closest_time = begin.time + nearest.after;
  }
  return true;
}

}  // namespace

std::optional<PlanEncounter> first_encounter(const FlightPlan& a, const FlightPlan& b,
                                             const Separation& separation, double from,
                                             double until) {
  if (a.empty() || b.empty()) return std::nullopt;
  double time = std::max({from, model::start_of(a), model::start_of(b)});
  Meeting encounter(separation);
  auto one = from_time(a, time), other = from_time(b, time);
  while (one != a.end() && other != b.end() && time < until) {
    const double end = std::min({end_of(*one), end_of(*other), until});
    if (time < end && !encounter.look(*one, *other, time, end)) break;
    time = end;
    if (end_of(*one) <= time) ++one;
    if (other != b.end() && end_of(*other) <= time) ++other;
  }
  return encounter.result();
}

}  // namespace skein::reasoning
