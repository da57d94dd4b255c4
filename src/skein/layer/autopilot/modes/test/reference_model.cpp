// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/autopilot/modes/test/reference_model.h"

#include <cmath>
#include <cstring>

namespace skein::autopilot {
namespace {

long to_ms(double seconds) {
  return std::lround(seconds * 1e3);
}
long to_ms(Time time) {
  return static_cast<long>(time.ns() / 1'000'000);
}

constexpr int kLastRow = static_cast<int>(kFailsafes) - 1;

// What becomes of none, hold, return, land, descend.
struct Fallback {
  const char* airframe_and_state;
  const char* becomes;
};
constexpr Fallback kFallbacks[] = {
    {"fixed wing, well", "NHRLD"},  {"fixed wing, far from home", "NHRDD"},
    {"fixed wing, lost", "NHHDD"},  {"fixed wing, no motor", "NDDDD"},
    {"fixed wing, blind", "NDDDD"}, {"multirotor, blind", "NDDDD"},
    {"multirotor, well", "NHRLD"},  {"multirotor, far from home", "NHRDD"},
    {"multirotor, lost", "NDDDD"},  {"multirotor, no motor", "NDDDD"},
};

FailsafeReaction fall_back(FailsafeReaction setpoint, AirframeKind kind, bool blind,
                           bool motor, bool lost, bool far_from_home) {
  std::string key = kind == AirframeKind::kFixedWing ? "fixed wing, " : "multirotor, ";
  key += blind           ? "blind"
         : motor         ? "no motor"
         : lost          ? "lost"
         : far_from_home ? "far from home"
                         : "well";
  for (const Fallback& row : kFallbacks)
    if (key == row.airframe_and_state) {
      const char letter = row.becomes[static_cast<std::size_t>(setpoint)];
      return static_cast<FailsafeReaction>(std::strchr("NHRLD", letter) - "NHRLD");
    }
  return FailsafeReaction::kNone;
}

}  // namespace

ReferenceModel::ReferenceModel(const FailsafeOptions& o, AirframeKind airframe,
                               long step_ms)
    : options_(o), airframe_(airframe), step_ms_(step_ms) {
  rows_[0].rule = o.link;
  rows_[1].rule = o.battery_low;
  rows_[2].rule = o.geofence;
  rows_[3].rule = o.gnss;
  rows_[4].rule = o.battery_critical;
  rows_[5].rule = o.motor;
  rows_[6].rule = o.imu;
  rows_[1].forever = rows_[4].forever = rows_[5].forever = true;
}

void ReferenceModel::count(Row& row, bool silent, bool bad, bool released) {
  if (row.raised_ms >= 0) row.raised_ms += step_ms_;
  if (silent || bad) {
    row.bad_ms = row.bad_ms < 0 ? 0 : row.bad_ms + step_ms_;
    row.good_ms = -1;
  } else {
    row.good_ms = row.good_ms < 0 ? 0 : row.good_ms + step_ms_;
    row.bad_ms = -1;
  }
  if (row.raised_ms < 0 && (silent || (bad && row.bad_ms >= to_ms(row.rule.delay)))) {
    row.raised_ms = 0;
  } else if (row.raised_ms >= 0 && row.good_ms >= to_ms(options_.recovery) &&
             !row.forever) {
    if (body_ == kStands) {
      row.raised_ms = -1;
    } else if (row.clears < options_.max_clears && (row.rule.resumes || released)) {
      row.raised_ms = -1;
      ++row.clears;
    }
  }
}

FailsafeReaction ReferenceModel::setpoint(const Row& row) const {
  const long after = to_ms(row.rule.escalates_after);
  return after > 0 && row.raised_ms >= after ? row.rule.escalates_to : row.rule.reaction;
}

int ReferenceModel::acting_row() const {
  for (int i = kLastRow; i >= 0; --i) {
    const Row& row = rows_[static_cast<std::size_t>(i)];
    if (row.raised_ms >= 0 && setpoint(row) != FailsafeReaction::kNone) return i;
  }
  return -1;
}

ReferenceModel::Answer ReferenceModel::step(const ModeInput& in) {
  const bool new_command = in.command != CommandKind::kNone;
  if (first_) {
    first_ = false;
    grounded_ = in.on_ground;
    body_ = in.on_ground ? kStands : kAirborne;
    for (Row& row : rows_) row.good_ms = -1;
  }

  // Transmitter: 0 silent, 1 received, 2 received and takes over.
  const long quiet = in.pilot ? to_ms(in.now - in.pilot->time) : 0;
  const bool heard = in.pilot && quiet <= to_ms(options_.pilot_silence);
  const int transmitter = !heard ? 0 : in.pilot->takes_over ? 2 : 1;
  constexpr Pilot next[3][3] = {
      {kAway, kAway, kFlies}, {kLost, kAway, kFlies}, {kLost, kAway, kFlies}};
  const Pilot before = pilot_;
  pilot_ = next[before][transmitter];
  const bool handed_back = before != kAway && pilot_ == kAway;

  ground_ms_ = !in.on_ground ? -1 : ground_ms_ < 0 ? 0 : ground_ms_ + step_ms_;
  grounded_ = in.on_ground && (grounded_ || ground_ms_ >= to_ms(options_.ground_time));

  if (new_command) mission_ = in.command;
  const bool released = new_command || handed_back;
  const long link_delay = to_ms(options_.link.delay);
  const bool link_silent =
      in.link_heard != kNotFitted && to_ms(in.now - in.link_heard) > link_delay;
  const bool gnss_silent = in.gnss_fix != kNotFitted &&
                           to_ms(in.now - in.gnss_fix) > to_ms(options_.gnss.delay);
  count(rows_[0], link_silent || (pilot_ == kLost && quiet > link_delay), false,
        released);
  count(rows_[1], false, in.charge - in.charge_home < options_.battery_reserve, released);
  count(rows_[2], false, in.outside_fence, released);
  count(rows_[3], gnss_silent, !in.estimator_healthy, released);
  count(rows_[4], false, in.charge < options_.battery_critical_at, released);
  count(rows_[5], false, in.motor_failed, released);
  count(rows_[6], false, in.imu_lost, released);
  if (rows_[4].raised_ms >= 0 && in.charge < in.charge_home) home_lost_ = true;

  const int acts = acting_row();
  const bool landing = order_ == Order::kLand ||
                       (order_ == Order::kAgent && mission_ == CommandKind::kLand);

  // The body: from each state, what ends it.
  if (pilot_ == kFlies) {
    if (body_ == kStands || grounded_) body_ = kAirborne;
  } else {
    const bool touched_down =
        in.on_ground && in.landed && (landing || order_ == Order::kDescend);
    if ((body_ == kAirborne && (grounded_ || touched_down)) ||
        (body_ == kLifts && grounded_ && acts >= 0)) {
      body_ = kStands;
      grounded_ = true;
      mission_ = in.command;
    }
    if (body_ == kStands && in.command == CommandKind::kTakeOff && acts < 0) {
      body_ = kLifts;
      for (Row& row : rows_) row.clears = 0;
    }
  }
  if (body_ != kStands && !grounded_) flown_ = true;

  Answer answer{};
  for (std::size_t i = 0; i < kFailsafes; ++i) answer.raised[i] = rows_[i].raised_ms >= 0;
  int shown = acts;
  for (int i = kLastRow; shown < 0 && i >= 0; --i)
    if (answer.raised[static_cast<std::size_t>(i)]) shown = i;
  using enum FailsafeTrigger;
  constexpr FailsafeTrigger names[] = {kNone, kLink,    kBattery, kGeofence,
                                       kGnss, kBattery, kMotor,   kImu};
  answer.trigger = names[shown + 1];

  constexpr ArmingState standing[2] = {ArmingState::kReady, ArmingState::kLanded};
  answer.state = body_ != kStands ? ArmingState::kFlying
                 : acts >= 0      ? ArmingState::kDisarmed
                                  : standing[flown_];
  const auto say = [&](Order order, FlightMode mode, FailsafeReaction reaction) {
    answer.order = order_ = order;
    answer.mode = mode;
    answer.reaction = reaction;
    return answer;
  };
  const auto none = FailsafeReaction::kNone;
  if (body_ == kStands) return say(Order::kStand, FlightMode::kGuided, none);
  if (pilot_ == kFlies)
    return say(Order::kPilot,
               in.pilot->mode == FlightMode::kManual ? FlightMode::kManual
                                                     : FlightMode::kStabilized,
               none);
  if (acts >= 0) {
    body_ = kAirborne;
    const FailsafeReaction reaction =
        fall_back(setpoint(rows_[static_cast<std::size_t>(acts)]), airframe_,
                  answer.raised[6], answer.raised[5], answer.raised[3], home_lost_);
    if (landing && in.committed && !new_command && reaction != FailsafeReaction::kDescend)
      return say(order_, FlightMode::kAuto, FailsafeReaction::kLand);
    constexpr Order orders[] = {Order::kStand, Order::kHold, Order::kReturn, Order::kLand,
                                Order::kDescend};
    return say(orders[static_cast<std::size_t>(reaction)], FlightMode::kAuto, reaction);
  }
  if (pilot_ == kLost) return say(Order::kHold, FlightMode::kAuto, none);
  if (body_ == kLifts && order_ == Order::kTakeOff && in.done && !in.on_ground)
    body_ = kAirborne;
  if (body_ == kLifts) return say(Order::kTakeOff, FlightMode::kAuto, none);
  constexpr FlightMode modes[] = {FlightMode::kGuided, FlightMode::kGuided,
                                  FlightMode::kAuto, FlightMode::kAuto,
                                  FlightMode::kAuto};
  const auto kind = static_cast<std::size_t>(mission_);
  return say(mission_ == CommandKind::kNone ? Order::kHold : Order::kAgent, modes[kind],
             none);
}

}  // namespace skein::autopilot
