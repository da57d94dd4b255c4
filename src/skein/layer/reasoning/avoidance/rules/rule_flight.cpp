// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/rules/rule_flight.h"

#include <vector>

#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

constexpr std::array kStrengths = {0.4, 0.7, 1.0, 1.7, 3.0};
constexpr std::array kLeads = {50.0, 25.0, 12.0};  // [s]
constexpr double kAside = 1.05, kHigher = 1.15;    // times the separation, at least
constexpr double kTooLong = 15;                    // for passing behind [s]
constexpr std::array kOtherSpeeds = {0.9, 0.82, 1.1, 1.18};

class Search {
 public:
  Search(const ConflictOfFlight& conflict,
         const std::function<std::optional<FlightPlan>(const Manoeuvre&)>& whole,
         const std::function<bool(const FlightPlan&)>& is_apart)
      : conflict_(conflict), whole_(whole), is_apart_(is_apart) {}

  // The quickest flight aside that is apart, of the least strength for which any is.
  std::optional<FlightPlan> aside(ManoeuvreKind side) const {
    for (const double strength : kStrengths) {
      std::optional<FlightPlan> best;
      for (const double lead : kLeads)
        keep_quicker({side, kAside * strength * conflict_.separation.horizontal, lead},
                     best);
      if (best) return best;
    }
    return std::nullopt;
  }

  std::optional<FlightPlan> level(bool up) const {
    for (const double strength : kStrengths) {
      std::optional<FlightPlan> best;
      keep_quicker({up ? ManoeuvreKind::kUp : ManoeuvreKind::kDown,
                    kHigher * strength * conflict_.separation.vertical},
                   best);
      if (best) return best;
    }
    return std::nullopt;
  }

  std::optional<FlightPlan> speed() const {
    std::optional<FlightPlan> best;
    for (const double factor : kOtherSpeeds) {
      const double airspeed = factor * conflict_.limits.airspeed;
      if (airspeed >= conflict_.limits.slowest && airspeed <= conflict_.limits.fastest)
        keep_quicker({ManoeuvreKind::kSpeed, factor}, best);
    }
    return best;
  }

 private:
  void keep_quicker(const Manoeuvre& manoeuvre, std::optional<FlightPlan>& best) const {
    auto flight = whole_(manoeuvre);
    if (!flight || !is_apart_(*flight)) return;
    if (!best || model::end_time_of(*flight) < model::end_time_of(*best))
      best = std::move(flight);
  }

  const ConflictOfFlight& conflict_;
  const std::function<std::optional<FlightPlan>(const Manoeuvre&)>& whole_;
  const std::function<bool(const FlightPlan&)>& is_apart_;
};

std::optional<FlightPlan> by_rule(AirRule rule, const ConflictOfFlight& conflict,
                                  const Search& search) {
  if (rule == AirRule::kClimbing) {
    const Vec3 v = model::moment_at(conflict.plan, conflict.meets).v_N;
    return search.level(v.z() > 0);
  }
  if (rule == AirRule::kSlowLower || rule == AirRule::kSlowHigher)
    if (auto flight = search.speed()) return flight;
  auto right = search.aside(ManoeuvreKind::kRight);
  const double end = model::end_time_of(conflict.plan);
  if (right && model::end_time_of(*right) <= end + kTooLong) return right;
  if (auto slower = search.speed()) return slower;
  return right;
}

}  // namespace

std::optional<FlightPlan> flight_by_rule(
    AirRule rule, const ConflictOfFlight& conflict,
    const std::function<std::optional<FlightPlan>(const Manoeuvre&)>& whole,
    const std::function<bool(const FlightPlan&)>& is_apart) {
  const Search search(conflict, whole, is_apart);
  if (auto flight = by_rule(rule, conflict, search)) return flight;
  for (const ManoeuvreKind side : {ManoeuvreKind::kRight, ManoeuvreKind::kLeft})
    if (auto flight = search.aside(side)) return flight;
  for (const bool up : {true, false})
    if (auto flight = search.level(up)) return flight;
  return search.speed();
}

}  // namespace skein::reasoning
