// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "skein/data/perimeter/monitoring.h"
#include "skein/data/radio/message.h"

namespace skein::perimeter {

/// What the coordinator remembers of one aircraft of its team.
struct Member {
  AircraftStatus status;
  Time last_report;
  double silence_allowed = 0;  ///< from there on [s]
  Time task_sent;
  bool heard = false;       ///< has ever reported
  bool has_limits = false;  ///< has said how it can fly: status.limits
  bool available = false;   ///< reported lately, has limits, and takes orders
  bool deploying = true;    ///< on its first transect, has not crossed yet
  bool forced = false;      ///< sent to the boundary because it has not crossed for long
  Time deployed;            ///< when its transect began
  /// Course of the transect that it is on its way to; none: it has begun.
  std::optional<double> enters = std::nullopt;
  std::uint32_t reported_task = 0;
};

/// The team as its reports show it: who is there, where, doing what.
class Roster {
 public:
  /// @param lost_after  an aircraft silent for this time is not counted on, unless it has
  ///                    said that it reports more rarely [s].
  Roster(std::span<const EntityId> members, double lost_after);

  /// Takes in a report; false when it is not from the team. Who flies by itself (a pilot,
  /// a failsafe) is not counted on until it obeys again, and nobody before he has said
  /// how he can fly.
  bool take(const AircraftReport& report, EntityId from, Time now);

  /// Notes from which aircraft nothing is received any more; returns those that just went
  /// silent.
  std::vector<EntityId> update(Time now);

  Member* find(EntityId id);
  std::vector<Member>& members() { return members_; }
  const std::vector<Member>& members() const { return members_; }

 private:
  std::vector<Member> members_;
  double lost_after_;
};

}  // namespace skein::perimeter
