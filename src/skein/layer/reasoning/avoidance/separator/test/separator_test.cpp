// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/separator/separator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "skein/base/math.h"
#include "skein/base/random.h"
#include "skein/model/path/flight_code.h"
#include "skein/model/path/flight_plan.h"
#include "skein/role/terrain.h"

namespace skein::reasoning::separator_test {
namespace {

// Aircraft that fly their plans exactly, and a radio that loses and delays.
class Sky {
 public:
  Sky(SeparationMethod method, double loss = 0, double delay = 0)
      : method_(method), loss_(loss), delay_(delay) {}

  void add(const Vec3& from, const Vec3& to) {
    const EntityId id{static_cast<std::uint32_t>(all_.size() + 1)};
    SeparationOptions options;
    options.method = method_;
    all_.push_back(std::make_unique<One>(id, options));
    FlightElement e;
    e.p_N = from;
    e.airspeed = 20;
    e.heading = geo::bearing((to - from).head<2>());
    e.duration = (to - from).head<2>().norm() / e.airspeed;
    e.climb_rate = -(to - from).z() / e.duration;
    all_.back()->wanted = {1, {e}, {e.duration}};
    all_.back()->now = {from, e.airspeed * Vec3(1, 0, 0)};
  }

  // Flies all to the end of their plans. @returns the least ratio of any two.
  double fly() {
    double least = 1e9;
    for (int k = 0; k < 2000; ++k) {
      const double t = 0.5 * k;
      think(t);
      bool flying = false;
      for (std::size_t i = 0; i < all_.size(); ++i) {
        One& a = *all_[i];
        const FlightPlan& plan = a.separator.plan();
        if (t > model::end_time_of(plan)) continue;
        flying = true;
        const model::FlightMoment m = model::moment_at(plan, t + 0.5);
        a.now = {m.p_N, m.v_N};
        for (std::size_t j = 0; j < i; ++j)
          if (t <= model::end_time_of(all_[j]->separator.plan()))
            least = std::min(least, ratio(a, *all_[j]));
      }
      if (!flying) return least;
    }
    ADD_FAILURE() << "somebody never arrives";
    return least;
  }

  double later(std::size_t k) const {
    return model::end_time_of(all_[k]->separator.plan()) -
           model::end_time_of(all_[k]->wanted.plan);
  }
  // Zones that only this one has to keep out of, and it can neither climb nor be faster.
  void confine(std::size_t k, std::vector<Zone> zones) {
    all_[k]->zones = std::move(zones);
    FlightLimits& limits = all_[k]->limits;
    limits.slowest = limits.fastest = limits.airspeed;
    limits.climb_rate = limits.sink_rate = 0.01;
  }
  const Separator& separator(std::size_t k) const { return all_[k]->separator; }
  void give(std::size_t k, FlightPriority priority) { all_[k]->priority = priority; }
  int messages() const { return messages_; }

 private:
  struct Moving {
    Vec3 p_N, v_N;
  };
  struct One {
    One(EntityId who, const SeparationOptions& options)
        : id(who), separator(who, options) {}
    EntityId id;
    Separator separator;
    WantedFlight wanted;
    FlightPriority priority = FlightPriority::kNormal;
    FlightLimits limits;
    std::vector<Zone> zones;
    Moving now;
    std::vector<Message> inbox;
  };
  struct Sent {
    double arrives;
    EntityId to;
    Message message;
  };

  static double ratio(const One& a, const One& b) {
    const Vec3 apart = a.now.p_N - b.now.p_N;
    return Separation{}.ratio(apart.head<2>().norm(), std::abs(apart.z()));
  }

  void think(double t) {
    for (auto& one : all_) {
      for (const Sent& sent : air_)
        if (sent.to == one->id && sent.arrives <= t) one->inbox.push_back(sent.message);
      one->separator.listen(Time::from_seconds(t), one->inbox);
      one->inbox.clear();
    }
    std::erase_if(air_, [&](const Sent& sent) { return sent.arrives <= t; });
    for (auto& one : all_) {
      std::vector<Message> out;
      PathQuery query;
      query.limits = one->limits;
      one->separator.step({Time::from_seconds(t),
                           one->now.p_N,
                           one->now.v_N,
                           0,
                           0,
                           one->priority,
                           query,
                           one->zones,
                           {},
                           flies_on(one->priority)},
                          one->wanted, out);
      for (Message& message : out) {
        ++messages_;
        message.from = one->id;
        message.sent = Time::from_seconds(t);
        for (const auto& other : all_)
          if (other->id != one->id &&
              (message.to == kEveryone || message.to == other->id) &&
              random_.uniform() >= loss_)
            air_.push_back({t + 0.1 + delay_, other->id, message});
      }
    }
  }

  SeparationMethod method_;
  double loss_, delay_;
  RandomStream random_{1, 1, Purpose::kTest};
  std::vector<std::unique_ptr<One>> all_;
  std::vector<Sent> air_;
  int messages_ = 0;
};

Sky head_on(SeparationMethod method, double loss = 0, double delay = 0) {
  Sky sky(method, loss, delay);
  sky.add(Vec3(0, 0, -100), Vec3(4000, 0, -100));
  sky.add(Vec3(4000, 10, -100), Vec3(0, 10, -100));
  return sky;
}

TEST(Separator, WithoutAMethodTwoMeet) {
  EXPECT_LT(head_on(SeparationMethod::kNone).fly(), 0.5);
}

TEST(Separator, EachMethodKeepsTwoApart) {
  for (const auto method : {SeparationMethod::kRule, SeparationMethod::kPriority,
                            SeparationMethod::kNegotiated, SeparationMethod::kAuto}) {
    Sky sky = head_on(method);
    EXPECT_GE(sky.fly(), 1) << name_of(method);
    EXPECT_LT(sky.later(0) + sky.later(1), 8) << name_of(method);
  }
}

TEST(Separator, ANegotiationChangesOneOrBothByLittle) {
  Sky sky = head_on(SeparationMethod::kNegotiated);
  EXPECT_GE(sky.fly(), 1);
  EXPECT_TRUE(sky.separator(0).changed() || sky.separator(1).changed());
  EXPECT_LT(sky.later(0) + sky.later(1), 2);
}

// Whoever it is, and whatever could be agreed on.
TEST(Separator, AllOthersGiveWayToWhoFliesOn) {
  for (const auto priority : {FlightPriority::kLanding, FlightPriority::kPilotFlies,
                              FlightPriority::kEmergency})
    for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
      Sky sky = head_on(SeparationMethod::kAuto);
      sky.give(first, priority);
      EXPECT_GE(sky.fly(), 1) << name_of(priority);
      EXPECT_FALSE(sky.separator(first).changed()) << name_of(priority);
      EXPECT_TRUE(sky.separator(1 - first).changed()) << name_of(priority);
    }
}

// What it says that it is off its plan by, having been 5 m off for some time.
Separation said_error(bool widens) {
  SeparationOptions options;
  options.method = SeparationMethod::kAuto;
  options.widens = widens;
  Separator separator(EntityId{1}, options);
  FlightElement e;
  e.p_N = Vec3(0, 0, -100);
  e.airspeed = 20;
  e.duration = 300;
  std::vector<Message> out;
  const PathQuery query;
  for (double t = 0; t < 30; ++t)
    separator.step({Time::from_seconds(t),
                    Vec3(20 * t, 5, -100),
                    Vec3(20, 0, 0),
                    3,
                    1,
                    FlightPriority::kNormal,
                    query,
                    {}},
                   {1, {e}, {300}}, out);
  Separation error{-1, -1};
  for (const Message& message : out)
    if (const auto* plan = std::get_if<PlanReport>(&message.content))
      error = {plan->across_error, plan->height_error};
  return error;
}

TEST(Separator, WhatIsKeptWidensByWhatIsMeasured) {
  // What is flown off the plan has shrunk by 10 % a minute for 25 to 29 s at most.
  const Separation error = said_error(true);
  EXPECT_GE(error.horizontal, std::hypot(8 * 0.95, 3 * 3));
  EXPECT_LE(error.horizontal, std::hypot(8, 3 * 3) + 0.5);
  EXPECT_GE(error.vertical, std::hypot(2 * 0.95, 3 * 1));
  EXPECT_LE(error.vertical, std::hypot(2, 3 * 1) + 0.5);
  EXPECT_EQ(said_error(false).horizontal, 0);
  EXPECT_EQ(said_error(false).vertical, 0);
}

TEST(Separator, LossAndDelayAreNormal) {
  for (const double loss : {0.0, 0.3, 0.5, 0.8})
    for (const double delay : {0.0, 2.0}) {
      Sky sky = head_on(SeparationMethod::kAuto, loss, delay);
      EXPECT_GE(sky.fly(), 1) << loss << " " << delay;
    }
}

// Straight on for 200 s from the origin, 100 m up.
FlightElement north() {
  FlightElement e;
  e.p_N = Vec3(0, 0, -100);
  e.airspeed = 20;
  e.duration = 200;
  return e;
}

// The same flight the other way, from somewhere else.
FlightElement southwards(FlightElement element, const Vec3& from) {
  element.p_N = from;
  element.heading = geo::kPi;
  return element;
}

// Aircraft 1 says to aircraft 2 that it flies this.
Message plan_of_one(const FlightElement& element) {
  PlanReport report;
  report.number = 1;
  report.flight = *model::coded_flight({element});
  return {EntityId{1}, EntityId{2}, 0, Time(), report};
}

// The ground is 60 m below: who has to sink goes no lower than its clearance.
class Plateau final : public Terrain {
 public:
  double elevation_msl(const Vec2&) const override { return 40; }
  Vec2 gradient(const Vec2&) const override { return Vec2::Zero(); }
};

TEST(Separator, TheLastMomentEndsAboveTheGround) {
  const Plateau ground;
  PathQuery query;
  query.terrain = &ground;
  query.ground_clearance = 50;
  SeparationOptions options;
  options.method = SeparationMethod::kAuto;
  const FlightElement to = north();
  const FlightElement back = southwards(to, Vec3(200, 0, -102));
  const Message message = plan_of_one(back);
  Separator separator(EntityId{2}, options);
  separator.listen(Time(), {&message, 1});
  std::vector<Message> out;
  separator.step(
      {Time(), to.p_N, Vec3(20, 0, 0), 0, 0, FlightPriority::kNormal, query, {}},
      {1, {to}, {200}}, out);
  ASSERT_TRUE(separator.changed());
  double lowest = 1e9;
  for (double t = 0; t < 60; ++t)
    lowest = std::min(lowest, -model::moment_at(separator.plan(), t).p_N.z());
  EXPECT_GE(lowest, 89.9) << "36 m lower were 64";
  const bool says_so = std::ranges::any_of(out, [&](const Message& said) {
    const auto* plan = std::get_if<PlanReport>(&said.content);
    return plan && plan->number == separator.number();
  });
  EXPECT_TRUE(says_so) << "others count with where it flies";
}

// The flight of an aircraft that is told of another seconds before they meet.
FlightPlan at_the_last_moment(EntityId self, const FlightElement& own,
                              const FlightElement& others,
                              const std::vector<Zone>& zones = {}) {
  SeparationOptions options;
  options.method = SeparationMethod::kAuto;
  Message message = plan_of_one(others);
  message.from = EntityId{3 - self.value};
  Separator separator(self, options);
  separator.listen(Time(), {&message, 1});
  std::vector<Message> out;
  const PathQuery query;
  separator.step(
      {Time(), own.p_N, Vec3(20, 0, 0), 0, 0, FlightPriority::kNormal, query, zones},
      {1, {own}, {200}}, out);
  return separator.plan();
}

TEST(Separator, TheLastMomentCountsWithTheClimbThatTheOtherHasSaid) {
  const FlightElement to = north();
  FlightElement back = southwards(to, Vec3(180, 0, -100));
  back.climb_rate = 3;
  const FlightPlan plan = at_the_last_moment(EntityId{1}, to, back);
  EXPECT_GT(model::moment_at(plan, 4).p_N.z(), -99)
      << "the lower number climbs only where both are as high as each other";
}

TEST(Separator, TheLastMomentTurnsWhereAClimbIsTooSlow) {
  const FlightElement to = north();
  const FlightElement back = southwards(to, Vec3(150, 10, -100));
  const FlightPlan plan = at_the_last_moment(EntityId{2}, to, back);
  double least = 1;
  for (double t = 0; t < 10; t += 0.1) {
    const Vec3 apart = model::moment_at({back}, t).p_N - model::moment_at(plan, t).p_N;
    least = std::min(
        least, Separation{50, 20}.ratio(apart.head<2>().norm(), std::abs(apart.z())));
  }
  EXPECT_GT(least, 0.75) << "straight on and 3 m/s down: 0.5";
}

TEST(Separator, TheLastMomentTurnsIntoNoZone) {
  std::vector<Zone> zones(2);
  zones[0].area = Disc{Vec2(60, 75), 60};
  zones[1].area = Disc{Vec2(60, -75), 60};
  const FlightElement to = north();
  const FlightElement back = southwards(to, Vec3(150, 10, -100));
  const FlightPlan plan = at_the_last_moment(EntityId{2}, to, back, zones);
  for (double t = 0; t < 6; t += 0.1) {
    const Vec2 p = model::moment_at(plan, t).p_N.head<2>();
    EXPECT_GT((p - Vec2(60, 75)).norm(), 60) << t;
    EXPECT_GT((p - Vec2(60, -75)).norm(), 60) << t;
  }
}

// Whoever is not where its plan has it is gone around, whatever its plan says.
TEST(Separator, AMemberOffItsPlanIsAnObstacle) {
  SeparationOptions options;
  options.method = SeparationMethod::kAuto;
  const FlightElement to = north();
  FlightElement elsewhere = to;
  elsewhere.p_N = Vec3(1000, 5000, -100);
  PlanReport report;
  report.number = 1;
  report.flight = *model::coded_flight({elsewhere});
  PlaceReport place;
  place.plan = 1;
  place.north = 400;
  place.down = -100;
  place.v_north = -20;
  // The lower id would have the right of way of two that keep to their plans.
  const EntityId self{1}, other{2};
  const std::vector<Message> heard = {{other, self, 0, Time(), report},
                                      {other, self, 0, Time(), place}};
  Separator separator(self, options);
  separator.listen(Time(), heard);
  std::vector<Message> out;
  const PathQuery query;
  separator.step(
      {Time(), to.p_N, Vec3(20, 0, 0), 0, 0, FlightPriority::kNormal, query, {}},
      {1, {to}, {200}}, out);
  EXPECT_TRUE(separator.changed());
  double least = 1e9;
  for (double t = 0; t < 20; t += 0.5) {
    const Vec3 apart =
        model::moment_at(separator.plan(), t).p_N - Vec3(400 - 20 * t, 0, -100);
    least =
        std::min(least, Separation{}.ratio(apart.head<2>().norm(), std::abs(apart.z())));
  }
  EXPECT_GE(least, 1);
}

// What lies left and right of the way north from the origin.
std::vector<Zone> corridor() {
  const auto box = [](double west, double east) {
    Zone zone;
    zone.area = made_positive(
        {Vec2(-500, west), Vec2(-500, east), Vec2(2500, east), Vec2(2500, west)});
    return zone;
  };
  return {box(-2000, -40), box(40, 2000)};
}

// The lower one flies in a corridor and cannot get out of the way.
Sky crossing_a_corridor(double loss = 0, double delay = 0) {
  Sky sky(SeparationMethod::kPriority, loss, delay);
  sky.add(Vec3(1600, 1600, -100), Vec3(1600, -1600, -100));
  sky.add(Vec3(0, 0, -100), Vec3(4000, 0, -100));
  sky.confine(1, corridor());
  return sky;
}

TEST(Separator, WhoFindsNoFlightAsksTheHigherOneToGiveWay) {
  for (const double loss : {0.0, 0.3, 0.5}) {
    Sky sky = crossing_a_corridor(loss, loss > 0 ? 1 : 0);
    EXPECT_GE(sky.fly(), 1) << loss;
    EXPECT_TRUE(sky.separator(0).reason().starts_with("gives way")) << loss;
    EXPECT_FALSE(sky.separator(1).changed()) << loss;
  }
}

TEST(Separator, WhoIsOfAHigherClassIsNotAskedToGiveWay) {
  Sky sky = crossing_a_corridor();
  sky.give(0, FlightPriority::kManned);
  sky.fly();
  EXPECT_NE(sky.separator(0).reason(), "gives way as asked");
}

// One that has the way, and what it answers to a lower one that comes head-on.
class Asked {
 public:
  explicit Asked(SeparationMethod method) {
    SeparationOptions options;
    options.method = method;
    separator_.emplace(EntityId{1}, options);
    FlightElement back = north();
    back.p_N = Vec3(2400, 0, -100);
    back.heading = geo::kPi;
    report_.number = 3;
    report_.flight = *model::coded_flight({back});
  }

  // @returns  the answer to a request; none: there is none.
  std::optional<YieldAnswer> ask(const YieldRequest& request, double t,
                                 std::vector<Zone> zones = {}) {
    const EntityId self{1}, other{2};
    const Time now = Time::from_seconds(t);
    const std::vector<Message> heard = {{other, self, 0, now, report_},
                                        {other, self, 0, now, request}};
    separator_->listen(now, heard);
    std::vector<Message> out;
    PathQuery query;
    const FlightElement to = north();
    separator_->step({now, to.p_N + Vec3(20 * t, 0, 0), Vec3(20, 0, 0), 0, 0,
                      FlightPriority::kNormal, query, zones},
                     {1, {to}, {200}}, out);
    for (const Message& message : out)
      if (const auto* answer = std::get_if<YieldAnswer>(&message.content)) return *answer;
    return std::nullopt;
  }
  const Separator& separator() const { return *separator_; }

 private:
  std::optional<Separator> separator_;
  PlanReport report_;
};

TEST(Separator, GivesWayOnceWhenAsked) {
  Asked one(SeparationMethod::kPriority);
  EXPECT_FALSE(one.ask({1, 2, 1, 59, 61}, 0)) << "of a plan that it does not know yet";
  EXPECT_FALSE(one.separator().changed());
  const auto answer = one.ask({1, 3, 1, 59, 61}, 1);
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->granted);
  EXPECT_EQ(one.separator().number(), 2u) << "it flies another plan";
  const auto again = one.ask({1, 3, 1, 59, 61}, 2);
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->granted) << "the same request, the same answer";
  const auto other = one.ask({2, 3, 2, 59, 61}, 3);
  ASSERT_TRUE(other);
  EXPECT_FALSE(other->granted);
  EXPECT_EQ(one.separator().number(), 2u);
}

TEST(Separator, RefusesToGiveWayWhereItCannot) {
  Asked between(SeparationMethod::kPriority);
  std::vector<Zone> all_around = corridor();
  all_around.push_back(all_around.front());
  all_around.back().area = made_positive(
      {Vec2(-500, -2000), Vec2(-500, 2000), Vec2(2500, 2000), Vec2(2500, -2000)});
  all_around.back().floor_msl = 101;
  all_around.push_back(all_around.back());
  all_around.back().floor_msl = -1000;
  all_around.back().ceiling_msl = 99;
  const auto answer = between.ask({1, 3, 1, 59, 61}, 0, all_around);
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->granted);
  EXPECT_FALSE(between.separator().changed());

  Asked by_rule(SeparationMethod::kRule);
  const auto none = by_rule.ask({1, 3, 1, 59, 61}, 0);
  ASSERT_TRUE(none);
  EXPECT_FALSE(none->granted) << "it does not fly by priorities";

  Asked other_plan(SeparationMethod::kPriority);
  const auto late = other_plan.ask({1, 3, 7, 59, 61}, 0);
  ASSERT_TRUE(late);
  EXPECT_FALSE(late->granted) << "that is not what it flies";
}

TEST(Separator, ARequestThatMakesNoSenseChangesNothing) {
  for (const float apart : {std::nanf(""), -5.0F, 1e9F}) {
    Asked one(SeparationMethod::kPriority);
    const auto answer = one.ask({1, 3, 1, apart, apart}, 0);
    ASSERT_TRUE(answer) << apart;
    EXPECT_FALSE(answer->granted) << apart;
    EXPECT_FALSE(one.separator().changed()) << apart;
  }
}

// A conflict that comes later than flights are looked at is not taken for solved.
TEST(Separator, AFlightIsApartUntilAfterTheConflict) {
  SeparationOptions options;
  options.method = SeparationMethod::kPriority;
  options.horizon = 300;
  FlightElement to = north();
  to.duration = 400;
  const FlightElement back = southwards(to, Vec3(8000, 20, -100));
  const Message message = plan_of_one(back);
  Separator separator(EntityId{2}, options);
  separator.listen(Time(), {&message, 1});
  std::vector<Message> out;
  const PathQuery query;
  separator.step(
      {Time(), to.p_N, Vec3(20, 0, 0), 0, 0, FlightPriority::kNormal, query, {}},
      {1, {to}, {400}}, out);
  ASSERT_TRUE(separator.changed());
  double least = 1e9;
  for (double t = 0; t < 400; t += 0.5) {
    const Vec3 apart =
        model::moment_at(separator.plan(), t).p_N - model::moment_at({back}, t).p_N;
    least =
        std::min(least, Separation{}.ratio(apart.head<2>().norm(), std::abs(apart.z())));
  }
  EXPECT_GE(least, 1);
  EXPECT_EQ(separator.number(), 2u) << "it is changed once";
}

TEST(Separator, ManyOnACircleAreKeptApart) {
  for (const auto method : {SeparationMethod::kNegotiated, SeparationMethod::kAuto}) {
    Sky sky(method);
    constexpr int kAll = 12;
    for (int k = 0; k < kAll; ++k) {
      const Vec2 out = 2000 * geo::unit(2 * geo::kPi * k / kAll + 0.01 * (k % 3));
      sky.add(Vec3(out.x(), out.y(), -150), Vec3(-out.x(), -out.y(), -150));
    }
    EXPECT_GE(sky.fly(), 1) << name_of(method);
    double later = 0;
    for (int k = 0; k < kAll; ++k) later += sky.later(static_cast<std::size_t>(k));
    EXPECT_LT(later / kAll, 10) << name_of(method);
  }
}

}  // namespace
}  // namespace skein::reasoning::separator_test
