// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "skein/layer/reasoning/team/protocol/member_state.h"
#include "skein/layer/reasoning/team/protocol/orders.h"
#include "skein/layer/reasoning/team/protocol/round_trips.h"

namespace skein::reasoning {

/// Who follows a leader, what each is ordered, and how long messages to it take. Keeps
/// MemberState::members of who leads.
class TeamFollowers {
 public:
  explicit TeamFollowers(EntityId self) : orders_(self) {}

  /// It leads from now on, and follows its own order until it allocates.
  void begin(MemberState& member);
  void clear();

  /// @param certain  it has said that it follows.
  /// @param why      for the report.
  void add(MemberState& member, EntityId id, bool certain, const char* why);
  void drop(MemberState& member, EntityId id, const std::string& why);
  /// Those that are silent for too long; reminds those that are for long.
  void drop_silent(MemberState& member);

  /// A follower says that it follows.
  void confirmed(MemberState& member, EntityId from, const TeamInform& inform);
  /// A member follows another one.
  /// @param hands_on  that one is of the own team, or led it before: this one does not.
  void follows_other(MemberState& member, EntityId from, EntityId leader, bool hands_on);
  /// It does not want to follow: unless it has said meanwhile that it does.
  void declined(MemberState& member, EntityId from);
  void on(MemberState& member, EntityId from, const TeamAssignAck& ack);

  bool contains(EntityId id) const { return followers_.contains(id); }
  std::size_t size() const { return followers_.size(); }
  bool empty() const { return followers_.empty(); }
  /// Those that know all that there is to know and may lead, but for one.
  std::vector<EntityId> candidates(const MemberState& member,
                                   std::optional<EntityId> except) const;
  /// Whether one does not know who is in the team, or what it has to do, as a query says.
  bool lag_behind(const MemberState& member, const TeamQuery& query) const;
  /// All that can be given tasks, the leader included.
  std::vector<TeamWorker> workers(const MemberState& member) const;

  void note_query(std::uint32_t number, double now) { round_trips_.sent(number, now); }
  /// What each shall do: of what it is given, what can be flown now.
  void set_orders(const MemberState& member, const TeamAllocation& given,
                  std::span<const TeamTask> tasks);
  /// Sends the orders that are due, and obeys the own one.
  void give_orders(MemberState& member);
  bool orders_acknowledged() const { return orders_.all_acknowledged(); }

 private:
  struct Follower {
    double claimed = 0;                       // when it last said that it follows [s]
    bool certain = false;                     // it has said so
    bool able = true;                         // to fly tasks
    std::vector<std::uint32_t> refused = {};  // of them
  };

  std::map<EntityId, Follower> followers_;
  TeamOrders orders_;
  RoundTrips round_trips_;
};

}  // namespace skein::reasoning
