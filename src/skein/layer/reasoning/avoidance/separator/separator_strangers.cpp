#include "skein/layer/reasoning/avoidance/separator/separator.h"
#include "skein/layer/reasoning/planning/search/repair.h"
#include "skein/model/path/flight_plan.h"

// How the separator keeps out of the way of those who say nothing of their plans, or do
// not keep to them.

namespace skein::reasoning {
namespace {

constexpr double kAvoidPeriod = 1;            // [s]
constexpr double kHeardOf = 10;               // who says where it is counts so long [s]
constexpr double kPlaceSd = 5;                // of what it says [m]
constexpr double kSpeedSd = 1;                // [m/s]
constexpr std::uint32_t kTeam = 0x80000000u;  // names of members

}  // namespace

void Separator::list_strangers(const SeparationStep& step) {
  around_.assign(step.strangers.begin(), step.strangers.end());
  for (const TeamFlight& each : team_.flights()) {
    if (each.conforms(step.now) || !each.place ||
        (step.now - each.place->sent).seconds() > kHeardOf)
      continue;
    Stranger member;
    member.name = kTeam | each.who.value;
    member.time = each.place->sent.seconds();
    member.p_N = each.place->p_N;
    member.v_N = each.place->v_N;
    member.horizontal_sd = member.vertical_sd = kPlaceSd;
    member.horizontal_speed_sd = member.vertical_speed_sd = kSpeedSd;
    member.kept = separation_of(own_, each);
    member.keeps_well_clear = false;
    around_.push_back(member);
  }
}

void Separator::avoid_strangers(const SeparationStep& step) {
  if (options_.method != SeparationMethod::kAuto || last_moment_) return;
  if ((step.now - avoided_).seconds() < kAvoidPeriod && avoided_ != Time()) return;
  avoided_ = step.now;
  list_strangers(step);
  if (around_.empty() && !turn_) return;
  const double until = rejoins(step.now.seconds());
  const std::vector<PlannedFlight> others = rooms(step, false);
  const auto action = strangers_.step({step.now.seconds(), step.p_N, step.v_N, own_.plan,
                                       until, around_, step.query, step.zones, others});
  if (action == StrangerAvoidance::Action::kPlan) {
    FlightPlan flight = strangers_.flight();
    if (until < model::end_time_of(own_.plan))
      model::append(flight,
                    planning::part_of(own_.plan, until, model::end_time_of(own_.plan)));
    adopt(flight,
          {strangers_.begin(), until, strangers_.meeting().end,
           SeparationMethod::kNonCooperative, self_, 0, "around a stranger"},
          step.now);
  } else if (action == StrangerAvoidance::Action::kTrack) {
    turn_ = strangers_.track();
    reason_ = "turns away from a stranger";
  } else if (turn_) {
    begun_ = false;  // what it wants is planned from here
    turn_.reset();
  }
}

}  // namespace skein::reasoning
