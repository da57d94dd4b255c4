// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/intruders/intruder_avoidance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "skein/layer/reasoning/avoidance/intruders/escape.h"
#include "skein/layer/reasoning/avoidance/intruders/flight_around.h"
#include "skein/layer/reasoning/avoidance/manoeuvre/replanned_flight.h"
#include "skein/model/path/flight_plan.h"
#include "skein/solve/path/link.h"

namespace skein::reasoning {
namespace {

// Sigmas of room in which an intruder is worth another plan: fewer than what that keeps,
// or the noise of its track would ask for one again and again.
constexpr double kActs = 1;
constexpr double kKept = 2;      // that flights around intruders keep, in sigmas
constexpr double kClear = 3;     // the way to the goal, before it is flown [s]
constexpr int kWarning = 3;      // level of alert
constexpr double kTryAgain = 2;  // after no plan was found [s]
// To where the plan is met again; empty where nothing leads there.
FlightPlan plan_from_here(const IntruderView& view) {
  const model::FlightMoment to = model::moment_at(view.plan, view.rejoins);
  const FlightState here{view.p_N,
                         geo::bearing(Vec2(view.v_N.head<2>() - view.query.wind))};
  const solve::Link link =
      solve::link(here, {to.p_N, geo::wrap_pi(to.heading)}, view.query);
  if (!std::isfinite(link.duration)) return {};
  return solve::to_flight_plan(link, here, view.now, view.query);
}

}  // namespace

IntruderAvoidance::IntruderAvoidance(double reaction,
                                     const model::WellClearConfiguration* well_clear)
    : reaction_(reaction),
      advisor_(well_clear ? *well_clear
                          : *model::well_clear_configuration("skein_suas")) {}

bool IntruderAvoidance::plan_around(const IntruderView& view) {
  Airspace airspace;
  airspace.flights.assign(view.rooms.begin(), view.rooms.end());
  const std::vector<IntruderEncounter> encounters = encounters_with(view);
  airspace.zones = zones_with_rooms(view, encounters);
  for (std::size_t k = 0; k < encounters.size(); ++k)
    if (moves(view, encounters[k]))
      airspace.movers.push_back(room_of(view.intruders[k], encounters[k].where));
  auto flight = replanned(view.plan, begin_, view.rejoins, view.query, airspace);
  if (!flight) return false;
  flight_ = *std::move(flight);
  return true;
}

// By bands: whether the way to the goal is to be left, and on which track.
bool IntruderAvoidance::must_turn(const IntruderView& view) {
  const Vec2 to_goal =
      (model::moment_at(view.plan, view.rejoins).p_N - view.p_N).head<2>();
  const double goal = turning_ || to_goal.norm() < 1 ? geo::bearing(to_goal)
                                                     : geo::bearing(view.v_N.head<2>());
  intruders_.clear();
  for (const AvoidedIntruder& each : view.intruders) {
    const double age = view.now - each.time;
    intruders_.push_back({each.name,
                          {each.p_N + age * each.v_N, each.v_N},
                          horizontal_sd_after(each, std::max(0.0, age)),
                          vertical_sd_after(each, std::max(0.0, age)),
                          0});
  }
  const auto& advice = advisor_.advise(view.now, {view.p_N, view.v_N}, intruders_,
                                       {goal, view.v_N.head<2>().norm(), -view.v_N.z()});
  alert_ = advice.alert;
  climb_ = 0;
  if (advice.track) {
    track_ = advice.track->value;
    escapes_up_.reset();
  } else {
    escape(view);
  }
  return std::abs(geo::wrap_pi(track_ - goal)) > 1e-3 || alert_ >= kWarning;
}

// No track leads out. Up or down is kept as it was begun: the noise of a track would have
// it now this way, now that.
void IntruderAvoidance::escape(const IntruderView& view) {
  track_ = geo::bearing(view.v_N.head<2>());
  if (view.intruders.empty()) return;
  const Escape escape =
      escape_from(view.p_N, view.v_N, view.query.limits, view.intruders, view.now);
  track_ = escape.course;
  if (!escapes_up_) escapes_up_ = escape.up;
  double height = 0;
  for (const AvoidedIntruder& each : view.intruders)
    height = std::max(height, each.kept.vertical);
  climb_ = *escapes_up_ ? height : -height;
}

// The first intersection with rooms of so many sigmas.
std::optional<PredictedIntersection> IntruderAvoidance::first_of(const IntruderView& view,
                                                                 double sigmas) {
  std::optional<PredictedIntersection> first;
  for (const AvoidedIntruder& intruder : view.intruders) {
    const auto inner = predicted_intersection(view.plan, intruder, view.now, sigmas);
    if (!inner || (first && first->begin <= inner->begin)) continue;
    first = predicted_intersection(view.plan, intruder, view.now);
    intruder_ = intruder.name;
  }
  if (first) encounter_ = *first;
  return first;
}

IntruderAvoidance::Action IntruderAvoidance::step(const IntruderView& view) {
  if (view.intruders.empty() && !turning_) return Action::kNone;
  const bool turn = must_turn(view);
  if (turning_) return turn_on(view, turn);
  const std::optional<PredictedIntersection> first = first_of(view, kActs);
  begin_ = view.now + reaction_;
  if (!first) {
    if (!around_) return Action::kNone;
    auto flight = flight_straight_on(view, begin_);
    if (!flight) return Action::kNone;
    flight_ = *std::move(flight);
    around_ = false;
    return Action::kPlan;
  }
  if (view.now >= plan_again_) {
    if (auto flight = flight_around(view, *first, begin_)) {
      flight_ = *std::move(flight);
      around_ = true;
    } else {
      around_ = plan_around(view);
    }
    if (around_) return Action::kPlan;
    plan_again_ = view.now + kTryAgain;
  }
  if (!turn) return Action::kNone;
  turning_ = true;
  clear_since_ = view.now;
  return Action::kTrack;
}

// By bands, until the way to the goal is free or a flight from here is.
IntruderAvoidance::Action IntruderAvoidance::turn_on(const IntruderView& view,
                                                     bool turn) {
  if (turn) clear_since_ = view.now;
  // What is wanted is planned from here.
  if (view.now - clear_since_ >= kClear) turning_ = false;
  if (!turning_) return Action::kNone;
  if (view.now < plan_again_) return Action::kTrack;
  plan_again_ = view.now + kTryAgain;
  FlightPlan here = plan_from_here(view);
  if (here.empty()) return Action::kTrack;
  const IntruderView from_here{
      view.now,       view.p_N,   view.v_N,   here,       model::end_time_of(here),
      view.intruders, view.query, view.zones, view.rooms, view.kind};
  // A flight that is as good as met would be left again a second later.
  if (const auto first = first_of(from_here, kKept)) {
    auto flight = flight_around(from_here, *first, view.now);
    if (!flight) return Action::kTrack;
    here = *std::move(flight);
  }
  append_rest(here, view.plan, view.rejoins);
  flight_ = std::move(here);
  begin_ = view.now;
  around_ = true;
  turning_ = false;
  plan_again_ = view.now;
  return Action::kPlan;
}

}  // namespace skein::reasoning
