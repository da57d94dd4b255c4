// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/mission/tasking_mission.h"

#include <algorithm>
#include <utility>

namespace skein::reasoning {
namespace {

constexpr double kRepeatAfter = 3;  // an order not confirmed by now is sent again [s]
constexpr double kSilent = 5;  // an aircraft unheard for so long is not counted on [s]

}  // namespace

TaskingMission::TaskingMission(const std::vector<EntityId>& team) {
  for (const EntityId id : team) team_.emplace_back().id = id;
}

void TaskingMission::step(const AgentInput& in, AgentOutput& out) {
  listen(in);
  pursue(in, out);
  for (Aircraft& each : team_)
    if (each.mine && each.task.number > each.confirmed &&
        (in.now - each.ordered).seconds() >= kRepeatAfter)
      send(each, in.now, out);
}

void TaskingMission::listen(const AgentInput& in) {
  for (const Message& message : in.inbox) {
    const auto from = std::find_if(team_.begin(), team_.end(), [&](const Aircraft& a) {
      return a.id == message.from;
    });
    if (from == team_.end()) continue;
    if (const auto* report = std::get_if<AircraftReport>(&message.content)) {
      from->nav = report->nav;
      if (report->limits) from->limits = report->limits;
      from->silence_allowed = silence_allowed(*report, kSilent);
      from->mine = report->obeys && from->limits;
      from->heard = in.now;
      from->confirmed = report->task_number;
      from->state = report->task_state;
      from->share = report->task_share;
      from->time_to_go = report->task_time_to_go;
    } else if (const auto* left = std::get_if<TaskReport>(&message.content)) {
      from->left = *left;
    }
  }
  for (Aircraft& each : team_)
    if ((in.now - each.heard).seconds() > each.silence_allowed) each.mine = false;
}

int TaskingMission::mine() const {
  return static_cast<int>(std::count_if(team_.begin(), team_.end(),
                                        [](const Aircraft& a) { return a.mine; }));
}

void TaskingMission::order(Aircraft& aircraft, TaskKind what, Time now,
                           AgentOutput& out) {
  ++aircraft.task.number;
  aircraft.task.what = std::move(what);
  aircraft.left.reset();
  send(aircraft, now, out);
}

void TaskingMission::send(Aircraft& aircraft, Time now, AgentOutput& out) {
  aircraft.ordered = now;
  out.outbox.push_back({EntityId{}, aircraft.id, 0, Time(), aircraft.task});
}

const TaskKind& TaskingMission::rest_of(const Aircraft& aircraft) {
  const bool said = aircraft.left && aircraft.left->number == aircraft.task.number;
  return said ? aircraft.left->rest : aircraft.task.what;
}

}  // namespace skein::reasoning
