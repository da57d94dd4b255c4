// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "skein/base/random.h"
#include "skein/layer/reasoning/team/protocol/team_member.h"

namespace skein::rehearsal {

/// What a medium does to messages.
struct TeamMedium {
  double loss = 0;       ///< share that does not arrive, each receiver by itself
  double delay = 0;      ///< [s]
  double jitter = 0;     ///< up to so much more, so that messages overtake [s]
  double duplicate = 0;  ///< share that arrives twice
};

/// Carries messages between members of a team, with partitions.
class TeamNetwork {
 public:
  TeamNetwork(TeamMedium medium, std::uint64_t seed, std::uint32_t instance);

  void join(EntityId id);
  void leave(EntityId id) { members_.erase(id); }
  void partition(const std::vector<std::vector<EntityId>>& parts);
  void heal() { part_of_.clear(); }
  bool is_connected(EntityId a, EntityId b) const;
  const std::set<EntityId>& members() const { return members_; }

  void send(EntityId from, const std::vector<reasoning::TeamOutgoing>& messages,
            double now);
  /// What has arrived for a member.
  std::vector<reasoning::TeamReceived> receive(EntityId id, double now);

  std::uint64_t messages() const { return messages_; }
  std::uint64_t bytes() const { return bytes_; }

 private:
  struct InFlight {
    double at = 0;
    reasoning::TeamReceived message;
  };
  void carry(EntityId from, EntityId to, const reasoning::TeamOutgoing& message,
             double now);

  TeamMedium medium_;
  RandomStream random_;
  std::set<EntityId> members_;
  std::map<EntityId, std::size_t> part_of_;  // who is not in it hears all
  std::map<EntityId, std::vector<InFlight>> in_flight_;
  std::uint64_t messages_ = 0, bytes_ = 0;
};

}  // namespace skein::rehearsal
