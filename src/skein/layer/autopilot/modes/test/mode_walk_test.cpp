// SPDX-License-Identifier: Apache-2.0
// Model-based random walk: modes, pilot, commands and faults come and go at random times.
// After each step the decision is compared with the reference model's, and properties
// that must hold whatever the rules in detail are checked without it.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include "skein/base/random.h"
#include "skein/layer/autopilot/modes/mode_logic.h"
#include "skein/layer/autopilot/modes/test/reference_model.h"

namespace skein::autopilot::mode_walk_test {
namespace {

constexpr long kStepMs = 20;

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed, 0, Purpose::kTest) {}
  long below(long count) {
    return static_cast<long>(random_.bits() % static_cast<std::uint64_t>(count));
  }
  bool chance(double probability) { return random_.uniform() < probability; }
  double ms(long longest) { return static_cast<double>(below(longest + 1)) / 1e3; }

 private:
  RandomStream random_;
};

FailsafeRule random_rule(Dice& dice) {
  FailsafeRule rule;
  rule.delay = dice.chance(0.2) ? 0 : dice.ms(2000);
  rule.reaction = static_cast<FailsafeReaction>(dice.below(5));
  rule.resumes = dice.chance(0.5);
  if (rule.reaction < FailsafeReaction::kDescend && dice.chance(0.5)) {
    rule.escalates_after = 0.001 + dice.ms(3000);
    const long first = static_cast<long>(rule.reaction) + 1;
    rule.escalates_to = static_cast<FailsafeReaction>(first + dice.below(5 - first));
  }
  return rule;
}

FailsafeOptions random_options(Dice& dice) {
  FailsafeOptions options;
  for (FailsafeRule* rule :
       {&options.link, &options.battery_low, &options.geofence, &options.gnss,
        &options.battery_critical, &options.motor, &options.imu})
    *rule = random_rule(dice);
  options.recovery = dice.ms(1500);
  options.max_clears = static_cast<int>(dice.below(5));
  options.pilot_silence = dice.ms(600);
  options.ground_time = dice.ms(500);
  return options;
}

// What the walker does to the vehicle; kept apart from what the logic makes of it.
struct Surroundings {
  bool link = true, gnss = true, transmitter = false;
  ModeInput in;

  void advance(Dice& dice) {
    in.now += Time::from_ns(kStepMs * 1'000'000);
    in.command = CommandKind::kNone;
    // Neither is received at every step.
    if (link && dice.chance(0.3)) in.link_heard = in.now;
    if (gnss && dice.chance(0.3)) in.gnss_fix = in.now;
    if (transmitter && (!in.pilot || dice.chance(0.5))) {
      if (!in.pilot) in.pilot.emplace();
      in.pilot->time = in.now;
    }
  }

  // Faults come less often than they go, or all flights would be about many at once.
  static bool toggled(bool wrong, double probability, Dice& dice) {
    return !wrong && dice.chance(probability);
  }

  // Changes one thing.
  void act(Dice& dice) {
    switch (dice.below(17)) {
      case 0:
        link = !toggled(!link, 0.4, dice);
        break;
      case 1:
        gnss = !toggled(!gnss, 0.4, dice);
        break;
      case 2:
        in.estimator_healthy = !toggled(!in.estimator_healthy, 0.4, dice);
        break;
      case 3:
        in.outside_fence = toggled(in.outside_fence, 0.4, dice);
        break;
      // These last, so they come seldom.
      case 4:
        in.motor_failed = toggled(in.motor_failed, 0.1, dice);
        break;
      case 5:
        drain(dice);
        break;
      case 6:
        transmitter = !transmitter;
        break;
      case 7:
      case 8:
      case 9:
        switch_transmitter(dice);
        break;
      case 10:
      case 11:
      case 12:
        in.command = static_cast<CommandKind>(1 + dice.below(4));
        break;
      case 13:
        in.on_ground = toggled(in.on_ground, 0.3, dice);
        break;
      case 14:
        in.done = !in.done;
        break;
      case 15:
        in.imu_lost = toggled(in.imu_lost, 0.3, dice);
        break;
      default:
        if (dice.chance(0.5))
          in.landed = !in.landed;
        else
          in.committed = !in.committed;
    }
  }

  void drain(Dice& dice) {
    in.charge *= 0.95;
    in.charge_home = dice.chance(0.05) ? 0.9 : 0.05;
    if (dice.chance(0.05)) in.charge = dice.chance(0.5) ? 0.04 : 0.06;
  }

  void switch_transmitter(Dice& dice) {
    transmitter = true;
    in.pilot.emplace();
    in.pilot->time = in.now;
    in.pilot->takes_over = dice.chance(0.5);
    in.pilot->mode = static_cast<FlightMode>(dice.below(4));
  }
};

// How long each condition has been there, for the time to react.
struct Stopwatch {
  long fence = -1, unhealthy = -1, low = -1, critical = -1, motor = -1, imu = -1;

  static void run(long& ms, bool bad) { ms = !bad ? -1 : ms < 0 ? 0 : ms + kStepMs; }
  void run(const ModeInput& in, const FailsafeOptions& options) {
    run(fence, in.outside_fence);
    run(unhealthy, !in.estimator_healthy);
    run(low, in.charge - in.charge_home < options.battery_reserve);
    run(critical, in.charge < options.battery_critical_at);
    run(motor, in.motor_failed);
    run(imu, in.imu_lost);
  }
};

struct Seen {
  long steps = 0, inputs = 0, transitions = 0;
  std::set<Order> taken_from;  // by the pilot
  std::set<std::pair<Order, Order>> orders;
  std::set<std::pair<Failsafe, FlightMode>> raised_in;
  std::set<std::tuple<FailsafeTrigger, FailsafeReaction, AirframeKind>> reactions;
};

class Flight {
 public:
  Flight(const FailsafeOptions& options, AirframeKind airframe, Dice& dice, Seen& seen)
      : options_(options),
        airframe_(airframe),
        rules_(options, airframe),
        logic_(rules_),
        reference_(options, airframe, kStepMs),
        dice_(dice),
        seen_(seen) {
    world_.in.link_heard = dice.chance(0.9) ? Time() : kNotFitted;
    world_.in.gnss_fix = dice.chance(0.9) ? Time() : kNotFitted;
    world_.link = world_.in.link_heard != kNotFitted;
    world_.gnss = world_.in.gnss_fix != kNotFitted;
    world_.in.on_ground = dice.chance(0.4);
  }

  void walk(int changes, long longest_pause) {
    for (int k = 0; k < changes; ++k) {
      world_.advance(dice_);
      world_.act(dice_);
      ++seen_.inputs;
      if (!step()) return;
      for (long pause = dice_.below(longest_pause); pause > 0; --pause) {
        world_.advance(dice_);
        if (!step()) return;
      }
    }
  }

 private:
  bool step() {
    const Decision before = logic_.decision();
    const Decision d = logic_.step(world_.in);
    watch_.run(world_.in, options_);
    agree(d, reference_.step(world_.in));
    complete(d);
    pilot_first(d);
    in_time(d);
    no_cycle(before, d);
    record(before, d);
    return !testing::Test::HasFailure();
  }

  void agree(const Decision& d, const ReferenceModel::Answer& expected) const {
    EXPECT_EQ(d.order, expected.order) << where();
    EXPECT_EQ(d.mode, expected.mode) << where();
    EXPECT_EQ(d.state, expected.state) << where();
    EXPECT_EQ(d.trigger, expected.trigger) << where();
    EXPECT_EQ(d.reaction, expected.reaction) << where();
    for (std::size_t i = 0; i < kFailsafes; ++i)
      EXPECT_EQ(d.raised.has(static_cast<Failsafe>(i)), expected.raised[i])
          << i << " " << where();
  }

  // Somebody always flies, by something that is known.
  void complete(const Decision& d) const {
    EXPECT_EQ(d.order == Order::kStand, d.state != ArmingState::kFlying) << where();
    if (d.order == Order::kAgent) {
      EXPECT_NE(logic_.agent_command(), CommandKind::kNone) << where();
    }
    if (d.reaction != FailsafeReaction::kNone) {
      EXPECT_NE(d.trigger, FailsafeTrigger::kNone) << where();
      EXPECT_EQ(d.mode, FlightMode::kAuto) << where();
    }
    EXPECT_EQ(d.without_motor, d.raised.has(Failsafe::kMotor)) << where();
    EXPECT_EQ(d.without_position, d.raised.has(Failsafe::kGnss)) << where();
    EXPECT_EQ(d.without_attitude, d.raised.has(Failsafe::kImu)) << where();
  }

  void pilot_first(const Decision& d) const {
    const auto& pilot = world_.in.pilot;
    const bool flies =
        pilot && pilot->takes_over &&
        (world_.in.now - pilot->time).seconds() <= options_.pilot_silence + 1e-9;
    EXPECT_EQ(d.order == Order::kPilot, flies) << where();
    if (!flies) return;
    EXPECT_EQ(d.mode, pilot->mode == FlightMode::kManual ? FlightMode::kManual
                                                         : FlightMode::kStabilized)
        << where();
    EXPECT_EQ(d.reaction, FailsafeReaction::kNone) << where();
  }

  // A condition that has lasted its delay is raised at that step, not later.
  void in_time(const Decision& d) const {
    const auto due = [&](long ms, const FailsafeRule& rule, Failsafe failsafe) {
      if (ms >= 0 && static_cast<double>(ms) >= rule.delay * 1e3) {
        EXPECT_TRUE(d.raised.has(failsafe)) << where();
      }
    };
    due(watch_.fence, options_.geofence, Failsafe::kGeofence);
    due(watch_.unhealthy, options_.gnss, Failsafe::kGnss);
    due(watch_.low, options_.battery_low, Failsafe::kBatteryLow);
    due(watch_.critical, options_.battery_critical, Failsafe::kBatteryCritical);
    due(watch_.motor, options_.motor, Failsafe::kMotor);
    due(watch_.imu, options_.imu, Failsafe::kImu);
    const double link_silence = (world_.in.now - world_.in.link_heard).seconds();
    if (link_silence > options_.link.delay + 1e-9) {
      EXPECT_TRUE(d.raised.has(Failsafe::kLink)) << where();
    }
    const double gnss_silence = (world_.in.now - world_.in.gnss_fix).seconds();
    if (gnss_silence > options_.gnss.delay + 1e-9) {
      EXPECT_TRUE(d.raised.has(Failsafe::kGnss)) << where();
    }
  }

  void no_cycle(const Decision& before, const Decision& d) {
    for (const Failsafe f :
         {Failsafe::kBatteryLow, Failsafe::kBatteryCritical, Failsafe::kMotor}) {
      if (before.raised.has(f)) {
        EXPECT_TRUE(d.raised.has(f)) << where();
      }
    }
    if (d.events.has(ModeEvent::kTookOff)) clears_ = {};
    for (std::size_t i = 0; i < kFailsafes; ++i) {
      if (before.order == Order::kStand || !d.cleared_now.has(static_cast<Failsafe>(i)))
        continue;
      EXPECT_LE(++clears_[i], options_.max_clears) << where();
    }
    // With the same thing to react to, and the same things wrong, the reaction never gets
    // weaker. (A landing too far on is the exception: its end may be a go-around.)
    const bool both_act = before.reaction != FailsafeReaction::kNone &&
                          d.reaction != FailsafeReaction::kNone;
    const bool which_battery =
        d.raised.has(Failsafe::kBatteryLow) && d.raised.has(Failsafe::kBatteryCritical);
    if (both_act && before.raised == d.raised && before.trigger == d.trigger &&
        !(which_battery && d.trigger == FailsafeTrigger::kBattery) && !was_committed_) {
      EXPECT_GE(d.reaction, before.reaction) << where();
    }
    was_committed_ = world_.in.committed;
    // Without an event nothing changes.
    if (d.events.empty()) {
      EXPECT_EQ(d.order, before.order) << where();
      EXPECT_EQ(d.mode, before.mode) << where();
      EXPECT_EQ(d.raised, before.raised) << where();
    }
  }

  void record(const Decision& before, const Decision& d) {
    ++seen_.steps;
    if (!d.events.empty()) ++seen_.transitions;
    seen_.orders.insert({before.order, d.order});
    if (d.events.has(ModeEvent::kPilotTookOver)) seen_.taken_from.insert(before.order);
    for (std::size_t i = 0; i < kFailsafes; ++i)
      if (d.raised_now.has(static_cast<Failsafe>(i)))
        seen_.raised_in.insert({static_cast<Failsafe>(i), before.mode});
    seen_.reactions.insert({d.trigger, d.reaction, airframe_});
  }

  std::string where() const {
    return "at step " + std::to_string(seen_.steps) + " of the walk, " +
           std::to_string(world_.in.now.seconds()) + " s";
  }

  FailsafeOptions options_;
  AirframeKind airframe_;
  ModeRules rules_;
  ModeLogic logic_;
  ReferenceModel reference_;
  Dice& dice_;
  Seen& seen_;
  Surroundings world_;
  Stopwatch watch_;
  std::array<int, kFailsafes> clears_{};
  bool was_committed_ = false;
};

AirframeKind random_airframe(Dice& dice) {
  return dice.chance(0.5) ? AirframeKind::kFixedWing : AirframeKind::kMultirotor;
}

TEST(ModeWalk, AgreesWithTheReferenceOverAHundredThousandTransitions) {
  Dice dice(3);
  Seen seen;
  for (int flight = 0; flight < 2000 && !HasFailure(); ++flight) {
    const FailsafeOptions options = random_options(dice);
    Flight(options, random_airframe(dice), dice, seen).walk(120, 40);
  }
  RecordProperty("steps", static_cast<int>(seen.steps));
  RecordProperty("inputs", static_cast<int>(seen.inputs));
  RecordProperty("transitions", static_cast<int>(seen.transitions));
  EXPECT_GE(seen.transitions, 100'000);
  // The walk was everywhere: the pilot took over from every order but his own, each
  // failsafe was raised in each mode, and every order was reached from and left to
  // others.
  EXPECT_EQ(seen.taken_from.size(), 7u);
  EXPECT_EQ(seen.raised_in.size(), kFailsafes * 4);
  for (int order = 0; order < 8; ++order) {
    const auto leaves = [&](const auto& pair) {
      return pair.first == static_cast<Order>(order) && pair.second != pair.first;
    };
    EXPECT_TRUE(std::any_of(seen.orders.begin(), seen.orders.end(), leaves)) << order;
  }
  // Every reaction to every trigger that an airframe can fly, and no other. Link,
  // battery, geofence: all five. Motor, inertial unit: reported or down. No position:
  // reported or down, a fixed wing also holds, or finishes its landing. And nothing to
  // nothing.
  EXPECT_EQ(seen.reactions.size(), (3u * 5 + 2 * 2 + 4 + 1) + (3u * 5 + 2 * 2 + 2 + 1));
}

TEST(ModeWalk, AgreesWithTheReferenceWithTheDefaults) {
  Dice dice(4);
  Seen seen;
  for (int flight = 0; flight < 400 && !HasFailure(); ++flight)
    Flight(FailsafeOptions{}, random_airframe(dice), dice, seen).walk(120, 150);
  EXPECT_GE(seen.transitions, 10'000);
}

}  // namespace
}  // namespace skein::autopilot::mode_walk_test
