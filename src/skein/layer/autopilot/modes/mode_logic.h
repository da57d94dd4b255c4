// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "skein/base/time.h"
#include "skein/data/vehicle/autopilot.h"
#include "skein/data/vehicle/pilot.h"
#include "skein/layer/autopilot/modes/failsafe.h"

namespace skein::autopilot {

/// What mode logic needs to know about a command of the agent.
enum class CommandKind : std::uint8_t {
  kNone,
  kGuided,   ///< path, course, circle, position
  kMission,  ///< plan, waypoints, return
  kTakeOff,
  kLand,
};
CommandKind kind_of(const AutopilotCommand& command);

/// A time of last reception for what is not fitted and so never missed.
inline constexpr Time kNotFitted =
    Time::from_ns(std::numeric_limits<std::int64_t>::max());

/// All that is known at one control step. Made to be kept and brought up to date piece by
/// piece; only `command` is of one step.
struct ModeInput {
  Time now;                                        ///< not before 0, never going back
  std::optional<PilotInput> pilot = std::nullopt;  ///< the last one received
  CommandKind command = CommandKind::kNone;        ///< came since the last step
  Time link_heard = kNotFitted;  ///< last; with a link fitted, at first the start
  Time gnss_fix = kNotFitted;    ///< last that was of use; with a receiver, as above
  bool estimator_healthy = true;
  double charge = 1;       ///< left, from 0 to 1
  double charge_home = 0;  ///< what getting home takes, as a part of a full charge
  bool outside_fence = false;
  bool motor_failed = false;  ///< see MotorWatch
  bool imu_lost = false;      ///< see SensorSelector
  bool on_ground = false;
  // What guidance says about the order of the last step:
  bool done = false;       ///< its end has been reached
  bool landed = false;     ///< at rest after touching down
  bool committed = false;  ///< a landing is too far on to be broken off
};

/// What is flown.
enum class Order : std::uint8_t {
  kStand,    ///< on the ground with motors off
  kPilot,    ///< what the sticks say
  kTakeOff,  ///< the last TakeOff command; others that come meanwhile wait for its end
  kAgent,    ///< the last command of the agent
  kHold,     ///< stay where the order came
  kReturn,   ///< fly home, stay above
  kLand,     ///< fly home and land
  kDescend,  ///< come down here
};

enum class ArmingState : std::uint8_t {
  kDisarmed,  ///< on the ground; a failsafe forbids to take off
  kReady,     ///< on the ground, not flown yet
  kFlying,    ///< motors under control, from the take-off run to the landing
  kLanded,    ///< on the ground after a flight, ready for the next
};

enum class ModeEvent : std::uint8_t {
  kModeChanged,
  kOrderChanged,  ///< also: the agent's order is now another command
  kFailsafeRaised,
  kFailsafeCleared,
  kReactionChanged,
  kPilotTookOver,
  kPilotHandedBack,
  kPilotLost,  ///< the transmitter fell silent while the pilot flew
  kTookOff,
  kLanded,
  kTakeOffRefused,  ///< or broken off on the ground
};

/// Several values of a small enum.
template <class Enum>
class SetOf {
 public:
  constexpr bool has(Enum e) const { return (bits_ >> index(e) & 1u) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr void insert(Enum e) {
    bits_ = static_cast<std::uint16_t>(bits_ | 1u << index(e));
  }
  constexpr void erase(Enum e) {
    bits_ = static_cast<std::uint16_t>(bits_ & ~(1u << index(e)));
  }
  friend constexpr bool operator==(SetOf, SetOf) = default;

 private:
  static constexpr unsigned index(Enum e) { return static_cast<unsigned>(e); }
  std::uint16_t bits_ = 0;
};

/// Who flies, what, and why.
struct Decision {
  FlightMode mode = FlightMode::kGuided;
  Order order = Order::kStand;
  ArmingState state = ArmingState::kReady;
  /// The failsafe that acts; while none acts, the most severe one that is raised.
  FailsafeTrigger trigger = FailsafeTrigger::kNone;
  FailsafeReaction reaction = FailsafeReaction::kNone;  ///< as flown, see feasible()
  bool without_position = false;  ///< fly by dead reckoning or level attitude
  bool without_motor = false;     ///< do not count on thrust
  bool without_attitude = false;  ///< nothing can be controlled
  SetOf<Failsafe> raised;
  SetOf<Failsafe> raised_now, cleared_now;
  SetOf<ModeEvent> events;  ///< of this step
};

/// FailsafeOptions made ready for the step; shared by all vehicles that have them.
class ModeRules {
 public:
  /// `options` that are valid, see error_in().
  ModeRules(const FailsafeOptions& options, AirframeKind airframe);

 private:
  friend class ModeLogic;
  struct Rule {
    Time delay;
    Time escalates_after;  // 0: never
    FailsafeReaction reaction = FailsafeReaction::kNone;
    FailsafeReaction escalates_to = FailsafeReaction::kNone;
    bool resumes = false;
  };
  static Rule made_ready(const FailsafeRule& rule);

  std::array<Rule, kFailsafes> rules_;
  double battery_reserve_;
  double battery_critical_at_;
  Time recovery_;
  Time pilot_silence_;
  Time ground_time_;
  int max_clears_;
  AirframeKind airframe_;
};

/// Decides at every control step who flies the vehicle and by which order. Pure: what it
/// decides follows from the inputs so far. The rules are in docs/modes-and-failsafes.md.
///
/// Cost: a few comparisons while nothing changes; no allocation.
class ModeLogic {
 public:
  /// `rules` must outlive this.
  explicit ModeLogic(const ModeRules& rules) : rules_(&rules) {}

  /// One control step. The first one says by `on_ground` where the flight begins.
  const Decision& step(const ModeInput& in) {
    if (in.command == CommandKind::kNone) [[likely]] {
      if (digest(in) == digest_ && in.now < wake_) [[likely]]
        return decision_;
    }
    return think(in);
  }

  /// Of the last step.
  const Decision& decision() const { return decision_; }
  /// The agent's command in force when the autopilot flies for it.
  CommandKind agent_command() const { return agent_; }

 private:
  std::uint32_t digest(const ModeInput& in) const;
  const Decision& think(const ModeInput& in);
  void wake_by(Time time, Time now);
  void hear_pilot();
  void feel_ground(const ModeInput& in);
  void watch(Time now, Failsafe failsafe, bool released);
  bool may_clear(Failsafe failsafe, bool released) const;
  FailsafeReaction reaction_of(Failsafe failsafe, Time now) const;
  std::optional<Failsafe> acting(Time now) const;
  FailsafeTrigger most_severe_raised() const;
  void decide(const ModeInput& in);
  bool is_landing() const;
  bool comes_to_stand(const ModeInput& in, bool failsafe_acts) const;
  void stand(const ModeInput& in);
  void take_off(bool failsafe_acts);
  void fly_failsafe(const ModeInput& in, FailsafeReaction reaction);
  void fly_agent(const ModeInput& in);

  const ModeRules* rules_;
  Decision decision_;
  std::uint32_t digest_ = 0;
  Time wake_ = Time::from_ns(0);              // something may change by time alone
  std::array<Time, kFailsafes> edge_{};       // the condition last came or went
  std::array<Time, kFailsafes> raised_at_{};  // for those raised
  std::array<std::uint16_t, kFailsafes> clears_{};
  Time touched_;          // the ground, for the time that must follow
  std::uint8_t bad_ = 0;  // conditions at the last step, a bit each
  CommandKind agent_ = CommandKind::kNone;
  bool begun_ = false;
  bool pilot_flies_ = false;
  bool pilot_lost_ = false;
  bool touches_ = false;
  bool grounded_ = false;
  bool standing_ = false;
  bool taking_off_ = false;
  bool has_flown_ = false;
  bool home_lost_ = false;  // it was out of reach on a critical battery
  bool handed_back_ = false;
};

}  // namespace skein::autopilot
