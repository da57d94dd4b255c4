#include "skein/layer/reasoning/mission/formation/formation_control.h"

#include <fmt/format.h>

#include <algorithm>

#include "skein/base/check.h"

namespace skein::reasoning {
namespace {

constexpr double kResendAfter = 3;  // an order not confirmed by now is sent again [s]

}  // namespace

FormationControl::FormationControl(const FormationOptions& options)
    : options_(options), members_(options.team.size()) {
  SKEIN_CHECK(options.slots.size() + 1 >= options.team.size());
  for (const Leadership& change : options.leaders)
    SKEIN_CHECK(change.leader < options.team.size());
}

void FormationControl::step(const AgentInput& in, AgentOutput& out) {
  const auto& changes = options_.leaders;
  for (; next_ < changes.size() && changes[next_].at <= in.now; ++next_)
    if (leader_ != changes[next_].leader) appoint(changes[next_].leader, in.now, out);

  for (const Message& message : in.inbox) {
    const auto* report = std::get_if<AircraftReport>(&message.content);
    const auto sender =
        std::find(options_.team.begin(), options_.team.end(), message.from);
    if (!report || sender == options_.team.end()) continue;
    const auto k = static_cast<std::size_t>(sender - options_.team.begin());
    members_[k].confirmed = report->task_number;
  }
  for (std::size_t k = 0; k < members_.size(); ++k)
    if (members_[k].task.number != members_[k].confirmed &&
        (in.now - members_[k].sent).seconds() >= kResendAfter)
      send(k, in.now, out);
}

MissionDemand FormationControl::demand() const {
  MissionDemand demand;
  demand.max = static_cast<int>(options_.team.size());
  demand.place = options_.route.front();
  return demand;
}

void FormationControl::appoint(std::size_t leader, Time now, AgentOutput& out) {
  leader_ = leader;
  const EntityId leads = options_.team[leader];
  std::size_t slot = 0;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    Task& task = members_[k].task;
    ++task.number;
    if (k == leader) {
      FlyRoute route{options_.route, options_.laps, {}};
      for (const EntityId id : options_.team)
        if (options_.direct && id != leads) route.report_to.push_back(id);
      task.what = std::move(route);
    } else {
      task.what = FollowLeader{leads, options_.slots[slot++]};
    }
    send(k, now, out);
  }
  out.events.push_back({now, leads, "leader", "leads the formation"});
}

void FormationControl::send(std::size_t k, Time now, AgentOutput& out) {
  members_[k].sent = now;
  Message message;
  message.to = options_.team[k];
  message.content = members_[k].task;
  out.outbox.push_back(std::move(message));
}

}  // namespace skein::reasoning
