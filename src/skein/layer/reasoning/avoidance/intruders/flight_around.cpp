// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/intruders/flight_around.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "skein/geo/rotation.h"
#include "skein/layer/reasoning/avoidance/encounter/plan_encounter.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/candidates.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/flight_check.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/replanned_flight.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/repair.h"

namespace skein::reasoning {
namespace {

constexpr double kSpread = 30;     // for which room for others is made [s]
constexpr double kAhead = 60;      // for which it is there [s]
constexpr double kLookFar = 600;   // for the end of an intersection [s]
constexpr double kDearest = 60;    // more: not tried at other heights too [s]
constexpr double kWorth = 2;       // for another flight than one that is clear [s]
constexpr double kHeightMore = 1;  // than what has to be kept [m]
constexpr std::array kTurns = {8.0, 15.0, 25.0, 35.0, 50.0, 70.0, 90.0, 120.0};  // [deg]
constexpr std::array kTurnedFor = {-0.3, 0.0, 0.3,
                                   0.7};         // times the conflict, from its end
constexpr std::array kMoreHeight = {0.0, 0.25};  // times what is kept
constexpr double kOtherWay = 15;  // what it costs to change to the other side [s]
constexpr double kToSide = 30;    // after which a side shows [s]
constexpr double kClearlyAside = 60, kClearlyUp = 10;  // [m]
constexpr std::array kSpeedShares = {0.4, 0.75};  // of what it can fly faster, slower

class Around {
 public:
  Around(const IntruderView& view, double begin)
      : view_(view),
        part_(solve::part_of(view.plan, begin, view.rejoins)),
        begin_(begin),
        encounters_(encounters_with(view)),
        zones_(zones_with_rooms(view, encounters_)),
        check_(view.query, zones_) {
    for (const AvoidedIntruder& intruder : view.intruders)
      flights_.push_back(flight_of(intruder, view.now, view.now + kLookFar));
    for (std::size_t k = 0; k < flights_.size(); ++k) {
      intruders_.push_back({&flights_[k], encounters_[k].where.kept});
      if (moves(view, encounters_[k])) others_.push_back(intruders_.back());
    }
    for (const PlannedFlight& room : view.rooms)
      others_.push_back({&room.plan, {room.zone.across, room.height}});
    if (part_.empty()) return;
    const auto quickest = direct();
    arrival_ = model::end_time_of(part_);
    if (quickest) arrival_ = std::min(arrival_, model::end_time_of(*quickest));
  }

  std::optional<FlightPlan> find(const PredictedIntersection& first) {
    if (part_.empty()) return std::nullopt;
    dearest_ = cost(part_) + kDearest;
    make(first);
    std::ranges::stable_sort(found_, {}, &Flight::cost);
    for (const double until : {begin_ + kLookFar, begin_ + kAhead})
      for (Flight& each : found_)
        if (is_clear(each.flight, until)) return std::move(each.flight);
    return std::nullopt;
  }

  // The straight way on, where it is clear and worth it.
  std::optional<FlightPlan> straight_on() {
    if (part_.empty()) return std::nullopt;
    auto flight = direct();
    if (!flight || cost(*flight) > cost(part_) - kWorth) return std::nullopt;
    append_rest(*flight, view_.plan, view_.rejoins);
    if (!is_clear(*flight, begin_ + kLookFar)) return std::nullopt;
    return flight;
  }

 private:
  struct Flight {
    FlightPlan flight;
    double cost = 0;
  };

  void make(const PredictedIntersection& first);
  void turn_or_change_speed(const ConflictOfFlight& conflict);
  void climb_or_sink(const KnownFlight& intruder, const Separation& kept);
  std::optional<FlightPlan> direct() const {
    return manoeuvred({ManoeuvreKind::kDirect},
                      {part_, view_.query.limits, begin_, begin_, begin_, begin_, {}});
  }
  void add(std::optional<FlightPlan> flight) {
    if (!flight) return;
    const double how_much = cost(*flight);
    found_.push_back({*std::move(flight), how_much});
  }
  // Neither later nor earlier than what is flown, or the quickest way at cruise.
  double cost(const FlightPlan& flight) const {
    return std::abs(model::end_time_of(flight) - arrival_) + cost_of_climbs(flight) +
           cost_of_other_way(flight);
  }
  // Where it was begun to climb, sink or turn aside, the opposite is not done lightly:
  // the noise of a track would have it now this way, now that.
  double cost_of_other_way(const FlightPlan& flight) const {
    const Way plan = way_of(part_), other = way_of(flight);
    const bool changes = opposite(plan.right, other.right, kClearlyAside) ||
                         opposite(plan.up, other.up, kClearlyUp);
    return changes ? kOtherWay : 0;
  }
  static bool opposite(double a, double b, double least) {
    return a * b < 0 && std::min(std::abs(a), std::abs(b)) > least;
  }
  // Where a flight is some seconds later, seen along the way to the plan's end.
  struct Way {
    double right = 0, up = 0;  // [m]
  };
  Way way_of(const FlightPlan& flight) const {
    const Vec3 from = part_.front().p_N;
    const Vec3 way = model::moment_at(flight, begin_ + kToSide).p_N - from;
    const Vec2 goal = (model::end_of(part_.back()).p_N - from).head<2>();
    if (goal.norm() < 1) return {};
    return {way.head<2>().dot(geo::turned_right(goal.normalized())), -way.z()};
  }
  bool is_clear(const FlightPlan& flight, double until) {
    return std::ranges::none_of(others_,
                                [&](const KnownFlight& other) {
                                  return first_encounter(flight, *other.plan,
                                                         other.separation, begin_, until)
                                      .has_value();
                                }) &&
           check_.is_free(flight);
  }

  const IntruderView& view_;
  FlightPlan part_;
  double begin_, arrival_ = 0, dearest_ = 0;
  std::vector<IntruderEncounter> encounters_;
  std::vector<Zone> zones_;  // and static rooms
  FlightCheck check_;
  std::vector<FlightPlan> flights_;     // of intruders
  std::vector<KnownFlight> intruders_;  // all
  std::vector<KnownFlight> others_;     // that are met where they are at the moment
  std::vector<Flight> found_;
};

// How much higher than where it begins (lower: negative) a flight has to be to pass over
// an intruder, or under it.
struct Heights {
  double over = 0, under = 0;
};

Heights heights_needed(double own_down, const FlightPlan& other,
                       const PlanEncounter& encounter, double kept) {
  Heights needed{-1e9, 1e9};
  for (const double time : {encounter.begin, encounter.closest_time, encounter.end}) {
    const double higher = own_down - model::moment_at(other, time).p_N.z();
    needed.over = std::max(needed.over, higher + kept + kHeightMore);
    needed.under = std::min(needed.under, higher - kept - kHeightMore);
  }
  return needed;
}

// What can be flown at the plan's heights.
void Around::turn_or_change_speed(const ConflictOfFlight& conflict) {
  const FlightLimits& limits = view_.query.limits;
  const double length = conflict.apart - begin_;
  for (const double turn : kTurns)
    for (const double side : {1.0, -1.0})
      for (const double share : kTurnedFor)
        add(turned_flight(conflict, side * geo::radians(turn),
                          conflict.apart + share * length));
  for (const double share : kSpeedShares)
    for (const double limit : {limits.slowest, limits.fastest})
      add(manoeuvred({ManoeuvreKind::kSpeed,
                      1 + share * (limit - limits.airspeed) / limits.airspeed},
                     conflict));
}

// The same flights, above or below the intruder.
void Around::climb_or_sink(const KnownFlight& intruder, const Separation& kept) {
  const std::size_t level = found_.size();
  for (std::size_t k = 0; k < level; ++k) {
    if (found_[k].cost > dearest_) continue;
    const FlightPlan base = found_[k].flight;
    const auto encounter =
        first_encounter(base, *intruder.plan, kept, begin_, begin_ + kLookFar);
    if (!encounter) continue;
    const ConflictOfFlight conflict{base,
                                    view_.query.limits,
                                    begin_,
                                    encounter->begin,
                                    encounter->closest_time,
                                    encounter->end,
                                    kept};
    const Heights needed =
        heights_needed(base.front().p_N.z(), *intruder.plan, *encounter, kept.vertical);
    for (const double more : kMoreHeight) {
      if (needed.over > 0)
        add(manoeuvred({ManoeuvreKind::kUp, needed.over + more * kept.vertical, kLookFar},
                       conflict));
      if (needed.under < 0)
        add(manoeuvred(
            {ManoeuvreKind::kDown, more * kept.vertical - needed.under, kLookFar},
            conflict));
    }
  }
}

void Around::make(const PredictedIntersection& first) {
  const auto intruder = std::ranges::find_if(intruders_, [&](const KnownFlight& other) {
    return first_encounter(part_, *other.plan, first.kept, begin_, first.end).has_value();
  });
  if (intruder == intruders_.end()) return;
  // All of the conflict, however long the two fly beside each other.
  const PlanEncounter encounter =
      *first_encounter(part_, *intruder->plan, first.kept, begin_, begin_ + kLookFar);
  add(part_);
  add(direct());
  turn_or_change_speed({part_, view_.query.limits, begin_, encounter.begin,
                        encounter.closest_time, encounter.end, first.kept});
  climb_or_sink(*intruder, first.kept);
  // What comes after the plan is met again.
  for (Flight& each : found_) append_rest(each.flight, view_.plan, view_.rejoins);
}

}  // namespace

std::vector<IntruderEncounter> encounters_with(const IntruderView& view) {
  std::vector<IntruderEncounter> all;
  for (const AvoidedIntruder& intruder : view.intruders) {
    if (const auto encounter = predicted_intersection(view.plan, intruder, view.now)) {
      all.push_back({*encounter, true});
      continue;
    }
    PredictedIntersection encounter;
    encounter.begin = view.now;
    encounter.end = view.now + kAhead;
    encounter.kept = {
        intruder.kept.horizontal + 2 * horizontal_sd_after(intruder, kSpread),
        intruder.kept.vertical + 2 * vertical_sd_after(intruder, kSpread)};
    all.push_back({encounter, false});
  }
  return all;
}

bool moves(const IntruderView& view, const IntruderEncounter& encounter) {
  return view.kind == IntruderRoom::kMoving || !encounter.of_plan;
}

std::vector<Zone> zones_with_rooms(const IntruderView& view,
                                   std::span<const IntruderEncounter> encounters) {
  std::vector<Zone> zones(view.zones.begin(), view.zones.end());
  for (std::size_t k = 0; k < encounters.size(); ++k)
    if (!moves(view, encounters[k]))
      zones.push_back(static_room_of(view.intruders[k], encounters[k].where));
  return zones;
}

std::optional<FlightPlan> flight_around(const IntruderView& view,
                                        const PredictedIntersection& first,
                                        double begin) {
  return Around(view, begin).find(first);
}

std::optional<FlightPlan> flight_straight_on(const IntruderView& view, double begin) {
  return Around(view, begin).straight_on();
}

}  // namespace skein::reasoning
