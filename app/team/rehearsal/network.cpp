// SPDX-License-Identifier: Apache-2.0
#include "app/team/rehearsal/network.h"

#include <algorithm>

namespace skein::rehearsal {

TeamNetwork::TeamNetwork(TeamMedium medium, std::uint64_t seed, std::uint32_t instance)
    : medium_(medium), random_(seed, instance, Purpose::kTeam, 1) {}

void TeamNetwork::join(EntityId id) {
  members_.insert(id);
}

void TeamNetwork::partition(const std::vector<std::vector<EntityId>>& parts) {
  part_of_.clear();
  for (std::size_t part = 0; part < parts.size(); ++part)
    for (const EntityId id : parts[part]) part_of_[id] = part;
}

bool TeamNetwork::is_connected(EntityId a, EntityId b) const {
  const auto first = part_of_.find(a), second = part_of_.find(b);
  return first == part_of_.end() || second == part_of_.end() ||
         first->second == second->second;
}

void TeamNetwork::carry(EntityId from, EntityId to,
                        const reasoning::TeamOutgoing& message, double now) {
  if (!is_connected(from, to) || random_.uniform() < medium_.loss) return;
  const int copies = random_.uniform() < medium_.duplicate ? 2 : 1;
  for (int copy = 0; copy < copies; ++copy) {
    const double at = now + medium_.delay + medium_.jitter * random_.uniform();
    in_flight_[to].push_back({at, {from, !message.to, message.message}});
  }
}

void TeamNetwork::send(EntityId from,
                       const std::vector<reasoning::TeamOutgoing>& messages, double now) {
  for (const reasoning::TeamOutgoing& message : messages) {
    ++messages_;
    bytes_ += air_bytes(message.message.content);
    if (message.to) {
      if (members_.contains(*message.to)) carry(from, *message.to, message, now);
      continue;
    }
    for (const EntityId to : members_)
      if (to != from) carry(from, to, message, now);
  }
}

std::vector<reasoning::TeamReceived> TeamNetwork::receive(EntityId id, double now) {
  std::vector<InFlight>& all = in_flight_[id];
  const auto late = std::stable_partition(
      all.begin(), all.end(), [now](const InFlight& one) { return one.at <= now; });
  std::stable_sort(all.begin(), late,
                   [](const InFlight& a, const InFlight& b) { return a.at < b.at; });
  std::vector<reasoning::TeamReceived> arrived;
  for (auto one = all.begin(); one != late; ++one)
    arrived.push_back(std::move(one->message));
  all.erase(all.begin(), late);
  return arrived;
}

}  // namespace skein::rehearsal
