#include "skein/layer/reasoning/agent/onboard_agent.h"

#include <utility>

namespace skein::reasoning {

OnboardAgent::OnboardAgent(const OnboardAgentOptions& options, EntityId station,
                           const FlightContext& context, std::span<const Zone> zones,
                           MakeTask make)
    : options_(options),
      context_(context),
      safety_(options.avoidance, options.safety_zone, context.self, context.limits,
              *context.map, zones),
      beliefs_(station),
      readings_(context.self, station),
      report_(station, options.report_period),
      tasks_(context.self, station, std::move(make)),
      chain_(context, options.separation, loiter_, tasks_) {
  if (options_.first_task) tasks_.begin(*options_.first_task);
}

void OnboardAgent::step(const AgentInput& in, AgentOutput& out) {
  if (options_.takes_orders && tasks_.receive(in, out)) safety_.allow_launch(in);
  safety_.listen(in, out);
  chain_.listen(in);
  if (!in.nav) return;
  beliefs_.step(in, out);
  readings_.step(in, out);
  fly({in, readings_.latest(), safety_, beliefs_, chain_.progress(), intents_}, out);
  safety_.finish(in, out);
  tasks_.report(in, out);
  if (report_.step(in, context_.limits, tasks_, safety_.zones().changes_known(), out))
    tell_watchers(*in.nav, out);
}

void OnboardAgent::tell_watchers(const NavEstimate& nav, AgentOutput& out) const {
  for (const EntityId watcher : options_.watchers) {
    Message message;
    message.to = watcher;
    message.content = TeamPosition{context_.self, nav};
    out.outbox.push_back(std::move(message));
  }
}

void OnboardAgent::fly(const TaskStep& step, AgentOutput& out) {
  tasks_.listen(step);
  if (safety_.may_fly(step.in, altitude_to_take_off_to(*step.in.nav), tasks_.may_stand(),
                      out))
    chain_.fly(step, out);
  else
    chain_.stand(step.in.autopilot.on_ground ? "stands on the ground" : "takes off", out);
  // A task that wants to see something says so at each step.
  const bool gazed = std::exchange(gazes_, out.region_of_interest.has_value());
  if (gazed && !gazes_) out.region_of_interest.emplace();
}

double OnboardAgent::altitude_to_take_off_to(const NavEstimate& nav) const {
  if (const auto altitude = tasks_.altitude_msl()) return *altitude;
  return context_.map->elevation_msl(geo::horizontal(nav.p_N)) + context_.altitude_agl;
}

}  // namespace skein::reasoning
