// SPDX-License-Identifier: Apache-2.0
#include "skein/exchange/plan/samples.h"

#include <algorithm>
#include <cmath>

#include "skein/base/check.h"
#include "skein/base/math.h"

namespace skein::exchange {
namespace {

int pieces_of(const FlightElement& e, double tolerance, double longest) {
  const double bend =  // [m/s^2]
      math::hypot(e.airspeed * e.turn_rate, e.climb_acceleration);
  const double per_second = std::max(std::sqrt(bend / (8 * tolerance)), 1 / longest);
  // A hair less, so that what divides evenly does not get one more for rounding.
  return std::max(1, static_cast<int>(std::ceil(e.duration * per_second - 1e-9)));
}

}  // namespace

std::vector<FlightSample> samples(const FlightElement& e, double tolerance,
                                  double longest) {
  SKEIN_CHECK(tolerance > 0 && longest > 0, tolerance, longest);
  const int pieces = pieces_of(e, tolerance, longest);
  std::vector<FlightSample> all;
  for (int i = 0; i <= pieces; ++i) {
    const double t = e.duration * i / pieces;
    all.push_back({0, e.start + t, model::moment(e, t)});
  }
  return all;
}

std::vector<FlightSample> samples(const FlightPlan& plan, double tolerance,
                                  double longest) {
  std::vector<FlightSample> all;
  for (std::size_t k = 0; k < plan.size(); ++k) {
    if (!all.empty()) all.pop_back();
    for (FlightSample& each : samples(plan[k], tolerance, longest)) {
      each.element = k;
      all.push_back(each);
    }
  }
  return all;
}

const char* kind_of(const FlightElement& element) {
  if (element.turn_rate != 0) return element.turn_rate > 0 ? "right turn" : "left turn";
  if (element.climb_acceleration == 0) return "straight";
  return element.climb_acceleration > 0 ? "vertical turn up" : "vertical turn down";
}

}  // namespace skein::exchange
