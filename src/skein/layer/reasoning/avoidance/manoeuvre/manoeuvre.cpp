#include "skein/layer/reasoning/avoidance/manoeuvre/manoeuvre.h"

namespace skein::reasoning {
namespace {

constexpr std::array kAside = {30.0, 60.0, 100.0, 160.0, 240.0};  // [m]
constexpr std::array kLeads = {12.0, 25.0, 50.0};                 // [s]
constexpr std::array kHeights = {23.0, 44.0, 66.0};               // [m]
constexpr std::array kSpeeds = {0.76, 0.88, 1.12, 1.24};

}  // namespace

std::vector<Manoeuvre> manoeuvres(const FlightLimits& limits, double strength) {
  std::vector<Manoeuvre> all = {{ManoeuvreKind::kGoOn}, {ManoeuvreKind::kDirect}};
  for (const ManoeuvreKind side : {ManoeuvreKind::kRight, ManoeuvreKind::kLeft})
    for (const double aside : kAside)
      for (const double lead : kLeads) all.push_back({side, aside * strength, lead});
  for (const ManoeuvreKind sense : {ManoeuvreKind::kUp, ManoeuvreKind::kDown})
    for (const double height : kHeights) all.push_back({sense, height * strength});
  for (const double factor : kSpeeds) {
    const double airspeed = factor * limits.airspeed;
    if (airspeed >= limits.slowest && airspeed <= limits.fastest)
      all.push_back({ManoeuvreKind::kSpeed, factor});
  }
  return all;
}

}  // namespace skein::reasoning
