// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/onboard_agent.h"

#include <utility>

#include "skein/layer/reasoning/agent/flight_goal.h"
#include "skein/layer/reasoning/team/onboard/packed_task.h"

namespace skein::reasoning {

OnboardAgent::OnboardAgent(const OnboardAgentOptions& options, EntityId station,
                           const FlightContext& context, std::span<const Zone> zones,
                           MakeTask make)
    : options_(options),
      context_(context),
      safety_(options.avoidance, options.safety_zone, context.self, context.limits,
              *context.map, zones),
      beliefs_(station),
      rate_(options.report_rate),
      readings_(context.self, station),
      report_(context.self, station, options.report_period),
      tasks_(context_, station, std::move(make)),
      chain_(context_, options.separation, options.pilot, loiter_, tasks_),
      alerting_(options.separation.well_clear) {
  if (options_.first_task) tasks_.begin(*options_.first_task);
  if (options_.team) team_ = std::make_unique<OnboardTeam>(context_.self, *options_.team);
}

void OnboardAgent::step(const AgentInput& in, AgentOutput& out) {
  if (options_.takes_orders && tasks_.receive(in, out)) safety_.allow_launch(in);
  safety_.set_limits(context_.limits);  // an order may have changed its speed
  if (team_) follow_team(in, out);
  safety_.listen(in, out);
  chain_.listen(in, out);
  if (!in.nav) return;
  beliefs_.step(in, out);
  rate_.step(in.now, in.radio);
  readings_.step(in, rate_.share(), out);
  const TaskStep step{in,       readings_.latest(), safety_,
                      beliefs_, chain_.progress(),  intents_};
  look_out(step, fly(step, out), out);
  safety_.finish(in, out);
  tasks_.report(in, out);
  if (report_.step(in, context_.limits, tasks_, safety_.zones().changes_known(),
                   rate_.share(), out))
    tell_watchers(*in.nav, out);
}

void OnboardAgent::follow_team(const AgentInput& in, AgentOutput& out) {
  TeamWork work;
  work.free = obeys_orders(in.autopilot) && !tasks_.is_ordered();
  work.leaves = in.autopilot.reaction != FailsafeReaction::kNone;
  work.zones = safety_.zones().zones();
  work.task = tasks_.assigned();
  work.state = tasks_.state();
  work.share = tasks_.progress(in).share;
  team_->step(in, work, out);
  const TeamTask* task = team_->task();
  const auto number = task ? std::optional(task->number) : std::nullopt;
  const auto what = task ? unpacked(*task) : std::nullopt;
  if (tasks_.assign(number, what, in.now, out)) safety_.allow_launch(in);
}

void OnboardAgent::tell_watchers(const NavEstimate& nav, AgentOutput& out) const {
  for (const EntityId watcher : options_.watchers) {
    Message message;
    message.to = watcher;
    message.content = TeamPosition{context_.self, nav};
    out.outbox.push_back(std::move(message));
  }
}

// Alerts about intruders, and what may be flown.
void OnboardAgent::look_out(const TaskStep& step, bool flies, AgentOutput& out) {
  const auto goal = [this, &step] {
    return goal_of(chain_.wanted(), chain_.progress().passed, *step.in.nav,
                   step.in.now.seconds());
  };
  alerting_.step(context_.self, step.in, beliefs_.traffic().tracks(), flies, goal, out);
}

bool OnboardAgent::fly(const TaskStep& step, AgentOutput& out) {
  tasks_.listen(step);
  const bool flies = safety_.may_fly(step.in, altitude_to_take_off_to(*step.in.nav),
                                     tasks_.may_stand(), out);
  if (flies)
    chain_.fly(step, out);
  else
    chain_.stand(step.in.autopilot.on_ground ? "stands on the ground" : "takes off", out);
  // A task that wants to see something says so at each step.
  const bool gazed = std::exchange(gazes_, out.region_of_interest.has_value());
  if (gazed && !gazes_) out.region_of_interest.emplace();
  return flies;
}

double OnboardAgent::altitude_to_take_off_to(const NavEstimate& nav) const {
  if (const auto altitude = tasks_.altitude_msl()) return *altitude;
  return context_.map->elevation_msl(geo::horizontal(nav.p_N)) + context_.altitude_agl;
}

}  // namespace skein::reasoning
