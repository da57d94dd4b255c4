// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/flights/team_flights.h"

#include <algorithm>
#include <cmath>

#include "skein/layer/reasoning/avoidance/flights/course_flight.h"
#include "skein/model/path/flight_code.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning {
namespace {

// How far from its plan an aircraft counts as flying it: this often its own error, and so
// much at least.
constexpr double kErrors = 3;
constexpr double kAcross = 30, kHeight = 12;  // [m]

constexpr double kPlaceHolds = 10;              // that a place is of use at least [s]
constexpr double kPlacesHeld = 3;               // the same, in periods of PlaceReports
constexpr double kClimbsOn = 6;                 // of who has no plan [s]
constexpr double kCourseError = 10;             // of a course that is no plan [m]
constexpr std::uint32_t kCourses = 0x80000000;  // numbers of courses begin there
constexpr double kLargestError = 1000;          // that can be meant [m]
constexpr double kLargestSeparation = 20e3;
constexpr double kLongestGap = 20;   // between PlaceReports, in their periods
constexpr double kForgets = 0.99;    // of PlaceReports, at each
constexpr double kMinExpected = 10;  // of them, to know what is lost
constexpr double kUsualLoss = 0.1;   // of messages
constexpr double kFades = 0.9;       // of the longest delay, at each message

bool is_error(float error) {
  return error >= 0 && error <= kLargestError;
}
bool is_separation(float distance) {
  return distance > 0 && distance <= kLargestSeparation;
}

}  // namespace

bool TeamFlight::conforms(Time now) const {
  return !plan.empty() && !strays && (now - sent).seconds() <= plan_holds + delay;
}

// By the plan and the place that are known; each of them has to be looked at once only.
bool TeamFlights::strays(const TeamFlight& flight) {
  const auto& place = flight.place;
  if (flight.plan.empty() || !place || place->plan != flight.number) return false;
  const Vec3 off = model::moment_at(flight.plan, place->sent.seconds()).p_N - place->p_N;
  return off.head<2>().norm() > std::max(kAcross, kErrors * flight.across_error) ||
         std::abs(off.z()) > std::max(kHeight, kErrors * flight.height_error);
}

TeamFlight::Expected TeamFlight::expected(Time now) const {
  if (conforms(now)) return {&plan, number, 0};
  if (course.empty() || (now - place->sent).seconds() > place_holds) return {};
  return {&course, course_number, kCourseError};
}

TeamFlight& TeamFlights::at(EntityId who) {
  const auto found = std::ranges::lower_bound(flights_, who, {}, &TeamFlight::who);
  if (found != flights_.end() && found->who == who) return *found;
  TeamFlight fresh;
  fresh.who = who;
  fresh.plan_holds = kPlanHolds * place_period_;
  fresh.place_holds = std::max(kPlaceHolds, kPlacesHeld * place_period_);
  return *flights_.insert(found, std::move(fresh));
}

const TeamFlight* TeamFlights::find(EntityId who) const {
  const auto found = std::ranges::lower_bound(flights_, who, {}, &TeamFlight::who);
  return found != flights_.end() && found->who == who ? &*found : nullptr;
}

void TeamFlights::take(const Message& message, const PlanReport& report) {
  TeamFlight& flight = at(message.from);
  if (!flight.plan.empty() && message.sent < flight.sent) return;
  if (flight.landed && message.sent <= *flight.landed) return;
  const bool other = flight.plan.empty() || report.number != flight.number;
  // A lower number is of somebody who has begun anew, if that is not a late message.
  if (other && report.number < flight.number &&
      (message.sent - flight.sent).seconds() < flight.plan_holds)
    return;
  if (!is_error(report.across_error) || !is_error(report.height_error) ||
      !is_separation(report.horizontal) || !is_separation(report.vertical))
    return;
  if (other) {
    auto plan = model::decoded_flight(report.flight);
    if (!plan) return;
    flight.plan = *std::move(plan);
  }
  flight.number = report.number;
  flight.agreed = report.agreed;
  flight.priority = report.priority;
  flight.separation = {report.horizontal, report.vertical};
  flight.across_error = report.across_error;
  flight.height_error = report.height_error;
  flight.sent = message.sent;
  flight.strays = strays(flight);
}

void TeamFlights::take(const Message& message, const PlaceReport& report) {
  const ReportedPlace place{message.sent, Vec3(report.north, report.east, report.down),
                            Vec3(report.v_north, report.v_east, report.v_down),
                            report.plan};
  if (!place.p_N.allFinite() || !place.v_N.allFinite()) return;
  TeamFlight& flight = at(message.from);
  if (flight.place && place.sent <= flight.place->sent) return;
  if (flight.landed && place.sent <= *flight.landed) return;
  if (flight.place) {
    // Longer gaps are of somebody who was out of reach.
    const double sent =
        std::round((place.sent - flight.place->sent).seconds() / place_period_);
    if (sent >= 1 && sent <= kLongestGap) {
      expected_ = kForgets * expected_ + sent;
      received_ = kForgets * received_ + 1;
    }
  }
  flight.place = place;
  flight.course.clear();
  flight.strays = strays(flight);
}

void TeamFlights::take(const Message& message, const LandingReport& report) {
  if (report.phase != LandingPhase::kLanded) return;
  TeamFlight& flight = at(message.from);
  if (flight.landed && message.sent <= *flight.landed) return;
  flight.landed = message.sent;
  if (!flight.plan.empty() && flight.sent <= message.sent) flight.plan.clear();
  if (flight.place && flight.place->sent <= message.sent) {
    flight.place.reset();
    flight.course.clear();
  }
  flight.strays = strays(flight);
}

// Of those whose plan says nothing.
void TeamFlights::expect_courses(Time now) {
  for (TeamFlight& each : flights_) {
    if (!each.place || !each.course.empty() || each.conforms(now)) continue;
    const ReportedPlace& place = *each.place;
    each.course =
        course_flight(place.p_N, place.v_N, place.sent.seconds(), horizon_, kClimbsOn);
    each.course_number = kCourses | ++courses_;
  }
}

double TeamFlights::loss() const {
  return expected_ > kMinExpected ? 1 - received_ / expected_ : 0;
}

double TeamFlights::loss_to_expect() const {
  return expected_ > kMinExpected ? loss() : kUsualLoss;
}

void TeamFlights::listen(EntityId self, Time now, std::span<const Message> inbox) {
  for (const Message& message : inbox) {
    // What was sent later than now is of a clock that cannot be trusted.
    if (message.from == self || message.sent > now) continue;
    if (const auto* plan = std::get_if<PlanReport>(&message.content))
      take(message, *plan);
    else if (const auto* place = std::get_if<PlaceReport>(&message.content))
      take(message, *place);
    else if (const auto* landing = std::get_if<LandingReport>(&message.content))
      take(message, *landing);
    else
      continue;
    TeamFlight& flight = at(message.from);
    flight.delay = std::max((now - message.sent).seconds(), kFades * flight.delay);
  }
  std::erase_if(flights_, [&](const TeamFlight& flight) {
    const Time last = std::max({flight.sent, flight.place ? flight.place->sent : Time(),
                                flight.landed.value_or(Time())});
    return (now - last).seconds() > kForget * place_period_;
  });
  expect_courses(now);
}

}  // namespace skein::reasoning
