// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/modes/mode_logic.h"

#include "skein/base/check.h"
#include "skein/layer/autopilot/modes/mode_digest.h"

namespace skein::autopilot {
namespace {

Order order_of(FailsafeReaction reaction) {
  switch (reaction) {
    case FailsafeReaction::kHold:
      return Order::kHold;
    case FailsafeReaction::kReturn:
      return Order::kReturn;
    case FailsafeReaction::kLand:
      return Order::kLand;
    case FailsafeReaction::kDescend:
      return Order::kDescend;
    case FailsafeReaction::kNone:
      break;
  }
  SKEIN_CHECK(false, static_cast<int>(reaction));
  return Order::kHold;
}

struct KindOfCommand {
  CommandKind operator()(const FollowPath&) const { return CommandKind::kGuided; }
  CommandKind operator()(const HoldCourse&) const { return CommandKind::kGuided; }
  CommandKind operator()(const HoldBank&) const { return CommandKind::kGuided; }
  CommandKind operator()(const Circle&) const { return CommandKind::kGuided; }
  CommandKind operator()(const HoldPosition&) const { return CommandKind::kGuided; }
  CommandKind operator()(const FollowPlan&) const { return CommandKind::kMission; }
  CommandKind operator()(const FlyWaypoints&) const { return CommandKind::kMission; }
  CommandKind operator()(const TakeOff&) const { return CommandKind::kTakeOff; }
  CommandKind operator()(const Land&) const { return CommandKind::kLand; }
  CommandKind operator()(const Return&) const { return CommandKind::kMission; }
};

}  // namespace

CommandKind kind_of(const AutopilotCommand& command) {
  return std::visit(KindOfCommand{}, command.guidance);
}

ModeRules::ModeRules(const FailsafeOptions& options, AirframeKind airframe)
    : rules_{made_ready(options.link),
             made_ready(options.battery_low),
             made_ready(options.geofence),
             made_ready(options.gnss),
             made_ready(options.battery_critical),
             made_ready(options.motor),
             made_ready(options.imu)},
      battery_reserve_(options.battery_reserve),
      battery_critical_at_(options.battery_critical_at),
      recovery_(Time::from_seconds(options.recovery)),
      pilot_silence_(Time::from_seconds(options.pilot_silence)),
      ground_time_(Time::from_seconds(options.ground_time)),
      max_clears_(options.max_clears),
      airframe_(airframe) {
  const auto fault = error_in(options);
  SKEIN_CHECK(!fault, *fault);
}

ModeRules::Rule ModeRules::made_ready(const FailsafeRule& rule) {
  return {Time::from_seconds(rule.delay), Time::from_seconds(rule.escalates_after),
          rule.reaction, rule.escalates_to, rule.resumes};
}

const Decision& ModeLogic::think(const ModeInput& in) {
  digest_ = digest(in);
  wake_ = kNotFitted;
  decision_.events = {};
  decision_.raised_now = {};
  decision_.cleared_now = {};
  if (!begun_) {
    begun_ = true;
    touches_ = grounded_ = standing_ = in.on_ground;
  }
  hear_pilot();
  feel_ground(in);
  if (in.command != CommandKind::kNone) agent_ = in.command;
  const bool released = in.command != CommandKind::kNone || handed_back_;
  for (std::size_t i = 0; i < kFailsafes; ++i)
    watch(in.now, static_cast<Failsafe>(i), released);
  decide(in);
  // What has changed now may let something else happen at the next step.
  if (!decision_.events.empty()) wake_ = Time();
  return decision_;
}

FailsafeReaction ModeLogic::reaction_of(Failsafe failsafe, Time now) const {
  const std::size_t i = mode_bits::place(failsafe);
  const ModeRules::Rule& rule = rules_->rules_[i];
  const bool escalated =
      rule.escalates_after > Time() && now - raised_at_[i] >= rule.escalates_after;
  return escalated ? rule.escalates_to : rule.reaction;
}

std::optional<Failsafe> ModeLogic::acting(Time now) const {
  for (std::size_t i = kFailsafes; i-- > 0;) {
    const auto failsafe = static_cast<Failsafe>(i);
    if (decision_.raised.has(failsafe) &&
        reaction_of(failsafe, now) != FailsafeReaction::kNone)
      return failsafe;
  }
  return std::nullopt;
}

void ModeLogic::decide(const ModeInput& in) {
  const FlightMode mode_before = decision_.mode;
  const Order order_before = decision_.order;
  const FailsafeReaction reaction_before = decision_.reaction;
  const std::optional<Failsafe> failsafe = acting(in.now);
  if (decision_.raised.has(Failsafe::kBatteryCritical))
    home_lost_ = home_lost_ || mode_bits::has(digest_, mode_bits::kHomeOutOfReach);

  if (pilot_flies_) {
    standing_ = false;
    if (grounded_) taking_off_ = false;
  } else {
    if (!standing_ && comes_to_stand(in, failsafe.has_value())) stand(in);
    if (standing_ && in.command == CommandKind::kTakeOff) take_off(failsafe.has_value());
  }
  if (!standing_ && !grounded_) has_flown_ = true;

  decision_.reaction = FailsafeReaction::kNone;
  if (standing_) {
    decision_.order = Order::kStand;
    decision_.mode = FlightMode::kGuided;
  } else if (pilot_flies_) {
    decision_.order = Order::kPilot;
    decision_.mode = mode_bits::has(digest_, mode_bits::kPilotManual)
                         ? FlightMode::kManual
                         : FlightMode::kStabilized;
  } else if (failsafe) {
    fly_failsafe(in, reaction_of(*failsafe, in.now));
  } else if (pilot_lost_) {
    decision_.order = Order::kHold;
    decision_.mode = FlightMode::kAuto;
  } else {
    fly_agent(in);
  }

  decision_.state = !standing_   ? ArmingState::kFlying
                    : failsafe   ? ArmingState::kDisarmed
                    : has_flown_ ? ArmingState::kLanded
                                 : ArmingState::kReady;
  decision_.trigger = failsafe ? trigger_of(*failsafe) : most_severe_raised();
  decision_.without_position = decision_.raised.has(Failsafe::kGnss);
  decision_.without_motor = decision_.raised.has(Failsafe::kMotor);
  decision_.without_attitude = decision_.raised.has(Failsafe::kImu);
  if (decision_.mode != mode_before) decision_.events.insert(ModeEvent::kModeChanged);
  if (decision_.order != order_before ||
      (decision_.order == Order::kAgent && in.command != CommandKind::kNone))
    decision_.events.insert(ModeEvent::kOrderChanged);
  if (decision_.reaction != reaction_before)
    decision_.events.insert(ModeEvent::kReactionChanged);
}

FailsafeTrigger ModeLogic::most_severe_raised() const {
  for (std::size_t i = kFailsafes; i-- > 0;)
    if (decision_.raised.has(static_cast<Failsafe>(i)))
      return trigger_of(static_cast<Failsafe>(i));
  return FailsafeTrigger::kNone;
}

bool ModeLogic::is_landing() const {
  return decision_.order == Order::kLand ||
         (decision_.order == Order::kAgent && agent_ == CommandKind::kLand);
}

bool ModeLogic::comes_to_stand(const ModeInput& in, bool failsafe_acts) const {
  if (taking_off_) return grounded_ && failsafe_acts;
  if (grounded_) return true;
  return in.on_ground && in.landed &&
         (is_landing() || decision_.order == Order::kDescend);
}

void ModeLogic::stand(const ModeInput& in) {
  if (taking_off_) decision_.events.insert(ModeEvent::kTakeOffRefused);
  if (has_flown_ && !taking_off_) decision_.events.insert(ModeEvent::kLanded);
  standing_ = grounded_ = true;
  taking_off_ = false;
  // The mission has ended here; only what comes now is of the next one.
  agent_ = in.command;
}

void ModeLogic::take_off(bool failsafe_acts) {
  if (failsafe_acts) {
    decision_.events.insert(ModeEvent::kTakeOffRefused);
    return;
  }
  standing_ = false;
  taking_off_ = true;
  clears_ = {};
  decision_.events.insert(ModeEvent::kTookOff);
}

void ModeLogic::fly_failsafe(const ModeInput& in, FailsafeReaction reaction) {
  taking_off_ = false;
  const Abilities abilities{
      .airframe = rules_->airframe_,
      .position = !decision_.raised.has(Failsafe::kGnss),
      .motors = !decision_.raised.has(Failsafe::kMotor),
      .attitude = !decision_.raised.has(Failsafe::kImu),
      .home_in_reach = !home_lost_,
  };
  reaction = feasible(reaction, abilities);
  decision_.mode = FlightMode::kAuto;
  // A landing's last metres are no place to turn away.
  if (in.committed && in.command == CommandKind::kNone && is_landing() &&
      reaction != FailsafeReaction::kDescend) {
    decision_.reaction = FailsafeReaction::kLand;
    return;
  }
  decision_.reaction = reaction;
  decision_.order = order_of(reaction);
}

void ModeLogic::fly_agent(const ModeInput& in) {
  // What guidance calls done is the order of the last step.
  if (taking_off_ && in.done && !in.on_ground && decision_.order == Order::kTakeOff)
    taking_off_ = false;
  if (taking_off_) {
    decision_.order = Order::kTakeOff;
    decision_.mode = FlightMode::kAuto;
  } else if (agent_ == CommandKind::kNone) {
    decision_.order = Order::kHold;
    decision_.mode = FlightMode::kGuided;
  } else {
    decision_.order = Order::kAgent;
    decision_.mode =
        agent_ == CommandKind::kGuided ? FlightMode::kGuided : FlightMode::kAuto;
  }
}

}  // namespace skein::autopilot
