// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/avoidance/landing/landing_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <set>

#include "skein/base/random.h"

namespace skein::reasoning::landing_queue_test {
namespace {

constexpr double kStep = 0.5;      // of agents [s]
constexpr double kLanding = 100;   // that one takes [s]
constexpr double kLevelStep = 60;  // [m]

// Aircraft that come to one place, and a radio that loses and delays. Who has its turn
// stands on the ground after 100 s.
class Field {
 public:
  explicit Field(double loss = 0, double delay = 0) : loss_(loss), delay_(delay) {}

  struct One {
    One(EntityId who, double left) : id(who), queue(who, kLevelStep), endurance(left) {}
    EntityId id;
    LandingQueue queue;
    double endurance;
    double comes = 0, dies = 1e9;  // [s]
    bool emergency = false;
    bool lands_at_all = true;
    double altitude = 150;
    std::optional<double> turn, landed;  // when [s]
    LandingTurn now;
    std::vector<Message> inbox;
  };

  One& add(double endurance) {
    const auto id = static_cast<std::uint32_t>(all_.size() + 1);
    all_.push_back(std::make_unique<One>(EntityId{id}, endurance));
    return *all_.back();
  }

  void fly(double duration) {
    for (double t = 0; t <= duration; t += kStep) step(t);
  }

  One& at(std::size_t k) { return *all_[k]; }
  double together() const { return together_; }      ///< two land at once for so long [s]
  double one_height() const { return one_height_; }  ///< two wait at one [s]
  bool all_landed() const {
    return std::ranges::all_of(all_,
                               [](const auto& one) { return one->landed.has_value(); });
  }

 private:
  struct Sent {
    double arrives;
    EntityId to;
    Message message;
  };

  void step(double t) {
    for (auto& one : all_) {
      for (const Sent& sent : air_)
        if (sent.to == one->id && sent.arrives <= t) one->inbox.push_back(sent.message);
      one->queue.listen(Time::from_seconds(t), one->inbox);
      one->inbox.clear();
    }
    std::erase_if(air_, [&](const Sent& sent) { return sent.arrives <= t; });
    for (auto& one : all_)
      if (t >= one->comes && t < one->dies) think(*one, t);
    look(t);
  }

  void think(One& one, double t) {
    std::vector<Message> out;
    if (one.landed) {
      one.queue.stand(Time::from_seconds(t), Vec3::Zero(), loss_, delay_, out);
    } else {
      LandingStep step;
      step.now = Time::from_seconds(t);
      step.p_N = Vec3(-500, 0, -one.altitude);
      step.wind = Vec2(-4, 0);
      step.endurance = one.endurance - t;
      step.lasts = kLanding;
      step.loss = loss_;
      step.delay = delay_;
      step.emergency = one.emergency;
      one.now = one.queue.step(step, out);
      if (!one.now.lands)
        one.turn.reset();
      else if (!one.turn)
        one.turn = t;
      if (one.turn && one.lands_at_all && t - *one.turn >= kLanding) one.landed = t;
    }
    for (Message& message : out) {
      message.from = one.id;
      message.sent = Time::from_seconds(t);
      for (const auto& other : all_)
        if (other->id != one.id && random_.uniform() >= loss_)
          air_.push_back({t + 0.1 + delay_, other->id, message});
    }
  }

  void look(double t) {
    int landing = 0;
    std::set<double> heights;
    bool same = false;
    for (const auto& one : all_) {
      if (t < one->comes + settle_ || t >= one->dies || one->landed) continue;
      if (one->now.lands)
        ++landing;
      else
        same = !heights.insert(one->now.altitude_msl).second || same;
    }
    if (landing > 1) together_ += kStep;
    if (same) one_height_ += kStep;
  }

  double loss_, delay_;
  double settle_ = 1;
  RandomStream random_{1, 1, Purpose::kTest};
  std::vector<std::unique_ptr<One>> all_;
  std::vector<Sent> air_;
  double together_ = 0, one_height_ = 0;
};

TEST(LandingQueue, OneAloneLandsAtOnce) {
  Field field;
  field.add(900);
  field.fly(120);
  ASSERT_TRUE(field.at(0).landed);
  EXPECT_LE(*field.at(0).turn, 7) << "four reports that nobody has sent, and a second";
}

TEST(LandingQueue, WhoHasLeastLeftLandsFirst) {
  Field field;
  for (const double endurance : {900, 600, 1200, 700}) field.add(endurance);
  field.fly(600);
  ASSERT_TRUE(field.all_landed());
  EXPECT_EQ(field.together(), 0);
  EXPECT_LT(*field.at(1).landed, *field.at(3).landed);
  EXPECT_LT(*field.at(3).landed, *field.at(0).landed);
  EXPECT_LT(*field.at(0).landed, *field.at(2).landed);
}

TEST(LandingQueue, AmongEqualOnesTheLowerIdLandsFirst) {
  Field field;
  for (int k = 0; k < 3; ++k) field.add(86400);
  field.fly(400);
  ASSERT_TRUE(field.all_landed());
  EXPECT_LT(*field.at(0).landed, *field.at(1).landed);
  EXPECT_LT(*field.at(1).landed, *field.at(2).landed);
}

TEST(LandingQueue, EachWaitsAtAHeightOfItsOwn) {
  Field field;
  for (int k = 0; k < 5; ++k) field.add(900);
  field.fly(60);
  std::set<double> heights;
  for (std::size_t k = 0; k < 5; ++k) {
    const double height = field.at(k).now.altitude_msl;
    EXPECT_GE(height, 100) << "above who approaches";
    for (const double other : heights)
      EXPECT_GE(std::abs(height - other), kLevelStep - 1e-6);
    heights.insert(height);
  }
  EXPECT_LT(field.one_height(), 10) << "until they have heard of each other";
}

// The chance that two land at once, as neither has heard of the other, is 1e-4 for each
// claim at any loss; where nine of ten are lost more than it is counted with.
TEST(LandingQueue, LossAndDelayAreNormal) {
  for (const double loss : {0.3, 0.5, 0.8})
    for (const double delay : {0.0, 2.0}) {
      Field field(loss, delay);
      for (const double endurance : {900, 600, 1200, 700}) field.add(endurance);
      field.fly(1200);
      EXPECT_TRUE(field.all_landed()) << loss << " " << delay;
      EXPECT_EQ(field.together(), 0) << loss << " " << delay;
    }
}

TEST(LandingQueue, WhoComesLaterWithLessGoesBeforeThoseThatWait) {
  Field field;
  for (const double endurance : {900, 1000, 1100}) field.add(endurance);
  field.add(500).comes = 50;
  field.fly(600);
  ASSERT_TRUE(field.all_landed());
  EXPECT_LT(*field.at(0).landed, *field.at(3).landed) << "it had its turn already";
  EXPECT_LT(*field.at(3).landed, *field.at(1).landed);
  EXPECT_EQ(field.together(), 0);
}

TEST(LandingQueue, NobodyWaitsForWhoHasFallenSilent) {
  Field field;
  field.add(500).dies = 30;  // on its approach
  field.add(900);
  field.fly(600);
  ASSERT_TRUE(field.at(1).turn);
  // Half as long again as it has said, 30 s, and the claim.
  EXPECT_GT(*field.at(1).turn, 30 + kLanding) << "it may still be there";
  EXPECT_LT(*field.at(1).turn, 30 + 1.5 * kLanding + 30 + 10);
}

TEST(LandingQueue, ATurnThatIsNotUsedIsGivenBack) {
  Field field;
  field.add(500).lands_at_all = false;
  field.add(900);
  field.fly(1500);
  EXPECT_TRUE(field.at(1).landed);
}

TEST(LandingQueue, AnEmergencyLandsWhoeverHasTheTurn) {
  Field field;
  field.add(500);
  Field::One& late = field.add(900);
  late.comes = 40;
  late.emergency = true;
  field.fly(600);
  ASSERT_TRUE(field.all_landed());
  EXPECT_LE(*field.at(1).landed, 40 + kLanding + 1);
  EXPECT_GT(*field.at(0).landed, *field.at(1).landed) << "it has broken off";
}

TEST(LandingQueue, AllApproachOnOneCourse) {
  Field field;
  for (int k = 0; k < 3; ++k) field.add(900);
  field.fly(20);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(field.at(k).now.course, 0, 1e-6) << "the wind comes from the north";
}

TEST(LandingQueue, WhatMakesNoSenseChangesNothing) {
  LandingQueue queue(EntityId{2}, kLevelStep);
  LandingReport broken;
  broken.phase = LandingPhase::kLands;
  broken.lasts = std::numeric_limits<float>::infinity();
  const Message message{EntityId{1}, kEveryone, 0, Time(), broken};
  LandingTurn turn;
  for (double t = 0; t < 20; t += kStep) {
    queue.listen(Time::from_seconds(t), {&message, 1});
    LandingStep step;
    step.now = Time::from_seconds(t);
    std::vector<Message> out;
    turn = queue.step(step, out);
  }
  EXPECT_TRUE(turn.lands);
}

}  // namespace
}  // namespace skein::reasoning::landing_queue_test
