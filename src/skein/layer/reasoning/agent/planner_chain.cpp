// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/agent/planner_chain.h"

#include "skein/base/check.h"

namespace skein::reasoning {

void PlannerChain::fly(const TaskStep& step, AgentOutput& out) {
  const FlightIntent* intent = nullptr;
  PlannerOfChain* author = nullptr;
  for (std::size_t k = 0; k < links_.size(); ++k) {
    const FlightIntent* next = links_[k]->plan(intent, step, out);
    if (next != intent) {
      if (author) author->replaced();
      author = links_[k];
    }
    const auto verdict =
        next == intent ? PlannerVerdict::kPassedOn : PlannerVerdict::kReplaced;
    note(static_cast<PlannerLink>(k), {verdict, links_[k]->reason()}, out);
    intent = next;
  }
  SKEIN_CHECK(intent != nullptr);
  wanted_ = intent;
  const FlightIntent* apart = separation_.plan(intent, step, trajectory_.progress(), out);
  auto verdict = PlannerVerdict::kPassedOn;
  if (apart != intent)
    verdict =
        separation_.modifies() ? PlannerVerdict::kModified : PlannerVerdict::kReplaced;
  if (apart != intent && separation_.interrupts()) author->replaced();
  note(PlannerLink::kSeparation, {verdict, separation_.reason()}, out);
  intent =
      pilot_ ? pilot_->fly(intent, apart, separation_.reason(), step.in, out) : apart;
  FlightSafety& safety = step.safety;
  trajectory_.fly(
      *intent,
      {step.in, safety.zones(), safety.returns(), safety.off_plan(), safety.news()}, out);
  progress_ = separation_.for_task(trajectory_.progress());
  const std::string_view change = trajectory_.change();
  note(PlannerLink::kTrajectory,
       {change.empty() ? PlannerVerdict::kPassedOn : PlannerVerdict::kModified, change},
       out);
}

void PlannerChain::stand(std::string_view reason, AgentOutput& out) {
  note(PlannerLink::kTrajectory, {PlannerVerdict::kReplaced, reason}, out);
}

void PlannerChain::note(PlannerLink link, const Said& said, AgentOutput& out) {
  Said& last = said_[static_cast<std::size_t>(link)];
  if (last == said) return;
  last = said;
  out.records.emplace_back(PlannerChange{link, said.verdict, std::string(said.reason)});
}

}  // namespace skein::reasoning
