// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/separation_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "skein/base/random.h"
#include "skein/layer/reasoning/avoidance/flights/held_circle.h"
#include "skein/layer/reasoning/trajectory/test/test_flight.h"
#include "skein/model/connection/point_connection.h"
#include "skein/model/path/flight_code.h"
#include "skein/model/path/flight_plan.h"

namespace skein::reasoning::separation_planner_test {
namespace {

constexpr EntityId kOther{1}, kOwn{2};

// An aircraft that is where it is put, and its separation planner.
struct Aircraft {
  Aircraft() {
    options.method = SeparationMethod::kAuto;
    planner.emplace(context, options);
    nav.p_N = Vec3(-400, 0, -260);
    nav.v_N = Vec3(15, 0, 0);
    nav.wind_N = Vec2(-4, 0);
  }

  const FlightIntent* second(const std::vector<Message>& inbox = {}) {
    AgentInput in;
    in.now = now;
    in.nav = &nav;
    in.inbox = inbox;
    in.autopilot = status;
    out = {};
    planner->listen(in, out);
    safety.may_fly(in, 100, true, out);
    const FlightIntent* flown = planner->plan(
        &given, {in, {}, safety, beliefs, progress, intents}, progress, out);
    now += Time::from_seconds(1);
    return flown;
  }

  template <class T>
  std::optional<T> said() const {
    for (const Message& message : out.outbox)
      if (const auto* content = std::get_if<T>(&message.content)) return *content;
    return std::nullopt;
  }

  // Somebody else has the turn.
  Message other_lands() const {
    LandingReport report;
    report.phase = LandingPhase::kLands;
    report.lasts = 100;
    report.altitude_msl = 260;
    report.endurance = 500;
    return {kOther, kEveryone, 0, now, report};
  }

  test::FlatGround ground;
  FlightContext context{kOwn, FlightLimits{15, 60, 3, 3, 11, 20}, &ground, nullptr, 120};
  FlightSafety safety{{}, {}, kOwn, FlightLimits{}, ground, {}};
  Beliefs beliefs{EntityId{0}};
  SeparationOptions options;
  std::optional<SeparationPlanner> planner;
  FlightIntent given{1, Landing{Vec2::Zero(), 220}};
  FlightProgress progress;
  IntentCounter intents;
  NavEstimate nav;
  AutopilotStatus status;
  AgentOutput out;
  Time now;
};

// Around what a flight circles in the end, and how high.
struct Waiting {
  Vec2 centre;
  double altitude_msl;
};

std::optional<Waiting> waiting(const FlightIntent& flown) {
  const auto* itinerary = std::get_if<Itinerary>(&flown.what);
  if (!itinerary || itinerary->plan.empty()) return std::nullopt;
  const double end = model::end_time_of(itinerary->plan);
  Eigen::AlignedBox2d around;
  for (double time = end - 50; time < end; time += 0.5)
    around.extend(geo::horizontal(model::moment_at(itinerary->plan, time).p_N));
  const double altitude = -model::end_of(itinerary->plan.back()).p_N.z();
  return Waiting{around.center(), altitude};
}

TEST(SeparationPlanner, ALandingWaitsWhileAnotherAircraftLands) {
  Aircraft aircraft;
  for (int k = 0; k < 60; ++k) {
    const auto circling = waiting(*aircraft.second({aircraft.other_lands()}));
    ASSERT_TRUE(circling) << k;
    EXPECT_GT(circling->centre.x(), 100) << "upwind, where nobody approaches";
    EXPECT_TRUE(aircraft.planner->modifies());
  }
  EXPECT_EQ(aircraft.said<LandingReport>()->phase, LandingPhase::kWaits);
  EXPECT_NE(aircraft.said<LandingReport>()->altitude_msl, 260) << "that is the other's";
}

TEST(SeparationPlanner, ALandingGoesToItsApproachAtItsHeightAndThenDown) {
  Aircraft aircraft;
  std::optional<Waiting> circling;
  for (int k = 0; k < 20; ++k) circling = waiting(*aircraft.second());
  ASSERT_TRUE(circling);
  EXPECT_LT(circling->centre.x(), -500) << "downwind, where the approach begins";
  EXPECT_NEAR(circling->altitude_msl, 260, 0.5);
  aircraft.nav.p_N = Vec3(circling->centre.x(), circling->centre.y(), -260);
  const auto* landing = std::get_if<Landing>(&aircraft.second()->what);
  ASSERT_TRUE(landing);
  EXPECT_NEAR(landing->course.value(), 0, 1e-6) << "into the wind";
  EXPECT_EQ(aircraft.said<PlanReport>().value().priority, FlightPriority::kLanding);
}

// A circle is flown by a plan that others know. Whoever wanted it is not interrupted by
// that: it would begin its circle anew where the aircraft is, step after step.
TEST(SeparationPlanner, ACircleIsFlownAsItIsSaidAndInterruptsNobody) {
  Aircraft aircraft;
  aircraft.given = {2, Circling{Vec2(0, 500), 260.0}};
  int said = 0;
  for (int k = 0; k < 60; ++k) {
    const auto circling = waiting(*aircraft.second());
    ASSERT_TRUE(circling) << k;
    EXPECT_LT((circling->centre - Vec2(0, 500)).norm(), 25);
    EXPECT_FALSE(aircraft.planner->interrupts());
    if (aircraft.said<PlanReport>()) ++said;
  }
  EXPECT_LT(said, 20) << "not a new plan at every look";
  aircraft.given.what = Circling{Vec2(0, 900), 260.0};  // it has moved, as a relay's does
  for (int k = 0; k < 4; ++k) aircraft.second();
  EXPECT_LT((waiting(*aircraft.second())->centre - Vec2(0, 900)).norm(), 25);
}

TEST(SeparationPlanner, WhatAFailsafeLandsIsSaidAndLandsAtOnce) {
  Aircraft aircraft;
  aircraft.given = {2, Circling{Vec2(0, 500), 260.0}};
  aircraft.second();  // where it is now is home
  aircraft.status.trigger = FailsafeTrigger::kBattery;
  aircraft.status.reaction = FailsafeReaction::kLand;
  aircraft.second({aircraft.other_lands()});
  const auto report = aircraft.said<LandingReport>();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->phase, LandingPhase::kLands);
  EXPECT_TRUE(report->emergency);
}

TEST(SeparationPlanner, OnTheGroundItSaysNothingButThatItHasLanded) {
  Aircraft aircraft;
  aircraft.second();
  EXPECT_TRUE(aircraft.said<PlaceReport>());
  aircraft.status.on_ground = true;
  aircraft.second();
  EXPECT_EQ(aircraft.said<LandingReport>()->phase, LandingPhase::kLanded);
  EXPECT_FALSE(aircraft.said<PlaceReport>());
  EXPECT_FALSE(aircraft.said<PlanReport>());
}

// Nobody on board knows what the pilot flies next: others count with straight on.
TEST(SeparationPlanner, WhatAPilotFliesIsSaidAsItsCourse) {
  Aircraft aircraft;
  aircraft.given = {2, Circling{Vec2(0, 500), 260.0}};
  aircraft.second();
  aircraft.status.mode = FlightMode::kStabilized;
  aircraft.nav.v_N = Vec3(0, 15, 0);
  aircraft.second();
  const auto plan = aircraft.said<PlanReport>();
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->priority, FlightPriority::kPilotFlies);
  EXPECT_GE(plan->across_error, 10);
  const auto flight = model::decoded_flight(plan->flight);
  ASSERT_TRUE(flight);
  const double t = model::start_of(*flight);
  const Vec3 later = model::moment_at(*flight, t + 60).p_N;
  EXPECT_LT((later - Vec3(-400, 900, -260)).norm(), 1);
}

// A pilot of 1 to 20 s who is shown how to keep apart from one that comes head-on, and
// has the way.
struct ShownAircraft : Aircraft {
  ShownAircraft() {
    options.method = SeparationMethod::kPriority;
    options.reaction = 21;
    planner.emplace(context, options);
    nav.wind_N = Vec2::Zero();
    FlightElement e;
    e.p_N = nav.p_N;
    e.airspeed = 15;
    e.duration = 400;
    Itinerary itinerary;
    itinerary.plan = {e};
    given = {2, itinerary};
    e.p_N = Vec3(2000, 0, -260);
    e.heading = geo::kPi;
    head_on.number = 1;
    head_on.flight = *model::coded_flight({e});
  }

  // Flies the task's flight, and from `follows_at` on what is shown.
  // @returns  what it says of its plan then.
  std::vector<PlanReport> fly(int seconds, int follows_at) {
    std::vector<PlanReport> all;
    for (int k = 0; k < seconds; ++k) {
      const FlightIntent* shown = second({{kOther, kEveryone, 0, now, head_on}});
      if (k == 0) first = *shown;
      progress.number = k < follows_at ? given.number : shown->number;
      nav.p_N += nav.v_N;
      if (const auto plan = said<PlanReport>()) all.push_back(*plan);
    }
    return all;
  }

  PlanReport head_on;
  FlightIntent first;
};

TEST(SeparationPlanner, APilotWhoFliesOnHasTheWayForAMinute) {
  ShownAircraft aircraft;
  const std::vector<PlanReport> early = aircraft.fly(20, 1000);
  ASSERT_FALSE(early.empty());
  EXPECT_EQ(early.back().priority, FlightPriority::kNormal) << "it may still follow";
  const std::vector<PlanReport> late = aircraft.fly(10, 1000);
  ASSERT_FALSE(late.empty());
  EXPECT_EQ(late.back().priority, FlightPriority::kPilotFlies);
  const auto flight = model::decoded_flight(late.back().flight);
  ASSERT_TRUE(flight);
  const Vec3 there = model::moment_at(*flight, 100).p_N;
  EXPECT_LT((there - Vec3(1100, 0, -260)).norm(), 1) << "the task's flight";
  EXPECT_EQ(aircraft.fly(60, 1000).back().priority, FlightPriority::kNormal);
}

TEST(SeparationPlanner, APilotWhoFollowsInTimeIsOneOfAll) {
  ShownAircraft aircraft;
  for (const PlanReport& plan : aircraft.fly(60, 20))
    EXPECT_EQ(plan.priority, FlightPriority::kNormal);
}

// Others count with it: a shorter one to where it ends would lead through them.
TEST(SeparationPlanner, AFlightThatKeepsApartIsNotJoinedAgainByAnotherWay) {
  ShownAircraft aircraft;
  aircraft.fly(1, 0);
  const auto* itinerary = std::get_if<Itinerary>(&aircraft.first.what);
  ASSERT_TRUE(itinerary);
  EXPECT_TRUE(aircraft.planner->modifies());
  EXPECT_FALSE(itinerary->rejoins);
}

// An aircraft whose task flies legs, and does what it is given, in calm air.
struct RoutedAircraft : Aircraft {
  RoutedAircraft() {
    nav.p_N = Vec3(0, 0, -260);
    nav.wind_N = Vec2::Zero();
    given = {1, Legs{{{1500, 0}, {3000, 0}, {4500, 0}}, 1, 260}};
  }

  // One second, as the chain has it: who is interrupted says what is left.
  const FlightIntent& fly(const std::vector<Message>& inbox = {}) {
    const FlightIntent& flown = *second(inbox);
    const auto* itinerary = std::get_if<Itinerary>(&flown.what);
    if (itinerary) {
      const model::FlightMoment m = model::moment_at(itinerary->plan, now.seconds());
      nav.p_N = m.p_N;
      nav.v_N = m.v_N;
      FlightProgress progress_of_plan;
      progress_of_plan.number = flown.number;
      for (const double time : itinerary->milestones)
        progress_of_plan.passed += time <= now.seconds();
      progress = progress_of_plan;
      const FlightProgress told = planner->for_task(progress_of_plan);
      if (told.number == given.number) passed += told.passed;
    }
    if (planner->interrupts()) {
      ++given.number;
      auto& legs = std::get<Legs>(given.what);
      const std::vector<Vec2> all{{1500, 0}, {3000, 0}, {4500, 0}};
      legs.points.assign(all.begin() + static_cast<std::ptrdiff_t>(passed), all.end());
    }
    return flown;
  }

  std::size_t passed = 0;
};

// Others count with it, for minutes.
TEST(SeparationPlanner, LegsAreFlownByAPlanAndTheirPointsCount) {
  RoutedAircraft aircraft;
  std::uint32_t plans = 0, last = 0;
  for (int k = 0; k < 205; ++k) {
    ASSERT_TRUE(std::holds_alternative<Itinerary>(aircraft.fly().what)) << k;
    EXPECT_NEAR(aircraft.nav.p_N.y(), 0, 1) << k;
    const auto said = aircraft.said<PlanReport>();
    if (said && said->number != last) ++plans, last = said->number;
  }
  EXPECT_EQ(aircraft.passed, 2u) << "after 3075 m";
  EXPECT_LE(plans, 5u) << "a new one each minute";
}

TEST(SeparationPlanner, AManoeuvreOutOfLegsIsFlownToItsEnd) {
  RoutedAircraft aircraft;
  FlightElement e;
  e.p_N = Vec3(2400, 0, -260);
  e.airspeed = 15;
  e.heading = geo::kPi;
  e.duration = 400;
  PlanReport head_on;
  head_on.number = 1;
  head_on.flight = *model::coded_flight({e});
  head_on.horizontal = 50;
  head_on.vertical = 20;
  double aside = 0, least = 1e9;
  std::uint32_t plans = 0, last = 0;
  for (int k = 0; k < 140; ++k) {
    const Vec3 there(2400 - 15.0 * k, 0, -260);
    PlaceReport place;
    place.north = static_cast<float>(there.x());
    place.down = -260;
    place.v_north = -15;
    place.plan = 1;
    aircraft.fly({{kOther, kEveryone, 0, aircraft.now, head_on},
                  {kOther, kEveryone, 0, aircraft.now, place}});
    const Vec3 off = aircraft.nav.p_N - (there - Vec3(15, 0, 0));
    least = std::min(least, Separation{}.ratio(off.head<2>().norm(), std::abs(off.z())));
    aside = std::max(aside, std::abs(aircraft.nav.p_N.y()) + std::abs(off.z()));
    const auto said = aircraft.said<PlanReport>();
    if (said && said->number != last) ++plans, last = said->number;
  }
  EXPECT_GT(least, 1);
  EXPECT_GT(aside, 20);
  EXPECT_LE(plans, 6u) << "it is not begun anew at each step";
  EXPECT_EQ(aircraft.passed, 1u);
}

// An aircraft that flies straight to a point, circles there until further notice, and is
// always where what it flies has it.
struct Visitor {
  Visitor(EntityId id, const Vec2& from, const Vec2& to)
      : context{id, FlightLimits{15, 60, 3, 3, 11, 20}, &ground, nullptr, 150},
        safety({}, {}, id, FlightLimits{}, ground, {}) {
    options.method = SeparationMethod::kAuto;
    planner.emplace(context, options);
    const Vec2 way = to - from;
    FlightElement e;
    e.p_N = Vec3(from.x(), from.y(), -250);
    e.heading = geo::bearing(way);
    e.airspeed = 15;
    e.duration = end = way.norm() / 15;
    Itinerary itinerary;
    itinerary.plan = {e};
    itinerary.stays = true;
    given = {1, itinerary};
    goal = to;
    nav.p_N = e.p_N;
    nav.heading = e.heading;
    nav.v_N.head<2>() = 15 * geo::unit(e.heading);
  }

  // One second. @returns what it says.
  std::vector<Message> fly(const std::vector<Message>& inbox) {
    AgentInput in;
    in.now = now;
    in.nav = &nav;
    in.inbox = inbox;
    AgentOutput out;
    planner->listen(in, out);
    safety.may_fly(in, 100, true, out);
    flown = planner->plan(&given, {in, {}, safety, beliefs, progress, intents}, progress,
                          out);
    now += Time::from_seconds(1);
    const double t = now.seconds();
    const auto& itinerary = std::get<Itinerary>(flown->what);
    const model::FlightMoment m = model::moment_at(itinerary.plan, t);
    nav.p_N = m.p_N;
    nav.v_N = m.v_N;
    nav.heading = m.heading;
    progress = {};
    progress.number = flown->number;
    for (const double time : itinerary.milestones) progress.passed += time <= t;
    progress.done = t >= model::end_time_of(itinerary.plan);
    const FlightProgress told = planner->for_task(progress);
    if (!arrived && told.number == 1 && told.done) {
      arrived = now;
      given = {1, Circling{goal, {}}};
    }
    for (Message& message : out.outbox) {
      message.from = context.self;
      message.sent = in.now;
    }
    return out.outbox;
  }

  test::FlatGround ground;
  FlightContext context;
  FlightSafety safety;
  Beliefs beliefs{EntityId{0}};
  SeparationOptions options;
  std::optional<SeparationPlanner> planner;
  FlightIntent given;
  const FlightIntent* flown = nullptr;
  FlightProgress progress;
  IntentCounter intents;
  NavEstimate nav;
  Vec2 goal = Vec2::Zero();
  double end = 0;
  std::optional<Time> arrived;
  Time now;
};

TEST(SeparationPlanner, WhatFollowsATaskIsSaidLongBeforeItsEnd) {
  Visitor alone(kOwn, {0, 0}, {2400, 0});
  std::optional<double> said_first;
  for (int k = 0; k < 150; ++k)
    for (const Message& message : alone.fly({})) {
      const auto* plan = std::get_if<PlanReport>(&message.content);
      if (!plan || said_first) continue;
      const auto flight = model::decoded_flight(plan->flight);
      ASSERT_TRUE(flight);
      if (model::end_time_of(*flight) < alone.end + 60) continue;
      said_first = message.sent.seconds();
      const auto circle = circle_at_end(*flight);
      ASSERT_TRUE(circle);
      EXPECT_LT((circle->centre - alone.goal).norm(), 20);
    }
  ASSERT_TRUE(said_first);
  EXPECT_LT(*said_first, alone.end - 80) << "others look 90 s ahead";
}

// Two whose tasks end beside each other, 90 to 200 m apart, from anywhere.
TEST(SeparationPlanner, TasksThatEndBesideEachOtherKeepApartInAnyGeometry) {
  RandomStream random(5, 0, Purpose::kTest);
  const auto within = [&](double most) { return most * (2 * random.uniform() - 1); };
  for (int k = 0; k < 40; ++k) {
    const Vec2 end(within(1000), within(1000));
    const Vec2 other_end =
        end + (90 + 110 * random.uniform()) * geo::unit(within(geo::kPi));
    const double from = within(geo::kPi);
    // They come from sides far enough from each other not to meet on the way.
    const double other_from = from + (k % 2 == 0 ? 0 : 2 + random.uniform());
    Visitor a(kOther, end + (1000 + 500 * random.uniform()) * geo::unit(from), end);
    Visitor b(kOwn, other_end + (1000 + 500 * random.uniform()) * geo::unit(other_from),
              other_end);
    // Too near for anybody from the start.
    if ((a.nav.p_N - b.nav.p_N).norm() < 150) continue;
    std::vector<Message> from_a, from_b;
    double least = 1e9;
    for (int t = 0; t < 300; ++t) {
      auto next_a = a.fly(from_b), next_b = b.fly(from_a);
      from_a = std::move(next_a);
      from_b = std::move(next_b);
      const Vec3 apart = a.nav.p_N - b.nav.p_N;
      if (t > 2)
        least = std::min(least,
                         Separation{}.ratio(apart.head<2>().norm(), std::abs(apart.z())));
    }
    EXPECT_GT(least, 1) << "case " << k;
    EXPECT_TRUE(a.arrived && b.arrived) << "case " << k;
  }
}

// A neighbour of others that circles until it is ordered to a point, and plans anew from
// where it is whenever it is interrupted.
struct Scout : Visitor {
  Scout(EntityId id, const Vec2& place) : Visitor(id, place, place + Vec2(1, 0)) {
    given = {0, Circling{place, {}}};
  }

  void order(const Vec2& point) {
    const model::AirMotion air{15, 66, Vec2::Zero()};
    const model::Pose from{geo::horizontal(nav.p_N), nav.heading};
    const model::PointConnection path = model::connect_to_point(from, point, air);
    Itinerary itinerary;
    itinerary.plan = model::to_flight_plan(path, from, air, now.seconds(), nav.p_N.z());
    itinerary.stays = true;
    given = {++number, itinerary};
    ordered = point;
  }

  std::vector<Message> second(const std::vector<Message>& inbox) {
    auto said = fly(inbox);
    if (ordered && planner->interrupts()) order(*ordered);
    return said;
  }

  std::uint32_t number = 100;
  std::optional<Vec2> ordered;
};

// The first orders of a team, to all in one moment and across each other's way.
TEST(SeparationPlanner, FirstOrdersLeadNobodyIntoANeighbour) {
  RandomStream random(9, 0, Purpose::kTest);
  for (int k = 0; k < 8; ++k) {
    std::vector<std::unique_ptr<Scout>> team;
    for (std::uint32_t i = 0; i < 6; ++i)
      team.push_back(std::make_unique<Scout>(EntityId{i + 1}, Vec2(0, 120.0 * i)));
    std::vector<Message> said;
    double least = 1e9;
    std::size_t gone = 0;
    for (int t = 0; t < 180; ++t) {
      if (t == 6)
        for (auto& each : team)
          each->order(2000 * geo::unit(2 * geo::kPi * random.uniform()));
      std::vector<Message> next;
      for (auto& each : team)
        for (Message& message : each->second(said)) next.push_back(std::move(message));
      said = std::move(next);
      for (std::size_t i = 0; i < team.size() && t > 3; ++i)
        for (std::size_t j = i + 1; j < team.size(); ++j) {
          const Vec3 apart = team[i]->nav.p_N - team[j]->nav.p_N;
          least = std::min(
              least, Separation{}.ratio(apart.head<2>().norm(), std::abs(apart.z())));
        }
    }
    for (std::size_t i = 0; i < team.size(); ++i)
      gone += (geo::horizontal(team[i]->nav.p_N) - Vec2(0, 120 * static_cast<double>(i)))
                  .norm() > 500;
    EXPECT_GT(least, 1) << "case " << k;
    EXPECT_EQ(gone, team.size()) << "case " << k << ": nobody waits for ever";
  }
}

// One circles where another one's flight leads through: the way of the lower number.
TEST(SeparationPlanner, ACircleIsMovedOutOfTheWayOfWhoHasIt) {
  Visitor circles(kOwn, {-1200, 0}, {0, 0});
  std::vector<Message> from_other;
  for (int t = 0; t < 100; ++t) circles.fly({});
  ASSERT_TRUE(circles.arrived);
  Visitor passes(kOther, {0, -1500}, {0, 1500});
  passes.now = circles.now;
  auto& flight = std::get<Itinerary>(passes.given.what).plan.front();
  flight.start = circles.now.seconds();
  double least = 1e9;
  std::vector<Message> from_circling;
  for (int t = 0; t < 150; ++t) {
    auto own = circles.fly(from_other), other = passes.fly(from_circling);
    from_circling = std::move(own);
    from_other = std::move(other);
    const Vec3 apart = circles.nav.p_N - passes.nav.p_N;
    least =
        std::min(least, Separation{}.ratio(apart.head<2>().norm(), std::abs(apart.z())));
  }
  EXPECT_GT(least, 1);
}

}  // namespace
}  // namespace skein::reasoning::separation_planner_test
