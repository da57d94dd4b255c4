// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "skein/layer/reasoning/agent/expected_flight.h"
#include "skein/layer/reasoning/agent/landing_planner.h"
#include "skein/layer/reasoning/agent/task_executor.h"
#include "skein/layer/reasoning/avoidance/separator/separator.h"

namespace skein::reasoning {

/// The third planner of the chain: keeps apart from others (Separator).
///
/// What the task flies by a plan is flown in time, and in another way where that would
/// not be apart; the task counts it as its own. What it flies without a plan is said to
/// others as far as it can be expected, and interrupted by a plan while something has to
/// be passed. Where the task's flight ends in a circle that is part of what is said, a
/// minute and more before: at a place and height that is apart from the flights and
/// circles of others (place_to_hold()), and moved while one with the right of way needs
/// it. Another flight is begun from a circle once it leads into no conflict that would
/// have to be solved at once, on its way or around others. Legs that lead through no zone
/// are flown as expected, by a plan; points that such plans pass count as passed.
/// Landings are flown one after the other with others (LandingPlanner). While a pilot or
/// a failsafe flies it says that the aircraft flies straight on, and changes nothing:
/// others keep out of its way. Where a pilot was shown a flight and does not fly it in
/// time, it says for a minute that the task's flight is flown, with the right of way of a
/// pilot who flies. On the ground it says nothing.
class SeparationPlanner {
 public:
  /// @param context  outlives it.
  SeparationPlanner(const FlightContext& context, const SeparationOptions& options)
      : context_(context),
        options_(options),
        landing_(context, options.separation.horizontal, options.holding_step),
        separator_(context.self, options) {}

  /// Takes in what others say. At each step, on the ground too.
  void listen(const AgentInput& in, AgentOutput& out);

  /// What shall be flown.
  /// @param flight  how the flight of the last intent goes that this has returned.
  /// @returns  `given` itself, or what is flown instead, good until the next call.
  const FlightIntent* plan(const FlightIntent* given, const TaskStep& step,
                           const FlightProgress& flight, AgentOutput& out);

  /// What it returned last is the task's own flight, led another way.
  bool modifies() const { return modifies_; }

  /// What it returned last is flown instead of what the task flies without a plan: the
  /// task begins anew with what is left.
  bool interrupts() const { return interrupts_; }

  /// The progress of what was flown, as that of what the task wanted.
  FlightProgress for_task(const FlightProgress& flown);

  std::string_view reason() const { return reason_; }

 private:
  void want(const FlightIntent& given, const TaskStep& step,
            const FlightProgress& flight);
  bool may_not_leave(const FlightPlan& plan, const FlightIntent& given,
                     const TaskStep& step) const;
  ExpectedFlight prolonged(const FlightIntent& given, const TaskStep& step,
                           const FlightContext& context) const;
  void go_on_interrupting(const FlightIntent& given);

  // Of circles to stay in (separation_hold.cpp).
  struct Hold {
    Circling requested, flown;
    Time placed;
  };
  const FlightIntent* held(const FlightIntent* asked, const TaskStep& step);
  void place_hold(const Circling& requested, const NavEstimate& from, double begin,
                  const TaskStep& step);
  bool must_move_hold(Time now) const;
  bool is_held(const Circling& requested) const;
  void foresee_end(const Itinerary& itinerary, const TaskStep& step);
  bool stay_behind_legs(const FlightIntent& given, const TaskStep& step,
                        ExpectedFlight& ahead);
  bool goes_on_as_foreseen(const FlightIntent& given);
  void stay_as_foreseen(std::uint32_t number);
  bool begins(const FlightIntent& given, const WantedFlight& wanted,
              const TaskStep& step);
  bool circles() const;
  bool is_past_task(Time now) const;
  SeparationStep separation_step(const TaskStep& step, const PathQuery& query,
                                 bool keeps_on, bool is_ignored) const;
  FlightProgress progress_of_task(const FlightProgress& flown) const;
  void want_course(const TaskStep& step);
  void want_itinerary(const FlightIntent& given, const Itinerary& itinerary,
                      const TaskStep& step);
  bool expects_other(const FlightIntent& given, const TaskStep& step) const;
  bool circles_elsewhere(const FlightIntent& given) const;
  PathQuery query_of(const TaskStep& step) const;
  bool is_ignored(const TaskStep& step, const FlightProgress& flight);
  void separate(const TaskStep& step, bool keeps_on, bool is_ignored);
  const FlightIntent* own_flight(const FlightIntent& given, const TaskStep& step);
  void say(AgentOutput& out);
  void list_intruders(const TaskStep& step);

  const FlightContext& context_;
  SeparationOptions options_;
  LandingPlanner landing_;
  Separator separator_;
  WantedFlight wanted_;
  std::uint32_t counted_ = 0;        // flights that were wanted
  std::uint32_t given_ = 0;          // number of the intent that is wanted
  std::size_t kind_ = 0;             // of the intent
  std::optional<Circling> circled_;  // what was planned, of circles
  bool expected_ = false;            // it has no plan
  bool interrupts_ = false;          // what is flown without a plan, by one of its own
  bool interrupted_ = false;         // the same, in the step before
  bool has_legs_ = false;            // what is expected
  bool flies_as_expected_ = false;   // legs and circles, by a plan
  Time unplanned_until_;             // since the autopilot has refused such a plan
  std::size_t points_left_ = 0;      // of the legs that are wanted
  std::size_t points_ahead_ = 0;     // of them, in what is expected
  std::size_t passed_before_ = 0;    // of them, when it was expected
  std::size_t reported_ = 0;  // points of legs that the task knows to be passed by it
  bool by_others_ = false;    // what is wanted is the flight of a pilot or failsafe
  std::optional<Time> unflown_since_;  // its last flight
  Time ignored_until_;                 // by a pilot who was shown it
  Time expected_at_;
  std::optional<Hold> hold_;         // the circle asked for last, or foreseen
  FlightIntent held_;                // the same, flown elsewhere
  bool foreseen_ = false;            // what is wanted ends in the circle of `hold_`
  bool legs_end_ = false;            // the same, of legs
  bool as_task_ = true;              // what is wanted is the task's own itinerary
  std::size_t task_points_ = 0;      // milestones of that, its end included
  std::size_t points_before_ = 0;    // of them, before those that are wanted
  Time waiting_since_, asks_again_;  // of a flight that is not begun yet
  std::uint32_t waits_for_ = 0;      // its number; 0: none
  double lowest_ = 0;                // height above the ground of what is wanted [m]
  std::uint32_t lowest_of_ = 0;
  FlightIntent own_;
  std::uint32_t own_number_ = 0, own_plan_ = 0;  // of what own_ was made
  std::uint32_t own_of_ = 0;                     // the intent of which
  bool own_as_task_ = false;                     // it is the task's own itinerary
  bool modifies_ = false;
  std::string_view reason_;
  std::vector<Message> messages_;
  std::vector<AvoidedIntruder> intruders_;
};

}  // namespace skein::reasoning
