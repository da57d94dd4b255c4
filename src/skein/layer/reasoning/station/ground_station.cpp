// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/station/ground_station.h"

#include <fmt/format.h>

#include <utility>

namespace skein::reasoning {
namespace {

constexpr const char* kOrdersOnly = "its team does not lead itself.";

std::vector<EntityId> ids_of(const std::vector<NamedAircraft>& team) {
  std::vector<EntityId> ids;
  for (const NamedAircraft& who : team) ids.push_back(who.id);
  return ids;
}

}  // namespace

GroundStation::GroundStation(const GroundStationOptions& options,
                             std::vector<PlannedMission> missions,
                             std::unique_ptr<const Allocator> allocator)
    : zones_(options.zones),
      orders_(options.team, missions.size(), options.id, options.position),
      missions_(std::move(missions), std::move(allocator)),
      heartbeat_(ids_of(options.team), options.heartbeat),
      name_(options.name),
      desk_(options.desk) {
  missions_.begin(orders_);
}

void GroundStation::step(const AgentInput& in, AgentOutput& out) {
  // Changes of zones reach the missions in the same step, as messages.
  std::vector<Message> inbox(in.inbox.begin(), in.inbox.end());
  zones_.step(in, inbox, out);
  AgentInput all = in;
  all.inbox = inbox;
  orders_.listen(in, out);
  missions_.step(all, orders_, out);
  for (const Command& command : in.commands) {
    if (const auto* decided = std::get_if<AllocationCommand>(&command))
      obey(*decided, in.now, out);
    else if (const auto* task = std::get_if<TeamTaskCommand>(&command))
      obey(*task, in.now, out);
  }
  orders_.resend(in.now, out);
  heartbeat_.step(in.now, out);
}

void GroundStation::obey(const AllocationCommand& command, Time now, AgentOutput& out) {
  if (!command.station.empty() && command.station != name_) return;
  refuse("allocation", desk_ ? desk_->decide(command, now) : kOrdersOnly, now, out);
}

void GroundStation::obey(const TeamTaskCommand& command, Time now, AgentOutput& out) {
  if (!command.station.empty() && command.station != name_) return;
  if (!desk_) return refuse("team task", kOrdersOnly, now, out);
  TaskKind what = command.what;
  std::string why = command.action == TeamTaskAction::kWithdraw
                        ? std::string()
                        : orders_.bind(what, command.others);
  if (why.empty()) why = desk_->obey(command, what, out, now);
  refuse("team task", why, now, out);
}

// Without a reason it is not refused.
void GroundStation::refuse(std::string_view what, const std::string& why, Time now,
                           AgentOutput& out) const {
  if (!why.empty())
    out.events.push_back({now, EntityId{}, EventKind::kCommandRefused,
                          fmt::format("{} of {}: {}", what, name_, why)});
}

}  // namespace skein::reasoning
