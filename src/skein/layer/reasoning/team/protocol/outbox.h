// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "skein/base/time.h"
#include "skein/data/event/event.h"
#include "skein/data/team/team_message.h"

namespace skein::reasoning {

/// A message of the team protocol as it arrives.
struct TeamReceived {
  EntityId from;
  bool to_all = true;
  TeamMessage message;
};

/// A message of the team protocol to be sent.
struct TeamOutgoing {
  std::optional<EntityId> to = std::nullopt;  ///< none: all
  TeamMessage message;
};

/// What a step gives.
struct TeamStep {
  std::vector<TeamOutgoing> send;
  std::vector<Event> events;
  std::vector<TeamAllocationReport> allocations;  ///< what has become of them
  bool changed = false;                           ///< status() is another one than before
};

/// What a member sends and reports in a step: counts messages, and repeats those to one
/// that may be lost.
class TeamOutbox {
 public:
  explicit TeamOutbox(EntityId self) : self_(self) {}

  /// A step begins.
  void begin(Time now);
  /// What has come together since.
  TeamStep take();

  void report(EventKind kind, std::string text, EventNumbers numbers = {});
  void report(TeamAllocationReport allocation);
  /// @returns  the number of the message.
  std::uint32_t send_all(TeamContent content);
  void send(EntityId to, TeamContent content);

  /// The same message, however often it comes: `times` times, while it is not later than
  /// `until` [s].
  void repeat(EntityId to, TeamContent content, int times, double until);
  /// Sends what is due; again after `interval` [s].
  void send_repeated(double interval);
  void drop_repeated() { repeated_.clear(); }
  void drop_repeated_to(EntityId id);
  void drop_repeated_except_to(EntityId id);

 private:
  struct Repeated {
    EntityId to;
    TeamContent content;
    int left = 0;
    double next = 0, until = 0;
  };

  EntityId self_;
  Time time_;
  TeamStep step_;
  std::uint32_t sent_to_all_ = 0;
  std::map<EntityId, std::uint32_t> sent_to_;
  std::vector<Repeated> repeated_;
};

}  // namespace skein::reasoning
