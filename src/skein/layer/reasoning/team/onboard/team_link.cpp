// SPDX-License-Identifier: Apache-2.0
#include "skein/layer/reasoning/team/onboard/team_link.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace skein::reasoning {
namespace {

constexpr std::uint32_t kToOne = 1U << 31;

}  // namespace

void TeamLink::step(const AgentInput& in, AgentOutput& out) {
  std::vector<TeamReceived> received;
  for (const Message& message : in.inbox) {
    const auto* said = std::get_if<TeamMessage>(&message.content);
    if (!said || (!known_.empty() && !known_.contains(message.from))) continue;
    TeamReceived& one = received.emplace_back();
    one.from = message.from;
    one.to_all = (said->number & kToOne) == 0;
    one.message = *said;
    one.message.number &= ~kToOne;
  }
  TeamStep done = member_.step(in.now, received);
  for (TeamOutgoing& outgoing : done.send) {
    if (outgoing.to) outgoing.message.number |= kToOne;
    Message message;
    message.to = outgoing.to.value_or(kEveryone);
    message.content = std::move(outgoing.message);
    out.outbox.push_back(std::move(message));
  }
  for (Event& event : done.events) out.events.push_back(std::move(event));
  for (TeamAllocationReport& report : done.allocations)
    out.records.emplace_back(std::move(report));
  if (!done.changed) return;
  const TeamStatus& status = member_.status();
  TeamLead lead;
  if (status.mission) lead.team = name_of(*status.mission);
  lead.master = status.master;
  lead.members = status.members;
  lead.reason = status.reason;
  out.records.emplace_back(std::move(lead));
}

}  // namespace skein::reasoning
