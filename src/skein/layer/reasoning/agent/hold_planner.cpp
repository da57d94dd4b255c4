// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/hold_planner.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "skein/layer/reasoning/agent/expected_flight.h"
#include "skein/layer/reasoning/trajectory/steering_flight.h"

namespace skein::reasoning {
namespace {

constexpr Separation kMore{8, 3};     // kept between places to stay, besides [m]
constexpr double kLevelsApart = 1.5;  // of the vertical separation, where nobody is near
constexpr double kLowest = 40;        // above the ground [m]
constexpr int kDirections = 8;
constexpr std::array kLevels = {1, -1, 2, -2};
constexpr std::array kRadii = {1.0, 2.0, 3.0, 5.0};
constexpr double kNearRadii = 2;  // those of other levels

// A circle that might be flown: how far from the one that is asked for.
struct Shift {
  Vec2 aside = Vec2::Zero();  // [m]
  int levels = 0;
};

std::vector<Shift> shifts(double radius, double heading) {
  std::vector<Shift> all{{}};
  for (const int level : kLevels) all.push_back({Vec2::Zero(), level});
  const auto around = [&](double distance, int level) {
    // At first to the right, the way in which circles are flown.
    for (int k = 0; k < kDirections; ++k)
      all.push_back(
          {distance * geo::unit(heading + geo::kPi / 2 + 2 * geo::kPi * k / kDirections),
           level});
  };
  for (const double radii : kRadii) around(radii * radius, 0);
  for (const double radii : kRadii)
    for (const int level : {1, -1})
      if (radii <= kNearRadii) around(radii * radius, level);
  return all;
}

// Of two levels between which all that stay there are apart.
double level_step(const std::vector<HeldCircle>& circles, double vertical) {
  double step = kLevelsApart * vertical;
  for (const HeldCircle& each : circles)
    step = std::max(step, each.separation.vertical + kMore.vertical + 1);
  return step;
}

bool is_apart(const FlightPlan& flight, const std::vector<HeldCircle>& circles) {
  const auto own = circle_at_end(flight);
  if (!own) return true;
  return std::ranges::all_of(circles, [&](const HeldCircle& other) {
    return are_apart(*own, other,
                     {other.separation.horizontal + kMore.horizontal,
                      other.separation.vertical + kMore.vertical});
  });
}

}  // namespace

Circling place_to_hold(const Circling& requested, const NavEstimate& from, double begin,
                       const HoldSituation& situation, FlightCheck& check) {
  const FlightContext& context = situation.context;
  const std::vector<HeldCircle> circles =
      situation.separator.circles_of_others(situation.now);
  const double step = level_step(circles, situation.separator.kept().vertical);
  const double radius = wide_radius(context.limits, from.wind_N);
  std::optional<Circling> free, apart;
  // @returns whether it is free and apart from the circles of all others.
  const auto is_good = [&](const Circling& place) {
    const FlightPlan flight =
        expected_flight({0, place}, 0, from, context, begin, situation.duration).plan;
    if (flight.empty()) return false;
    const bool is_free = !situation.separator.meets(flight, situation.now, kMore);
    const bool stays_apart = is_apart(flight, circles);
    if ((!is_free && !stays_apart) || !check.is_free(flight)) return false;
    if (is_free && stays_apart) return true;
    auto& second_best = is_free ? free : apart;
    if (!second_best) second_best = place;
    return false;
  };
  if (situation.before && is_good(*situation.before)) return *situation.before;
  for (const Shift& shift : shifts(radius, from.heading)) {
    Circling place = requested;
    place.centre += shift.aside;
    if (shift.levels != 0) {
      const double ground = context.map->elevation_msl(place.centre);
      place.altitude_msl =
          requested.altitude_msl.value_or(ground + context.altitude_agl) +
          shift.levels * step;
      if (*place.altitude_msl < ground + kLowest) continue;
    }
    if (is_good(place)) return place;
  }
  return free.value_or(apart.value_or(requested));
}

}  // namespace skein::reasoning
