#include "skein/layer/reasoning/station/ground_station.h"

#include <fmt/format.h>

#include <utility>

namespace skein::reasoning {
namespace {

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
  for (const Command& command : in.commands)
    if (const auto* decided = std::get_if<AllocationCommand>(&command))
      obey(*decided, in.now, out);
  orders_.resend(in.now, out);
  heartbeat_.step(in.now, out);
}

void GroundStation::obey(const AllocationCommand& command, Time now, AgentOutput& out) {
  if (!command.station.empty() && command.station != name_) return;
  const std::string why =
      desk_ ? desk_->decide(command, now) : std::string("its team does not lead itself.");
  if (!why.empty())
    out.events.push_back({now, EntityId{}, "command-refused",
                          fmt::format("allocation of {}: {}", name_, why)});
}

}  // namespace skein::reasoning
