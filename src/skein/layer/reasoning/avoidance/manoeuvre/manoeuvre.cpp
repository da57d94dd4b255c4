// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/manoeuvre/manoeuvre.h"

#include <cmath>

namespace skein::reasoning {
namespace {

constexpr std::array kAside = {0.6, 1.2, 2.0, 3.2, 4.8};  // times the separation
constexpr std::array kHeights = {1.15, 2.2, 3.3, 4.5, 6.0};
constexpr std::array kLeads = {12.0, 25.0, 50.0};  // [s]
constexpr std::array kSpeeds = {0.82, 0.9, 1.1, 1.18};

double as_sent(double number) {
  return static_cast<float>(number);
}

}  // namespace

std::vector<Manoeuvre> manoeuvres(const FlightLimits& limits,
                                  const Separation& separation, double strength) {
  std::vector<Manoeuvre> all = {{ManoeuvreKind::kGoOn}, {ManoeuvreKind::kDirect}};
  for (const ManoeuvreKind side : {ManoeuvreKind::kRight, ManoeuvreKind::kLeft})
    for (const double aside : kAside)
      for (const double lead : kLeads)
        all.push_back({side, as_sent(aside * separation.horizontal * strength), lead});
  for (const ManoeuvreKind sense : {ManoeuvreKind::kUp, ManoeuvreKind::kDown})
    for (const double height : kHeights)
      all.push_back({sense, as_sent(height * separation.vertical * strength)});
  for (const double factor : kSpeeds) {
    // The curve through a plan's points is a quarter of a change of speed beyond it.
    const double airspeed = factor * limits.airspeed;
    const double beyond = std::abs(airspeed - limits.airspeed) / 4;
    if (airspeed - beyond >= limits.slowest && airspeed + beyond <= limits.fastest)

      all.push_back({ManoeuvreKind::kSpeed, as_sent(factor)});
  }
  return all;
}

}  // namespace skein::reasoning
