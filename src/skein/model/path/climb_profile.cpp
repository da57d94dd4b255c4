// SPDX-License-Identifier: Apache-2.0
#include "skein/model/path/climb_profile.h"

#include <algorithm>
#include <cmath>

#include "skein/base/math.h"
#include "skein/model/path/flight_plan.h"

namespace skein::model {
namespace {

// Pieces shorter than this part of the whole are none.
constexpr double kNoTime = 1e-12;

// Up to a rate, on with it, and level again; altogether `time`.
ClimbProfile with_vertical_turns(double rate, double ramp, double time) {
  if (ramp <= kNoTime * time) return {{time, rate, 0}};
  const double acceleration = rate / ramp;
  ClimbProfile profile = {{ramp, 0, acceleration}};
  if (const double even = time - 2 * ramp; even > kNoTime * time)
    profile.push_back({even, rate, 0});
  profile.push_back({ramp, rate, -acceleration});
  return profile;
}

}  // namespace

double climb_time(double height, double rate, double acceleration) {
  if (height == 0) return 0;
  if (!(rate > 0)) return math::kInfinity;
  if (acceleration == 0) return height / rate;
  return height * acceleration >= rate * rate ? height / rate + rate / acceleration
                                              : 2 * std::sqrt(height / acceleration);
}

ClimbProfile even_climb(double climb, double time, double acceleration) {
  if (climb == 0 || !(time > 0)) return {};
  if (acceleration == 0) return {{time, climb / time, 0}};
  // Height = rate (time - rate / acceleration); half of the time is for ramps at most.
  const double least = 4 * std::abs(climb) / (time * time);
  const double a = std::max(acceleration, least);
  const double root = std::sqrt(std::max(0.0, 1 - least / a));
  const double rate = 2 * climb / (time * (1 + root));
  return with_vertical_turns(rate, std::min(std::abs(rate) / a, time / 2), time);
}

ClimbProfile quickest_climb(double climb, double rate, double acceleration) {
  const double time = climb_time(std::abs(climb), rate, acceleration);
  if (!std::isfinite(time)) return {};
  return even_climb(climb, time, acceleration);
}

FlightPlan climbing(const FlightPlan& plan, double down, const ClimbProfile& profile) {
  FlightPlan out;
  out.reserve(plan.size() + profile.size());
  std::size_t k = 0;  // the piece of the profile
  double passed = 0;  // of that piece [s]
  for (const FlightElement& element : plan) {
    double done = 0;  // of the element [s]
    const double no_time = kNoTime * std::max(1.0, element.duration);
    while (element.duration - done > no_time) {
      const bool climbs = k < profile.size();
      const ClimbPiece piece = climbs ? profile[k] : ClimbPiece();
      const double left = element.duration - done;
      const double rest = climbs ? piece.duration - passed : left;
      const bool ends = climbs && rest <= left + no_time;
      FlightElement part = element;
      if (done > 0) {
        const FlightMoment there = moment(element, done);
        part.p_N = there.p_N;
        part.heading = there.heading;
        part.start = element.start + done;
      }
      part.duration = left - rest > no_time ? rest : left;
      part.p_N.z() = down;
      part.climb_rate = piece.rate + piece.acceleration * passed;
      part.climb_acceleration = piece.acceleration;
      down = position(part, part.duration).z();
      passed = ends ? 0 : passed + part.duration;
      if (ends) ++k;
      done += part.duration;
      if (part.duration > 0) out.push_back(part);
    }
  }
  return out;
}

}  // namespace skein::model
