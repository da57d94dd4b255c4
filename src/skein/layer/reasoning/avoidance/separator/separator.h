// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/data/airspace/airspace.h"
#include "skein/data/radio/message.h"
#include "skein/layer/reasoning/avoidance/flights/conflicts.h"
#include "skein/layer/reasoning/avoidance/flights/execution_errors.h"
#include "skein/layer/reasoning/avoidance/flights/held_circle.h"
#include "skein/layer/reasoning/avoidance/group/conflict_group.h"
#include "skein/layer/reasoning/avoidance/group/group_negotiation.h"
#include "skein/layer/reasoning/avoidance/group/joint_search.h"
#include "skein/layer/reasoning/avoidance/intruders/intruder_avoidance.h"
#include "skein/layer/reasoning/avoidance/pairwise/pair_negotiation.h"
#include "skein/layer/reasoning/avoidance/right_of_way/right_of_way.h"
#include "skein/layer/reasoning/avoidance/rules/right_of_way.h"
#include "skein/layer/reasoning/avoidance/separator/conflict_log.h"
#include "skein/role/path_planner.h"

namespace skein::reasoning {

struct SeparationOptions {
  SeparationMethod method = SeparationMethod::kNone;
  Separation separation;   ///< kept to others at least
  double horizon = 90;     ///< how far ahead conflicts are looked for [s]
  double fixed = 30;       ///< a solution shall stand so long before it is needed [s]
  double reaction = 2;     ///< own action begins so long after a decision [s]
  double emergency = 15;   ///< from so short a time on each acts alone [s]
  double last_moment = 5;  ///< from so short a time on only heights count [s]
  /// Between two words of where it is; its plan is said again after five of them [s]. The
  /// same for all of a team.
  double place_period = 1;
  /// How far it is off its plans, and from where it believes to be, is kept on top of
  /// `separation`; else that is all that is kept.
  bool widens = true;
  /// Which deal it asks for where two agree (deal_rule_of()).
  DealRule deal = DealRule::kSum;
  double holding_step = 60;  ///< between the heights of two that wait to land [m]
  IntruderRoom intruder_room = IntruderRoom::kMoving;  ///< kept free of the own flight
  /// By which alerts about intruders are given and bands made; null: skein_suas.
  std::shared_ptr<const model::WellClearConfiguration> well_clear = {};
};

/// What an aircraft shall fly, as its task has it.
struct WantedFlight {
  std::uint32_t number = 0;  ///< another number, another flight
  FlightPlan plan;           ///< not empty
  /// Times at which the aircraft must be where the plan has it, growing, the end last.
  std::vector<double> milestones;
  /// It is flown as it is; else it is what can be expected: how far the aircraft is off
  /// it says nothing of how well it keeps to plans.
  bool is_plan = true;
  double unknown = 0;  ///< how far it may be off that, besides [m]
  /// What the task flies ends there; behind it is what follows, a circle to stay in: said
  /// to others, and changed only by another one [s].
  double held_from = std::numeric_limits<double>::infinity();
};

/// What the separator is given at one step.
struct SeparationStep {
  Time now;
  Vec3 p_N = Vec3::Zero();  ///< where the aircraft believes to be [m]
  Vec3 v_N = Vec3::Zero();  ///< over ground [m/s]
  double position_sd = 0;   ///< of p_N, per horizontal axis [m]
  double altitude_sd = 0;   ///< of p_N [m]
  FlightPriority priority = FlightPriority::kNormal;
  /// What flights are planned with: limits, wind, ground; without start and goal.
  const PathQuery& query;
  std::span<const Zone> zones;  ///< no-fly
  /// Tracks of those who do not belong to the team.
  std::span<const AvoidedIntruder> intruders = {};
  /// Another flight would not be flown: a pilot or a failsafe flies, or it lands.
  bool keeps_on = false;
  /// A pilot has not flown what kept apart from the team: nothing else is tried for now,
  /// but to keep out of the way of intruders, who do not hear of it.
  bool is_ignored = false;
};

/// To fly now instead of any plan.
struct Heading {
  double course = 0;        ///< over ground [rad]
  double altitude_msl = 0;  ///< [m]
};

/// Keeps one aircraft apart from the others of its team.
///
/// It says to all what the aircraft flies and where it is, watches what the others say,
/// and changes the flight where two will not be apart. How depends on the time that is
/// left and on what the other can do (SeparationMethod::kAuto), or is one method.
/// It makes no difference which messages are lost, late or come twice: what has not been
/// agreed in time is solved by a method that needs less agreement.
/// Reference: spec/team.md sections 1 to 8.
class Separator {
 public:
  Separator(EntityId self, const SeparationOptions& options)
      : self_(self),
        options_(options),
        team_(options.horizon, options.place_period),
        right_of_way_(self),
        intruders_(options.reaction, options.well_clear.get()) {}

  /// Takes in what was received. At each step, on the ground too.
  void listen(Time now, std::span<const Message> inbox);

  /// At each step in which the aircraft flies.
  /// @param out  messages to be sent.
  void step(const SeparationStep& step, const WantedFlight& wanted,
            std::vector<Message>& out);

  /// The flight that is flown, and whether it is another than wanted.
  const FlightPlan& plan() const { return own_.plan; }
  bool changed() const { return changed_; }
  std::uint32_t number() const { return own_.number; }
  /// Whether what is flown, changed or not, is this flight that was wanted.
  bool is_about(std::uint32_t wanted) const { return begun_ && wanted_ == wanted; }
  /// Those of the wanted flight that are still ahead, at the times of plan().
  const std::vector<double>& milestones() const { return milestones_; }
  /// Milestones of the wanted flight that are not in milestones().
  std::size_t passed() const { return passed_; }

  /// Whether a flight from now on comes too near to others while conflicts are looked
  /// for.
  bool meets_others(const FlightPlan& plan, Time now) const;

  /// Kept to others at least.
  const Separation& kept() const { return options_.separation; }

  /// Whether a flight from now on comes too near to what is known of others, however
  /// late.
  /// @param more  kept to them besides what has to be.
  bool meets(const FlightPlan& plan, Time now, const Separation& more) const;

  /// The circles in which the flights of others end, and what is kept to each.
  std::vector<HeldCircle> circles_of_others(Time now) const;

  /// When the flight comes too near to somebody who has the right of way, the earliest
  /// that was found at the last look [s]. What is flown behind the end of the task
  /// counts.
  /// @param behind_task  of what is flown behind the end of the task; else before it.
  std::optional<double> is_to_move(Time now, bool behind_task) const;

  /// Whether somebody circles near by, who may begin another flight at any time.
  bool has_neighbours_in_circles(Time now, const Vec3& p_N) const;

  /// Takes a flight in place of the present one if it leads into no conflict, on its way
  /// or around others, that would have to be solved at once: in less time than an
  /// agreement needs.
  /// @returns  whether it is flown from now on; else the present one goes on.
  bool begins(const SeparationStep& step, const WantedFlight& wanted);

  /// What the flight was changed for last is over for some time.
  bool is_clear(Time now) const { return now.seconds() >= clear_from_; }

  /// Of what others send: the share that is lost, and the longest delay of late [s].
  double loss() const { return team_.loss(); }
  double delay() const;

  /// What is flown instead of a plan, out of an intruder's way.
  const std::optional<Heading>& turn() const { return turn_; }

  /// Why the flight is another than wanted; empty: it is not.
  std::string_view reason() const { return reason_; }

  /// The plan cannot be flown: what is wanted is taken anew.
  void refuse_plan() { begun_ = false; }

  /// Conflicts that are over since the last call.
  std::vector<ConflictReport> take_reports() { return log_.take(); }

 private:
  struct Waiting {
    double until = 0;                           // to try a method with somebody again [s]
    std::uint32_t own_plan = 0, seen_plan = 0;  // when `asks_at` was set
    double asks_at = 0;  // even if it has another conflict before [s]
    int failures = 0;    // of negotiations, one after the other
  };

  // Of where it stays (separator_hold.cpp).
  struct FlyingState {
    OwnFlight own;
    std::uint32_t wanted, agreed;
    std::vector<double> milestones;
    std::size_t passed;
    bool changed, is_plan, plan_is_new;
    double unknown, held_from, clear_from;
    std::string_view reason;
  };
  FlyingState flying_state() const;
  void restore(const FlyingState& state);
  void set_held_conflicts_aside(Time now);
  std::optional<Conflict> first_to_solve(const SeparationStep& step) const;

  void want(const WantedFlight& wanted);
  void measure(const SeparationStep& step);
  void look(const SeparationStep& step);
  bool solve(const SeparationStep& step, const Conflict& conflict);
  void say(const SeparationStep& step, std::vector<Message>& out);

  // Of negotiations (separator_negotiation.cpp).
  void hear(const SeparationStep& step);
  void answer(const SeparationStep& step, EntityId from, const ConflictNotice& notice);
  void negotiate(const SeparationStep& step);
  void open_earliest(const SeparationStep& step);
  bool open(const SeparationStep& step, const Conflict& conflict);
  bool is_next_for(const TeamFlight& other, const Conflict& conflict, Time now);
  void begin_negotiation(const SeparationStep& step, const ConflictNotice& notice,
                         EntityId opener, const TeamFlight& other);
  bool can_answer(const SeparationStep& step, const ConflictNotice& notice,
                  const TeamFlight* other, Busy& busy);
  PairNegotiation* negotiation_of(EntityId opener, std::uint32_t number, EntityId other);

  // Of several at once (separator_group.cpp).
  void hear_of_groups(const SeparationStep& step, const Message& message);
  void answer(const SeparationStep& step, EntityId from,
              const GroupInvitation& invitation);
  bool can_join(const SeparationStep& step, const GroupInvitation& invitation) const;
  void open_group(const SeparationStep& step);
  void negotiate_group(const SeparationStep& step);
  std::optional<std::vector<GroupManoeuvre>> solve_group(
      const SeparationStep& step, std::span<const JoinedMember> members) const;
  void fly_with_group(const GroupNegotiation& agreed, Time now);
  void leave_group();

  // Of the order of two (separator_right_of_way.cpp).
  const Conflict* lowest_in_the_way(Time now) const;
  void ask_to_yield(const SeparationStep& step);
  void hear_answer(Time now, EntityId from, const YieldAnswer& answer);
  void answer(const SeparationStep& step, EntityId from, const YieldRequest& request);
  bool gives_way_to(const SeparationStep& step, const TeamFlight& other,
                    const YieldRequest& request);

  // Of those who say nothing (separator_intruders.cpp).
  void avoid_intruders(const SeparationStep& step);
  std::optional<double> climb_from_team(const SeparationStep& step, double course) const;

  // Of what each does alone (separator_methods.cpp).
  std::vector<PlannedFlight> rooms(const SeparationStep& step, bool higher_only) const;
  SeparationMethod method_for(const Conflict& conflict, Time now) const;
  NegotiatedConflict about(const Conflict& conflict, double begin) const;
  bool by_rule(const SeparationStep& step, const Conflict& conflict);
  bool by_priority(const SeparationStep& step, const Conflict& conflict);
  bool around_others(const SeparationStep& step, const Conflict& conflict,
                     bool higher_only, std::string_view what);
  bool apart_from_others(const SeparationStep& step, const Conflict& conflict,
                         bool higher_only, std::string_view what);
  bool by_evasion(const SeparationStep& step, const Conflict& conflict);

  // At the last moment (separator_last_moment.cpp).
  bool at_the_last_moment(const SeparationStep& step, const Conflict& conflict);
  bool climbs_away(const SeparationStep& step, const TeamFlight& other,
                   const FlightPlan& theirs, double closest) const;
  std::optional<FlightPlan> flight_aside(const SeparationStep& step,
                                         const Conflict& conflict, double turn,
                                         bool up) const;
  double safe_altitude(const SeparationStep& step, double course, double altitude) const;
  struct Change {
    double begin = 0;    // of the flight [s]
    double rejoins = 0;  // where the old plan is met again, by its time [s]
    double apart = 0;    // when the conflict is over [s]
    SeparationMethod method = SeparationMethod::kNone;
    std::optional<EntityId> other = {};  // because of whom, of the team
    std::uint32_t agreed = 0;            // see PlanReport
    std::string_view what;
  };
  void adopt(const FlightPlan& flight, const Change& change, Time now);
  double begin_of_action(const Conflict& conflict, Time now) const;
  NegotiatingFlight leaving_for(const Conflict& conflict, const PathQuery& query) const;
  // Else it is told from moment to moment where to fly.
  bool flies_plan() const { return !turn_; }
  bool has_way_over(const TeamFlight& other, Time now) const;
  Standing standing_to(const TeamFlight& other, Time now) const;
  std::vector<KnownFlight> known_but(EntityId other, Time now) const;
  double rejoins(double after) const;
  double delay_to(EntityId other) const;

  EntityId self_;
  SeparationOptions options_;
  TeamFlights team_;
  RightOfWay right_of_way_;
  ConflictFinder finder_;
  ExecutionErrors errors_;
  ConflictLog log_;
  OwnFlight own_;
  FlightPriority priority_ = FlightPriority::kNormal;
  std::uint32_t wanted_ = 0, agreed_ = 0, opened_ = 0;
  std::vector<double> milestones_;
  std::size_t passed_ = 0;
  bool changed_ = false, is_plan_ = true, keeps_on_ = false;
  double unknown_ = 0;     // how far it may be off what is wanted [m]
  double clear_from_ = 0;  // [s]
  double held_from_ = std::numeric_limits<double>::infinity();  // see WantedFlight [s]
  std::string_view reason_;
  Time last_moment_until_;
  IntruderAvoidance intruders_;
  std::optional<Heading> turn_;
  std::optional<PairNegotiation> negotiation_, last_;  // that goes on, the one before
  ConflictGroups groups_;
  std::optional<GroupNegotiation> group_;
  NegotiationName last_group_;                // that the aircraft took part in
  std::uint32_t group_plan_ = 0;              // the own one since `group_since_`
  double group_since_ = 0, group_again_ = 0;  // [s]
  std::vector<Message> inbox_, answers_;
  std::map<EntityId, Waiting> waiting_;
  std::vector<Conflict> conflicts_;
  std::vector<Conflict> held_conflicts_;  // that another place to stay at solves
  Time looked_, avoided_, said_plan_, said_place_, measured_;
  bool plan_is_new_ = false, begun_ = false;
  int said_again_ = 0;  // times that the plan is still to be said, as messages are lost
};

}  // namespace skein::reasoning
