#include "skein/layer/reasoning/team/onboard/team_desk.h"

#include <utility>

#include "skein/layer/reasoning/team/onboard/coalition_allocation.h"
#include "skein/layer/reasoning/team/onboard/task_needs.h"

namespace skein::reasoning {
namespace {

TeamConfig with_reported_wind(TeamConfig config, bool in_wind, const Vec2& wind) {
  if (in_wind) config.allocate = CoalitionAllocation([&wind] { return wind; });
  return config;
}

}  // namespace

TeamDesk::TeamDesk(EntityId self, TeamConfig config, bool in_wind, const Vec3& place)
    : link_(self, with_reported_wind(std::move(config), in_wind, wind_)) {
  TeamResources resources;
  resources.place = place;
  resources.able = false;
  link_.member().set_resources(resources);
}

std::vector<std::uint32_t> TeamDesk::hand_in(const std::string& mission,
                                             std::span<const WantedTask> tasks,
                                             Time now) {
  if (mission_.empty()) mission_ = mission;
  std::vector<std::uint32_t> numbers;
  std::vector<TeamTask> all;
  for (const WantedTask& wanted : tasks) {
    numbers.push_back(++last_);
    all.push_back(team_task(last_, wanted.what, wanted.sensors, wanted.group));
  }
  link_.member().hand_in(mission_, all, now);
  return numbers;
}

void TeamDesk::step(const AgentInput& in, AgentOutput& out) {
  if (in.now == stepped_) return;
  stepped_ = in.now;
  learn_wind(in);
  link_.step(in, out);
}

void TeamDesk::learn_wind(const AgentInput& in) {
  for (const Message& message : in.inbox)
    if (const auto* report = std::get_if<AircraftReport>(&message.content))
      wind_ = report->nav.wind_N;
}

std::string TeamDesk::decide(const AllocationCommand& command, Time now) {
  if (stepped_ != now) return "no mission of the team is going on.";
  return link_.member().decide(command.number,
                               command.action == AllocationAction::kApprove);
}

bool TeamDesk::is_done(std::uint32_t task) const {
  const auto& known = link_.member().knowledge().tasks;
  const auto found = known.find(task);
  return found != known.end() && found->second.done;
}

}  // namespace skein::reasoning
