#include "skein/layer/reasoning/avoidance/separator/separator.h"

// How the separator keeps out of the way of those who say nothing of their plans.

namespace skein::reasoning {
namespace {

constexpr double kAvoidPeriod = 1;  // [s]

}  // namespace

void Separator::avoid_strangers(const SeparationStep& step) {
  if (options_.method != SeparationMethod::kAuto || step.keeps_on) return;
  if ((step.now - avoided_).seconds() < kAvoidPeriod && avoided_ != Time()) return;
  avoided_ = step.now;
  if (step.strangers.empty() && !turn_) return;
  const double until = rejoins(step.now.seconds());
  const std::vector<PlannedFlight> others = rooms(step, false);
  const auto action = strangers_.step({step.now.seconds(), step.p_N, step.v_N, own_.plan,
                                       until, step.strangers, step.query, step.zones,
                                       others, options_.stranger_room});
  if (action == StrangerAvoidance::Action::kPlan) {
    turn_.reset();
    adopt(strangers_.flight(),
          {strangers_.begin(),
           until,
           strangers_.meeting().end,
           SeparationMethod::kNonCooperative,
           {},
           0,
           "around a stranger"},
          step.now);
  } else if (action == StrangerAvoidance::Action::kTrack) {
    const double course = strangers_.track();
    turn_ =
        Heading{course, safe_altitude(step, course, -step.p_N.z() + strangers_.climb())};
    reason_ = "turns away from a stranger";
  } else if (turn_) {
    begun_ = false;  // what it wants is planned from here
    turn_.reset();
  }
}

}  // namespace skein::reasoning
